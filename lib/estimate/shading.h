// Light leaving a visible point: direct by shadow rays, indirect from the cache, gloss by radiance records or
// traced paths, specular by traced paths.
#pragma once

#include <optional>
#include <vector>

#include "core/counters.h"
#include "core/random.h"
#include "direct/image_sampler.h"
#include "direct/lamp_sampler.h"
#include "estimate/caustic_light.h"
#include "radiance/gloss_cache.h"
#include "radiance/tree.h"
#include "record/far_records.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/lamp/extent.h"
#include "scene/lamp/luminaires.h"
#include "scene/material/bsdf.h"
#include "scene/rays.h"

namespace phos::inline estimate {

struct ShadingOptions {
  int light_samples = 16;      ///< shadow rays per area light at the visible surface
  int gloss_samples = 8;       ///< rays per glossy visible surface
  int specular_depth = 64;     ///< longest chain of mirrors and glass
  bool cached_direct = false;  ///< the records hold direct light too: lamps add to glossy lobes alone
  bool reflect_direct = true;  ///< lamps light the surfaces that gloss and mirrors show
};

/// Samples [first, first + count) of a low-discrepancy sequence of `total`, which several points (the samples
/// of one pixel) share. The random stream `sequence` that starts it must then be the same for each of them.
struct SampleRange {
  SampleRange(int n) : count(n), total(n) {}
  SampleRange(int first_sample, int n, int all) : first(first_sample), count(n), total(all) {}
  int first = 0, count = 1, total = 1;
};

/// Direct light at a point.
struct DirectLight {
  Rgb radiance{0};     ///< cd/m2 towards the viewer
  DVec3 variance{0};   ///< of radiance; 0 if no light has more than one sample
  Rgb illuminance{0};  ///< lx on the shading normal's side
};

/// Light through the glossy lobes of a point.
struct GlossLight {
  Rgb radiance{0};    ///< cd/m2 towards the viewer, all but from_lamps
  Rgb from_lamps{0};  ///< cd/m2: lamps that the rays hit, with the weight that direct() leaves them
  DVec3 variance{0};  ///< of the sum of both; 0 if there is one ray only
};

/// A visible point without a valid record.
struct Miss {
  Vec3 position{0}, normal{0, 0, 1};
};

/// What one thread's shading leaves besides light.
struct ShadingLog {
  std::vector<Miss> misses;
  std::vector<Miss> gloss_misses;  ///< without a radiance record, though one is to serve it: traced instead
  Counters counters;
  GlossCache::Worker memory;
  CausticLight::Worker caustics;
};

class Shading {
 public:
  /// `gloss`: null where all gloss is traced; `caustics`: null where records hold caustic light.
  Shading(const RayScene& rays, const Luminaires& lights, const RecordTree& records,
          const ShadingOptions& options, const GlossCache* gloss = nullptr,
          const CausticLight* caustics = nullptr);

  /// Irradiance from the cache at a point, lx. Where no record reaches, a miss is noted, and farther ones
  /// answer (FarRecords); weight 0: there are none.
  Interpolated cached(const SurfacePoint& point, ShadingLog& log) const;

  /// Caustic light at a point, where the records hold no caustic light: irradiance, and the data that
  /// log.caustics needs for its gloss. 0 where the records hold it. An error far below `other_lx`, the rest of the irradiance
  /// there, is no matter.
  LocalDensity caustic(const SurfacePoint& point, ShadingLog& log, float other_lx = 0) const;
  bool has_caustics() const { return caustics_ != nullptr; }

  /// Light through the glossy lobes from radiance records, all but the light that lamps send straight there.
  /// Nothing where it is to be traced; that no record reaches the point is noted.
  std::optional<GlossyLight> recorded(const SurfacePoint& point, const Vec3& wo, ShadingLog& log) const;

  /// Light straight from the lights, `samples` shadow rays for each area light (low-discrepancy), one for
  /// others. With `gloss_rays` > 0 the glossy lobe's share is weighted against gloss() (power heuristic,
  /// Veach 1997 ch. 9, shadow rays counted twice for being even). Without the Lambert part if
  /// options.cached_direct; without the environment if its light is had another way.
  DirectLight direct(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const SampleRange& samples,
                     int gloss_rays, RandomStream& sequence, bool environment = true) const;

  /// Light of the images that lamps have in flat mirrors, as direct(): one sample of each (ImageSampler
  /// leaves weak ones to chance) for every 16 of `samples`, of the environment its sun's alone. With `gloss_by_rays`, the glossy lobes'
  /// share of area lights and sun is left to gloss(), whose rays find them in mirrors; radiance records do
  /// not hold it.
  DirectLight mirrored(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss_by_rays,
                       const SampleRange& samples, RandomStream& sequence) const;

  /// direct() and mirrored() for a place whose light is averaged over many others: one sample of one lamp
  /// (LampSampler), and one of one image (ImageSampler). cd/m2 towards the viewer
  Rgb from_one_lamp(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss_by_rays,
                    RandomStream& random) const;

  /// Light arriving through the glossy lobes, from `samples` rays that read direct light and the cache where
  /// they land. `light_samples` is the number that direct() was called with; kOneLamp: from_one_lamp() was; 0
  /// if neither, so that lamps count whole.
  static constexpr int kOneLamp = -1;
  GlossLight gloss(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const SampleRange& samples,
                   int light_samples, int depth, RandomStream& sequence, RandomStream& random,
                   ShadingLog& log, bool environment = true) const;

  /// Light through mirrors and smooth glass, to options.specular_depth, cd/m2: of every branch; of one,
  /// chosen by the light that it sends on, where the light is one `of_many` that are averaged.
  Rgb specular(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, int depth, const Rgb& throughput,
               bool of_many, RandomStream& random, ShadingLog& log) const;

  /// Light that diffuse transmission brings through to a point from the other side, cd/m2: as outgoing(), but
  /// for `samples` of each extended lamp there.
  struct Through {
    Rgb indirect{0};  ///< of the caches
    Rgb indirect_stderr{0};
    DirectLight direct;   ///< through the sheet; `illuminance` is on its other side
    bool missed = false;  ///< no record reaches the other side
  };
  Through through(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const SampleRange& samples,
                  RandomStream& sequence, ShadingLog& log) const;

  /// Light leaving a point that a ray has found, but for its own emission, cd/m2: from the caches, from the
  /// lamps, through the glossy lobes that no radiance record tells of, and through mirrors and glass. Each
  /// extended lamp gets `light_samples` samples (an even number meets a sun half the time), the lobes as many
  /// rays. With 1 the light is one of many that are averaged: one lamp is sampled (from_one_lamp()), caustic
  /// light is looked for with a probability only, and of two specular branches one is followed. `depth`
  /// counts reflections since the eye (or the record).
  Rgb outgoing(const SurfacePoint& point, const Vec3& wo, int depth, const Rgb& throughput, int light_samples,
               RandomStream& random, ShadingLog& log) const;

 private:
  /// Part of the light of lamps that a ray of gloss finds which direct() leaves to it; `light_samples` as
  /// of gloss().
  float left_to_gloss(const SurfacePoint& point, std::size_t light, int light_samples, float light_density,
                      int gloss_rays, float gloss_density) const;
  /// Light of one sample of a lamp, its choice included, cd/m2 towards the viewer.
  Rgb from_lamp(const LampSampler::Choice& choice, const SurfacePoint& point, const Bsdf& bsdf,
                const Vec3& wo, bool gloss_by_rays, RandomStream& random) const;
  /// Of an image's lux: cd/m2 towards the viewer, without the glossy lobes where gloss() finds it.
  Rgb image_share(const Bsdf& bsdf, const Vec3& wo, const ImageSampler::Sample& image,
                  bool gloss_by_rays) const;
  /// caustic() where one sample is enough: with a probability, weighted by its inverse.
  Rgb caustic_sample(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss, float other_lx,
                     RandomStream& random, ShadingLog& log) const;
  /// caustic() as it is reflected, by the lobes too with `gloss`, cd/m2; of fewer photons where few samples
  /// of lamps are asked for.
  Rgb caustic_light(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss, float other_lx,
                    int light_samples, ShadingLog& log) const;
  /// A lamp lights no surface that faces away from the whole lamp.
  bool out_of_sight(const LampExtent& lamp, const SurfacePoint& point) const;
  const RayScene& rays_;
  const Luminaires& lights_;
  const RecordTree& records_;
  FarRecords far_;
  ShadingOptions options_;
  const GlossCache* gloss_;
  const CausticLight* caustics_;
  LampSampler lamps_;
  ImageSampler images_;
  std::vector<LampExtent> extent_;  // per light
};

}  // namespace phos::inline estimate
