// Light from where rays land.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/counters.h"
#include "estimate/caustic_light.h"
#include "estimate/estimator.h"
#include "estimate/gather_source.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/hemisphere/seen_pass.h"
#include "estimate/lamp_light.h"
#include "estimate/record_options.h"
#include "radiance/gloss_cache.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline estimate {

/// Light from where rays land, towards where they came from. Const, usable from any thread; holds references.
///
/// RecordOptions::gather_bounces counts reflections between the lamp and the record, those by gloss, mirrors
/// and glass too, as PathOptions::bounces of the reference does (which also counts the one at the record):
/// with 1, a diffuse place shows the light that lamps send it, and a mirror shows the lamps. Without that
/// limit a diffuse place ends a path with the light of the source, and with gloss where radiance records hold
/// it, and mirrors, glass and other gloss are followed, one ray at a time, until they lead to such a place:
/// caustics seen in mirrors and all such light is there, without bias. Lamps without area are not seen in
/// mirrors: where flat ones show their images to a place that rays land on, those are sampled if the source
/// lacks them; their other caustics are in the source alone. With RecordOptions::caustics_apart, light of
/// lamps that comes to the record by mirrors and glass alone does not count: it is caustic light, which
/// photons carry (estimate/caustic_light.h). Without, lamps of an extent count there, and light of others is
/// missing. A diffuse place nearer than half the radius of the source's zones there is not read but followed
/// by one more ray, cosine-weighted (Jensen 1996, of corners), eight times at most: zones tell little of
/// differences within them. Not so where light would be lost: of a source that holds light straight from the
/// lamps, and with lamps without area where there are mirrors or glass.
class HitLight {
 public:
  HitLight(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
           const RecordOptions& resolved, std::uint64_t seed);
  ~HitLight();

  /// Diffuse places take the light of the lamps from there from now on, instead of from samples with shadow
  /// rays (null: from samples again). Lamps in gloss and in mirrors are still sampled. Holds a reference.
  void lamps_from(const LampLight* lamps);

  /// Memory and counts of one thread.
  struct Worker {
    Counters counters;
    std::vector<LampSight> sights;  ///< of the last shade(): the first `sight_count`
    std::size_t sight_count = 0;
    /// Light of a hit by other places on the lamps than those of its sights, as if nothing hid them.
    struct OtherLight {
      Rgb radiance{0};
      std::size_t first = 0, count = 0;  ///< sights of the hit
    };
    std::vector<OtherLight> other_light;
    bool tell_noise = false;  ///< of unstructured rays it is not known
    /// Of the last ray: light read from the source, f E, the part f^2 E of its noise; and where last, E
    /// (luminance), how far from the place before and at what cosine.
    struct Read {
      Rgb radiance{0}, noise{0};
      float lux = 0, distance_m = 0, cosine = 0;
      float told = 0, told_error = 0;  ///< luminance of f E where GatherSource::tell_common, and its error
    } read;
    Rgb hidden_radiance{0};                       ///< sum over those that something was in the way of
    std::uint64_t hidden = 0;                     ///< and how many they were, since last set to 0
    std::unique_ptr<Estimator::Worker> fallback;  // of GatherSource::fallback, made when it is first needed
    GlossCache::Worker gloss;
    CausticLight::Worker caustics;
    std::uint32_t dark = 0;  // places along a ray that no photons were found at
    std::uint64_t beyond_reach = 0, without_record = 0, without_radiance = 0;  // since counted
  };
  std::unique_ptr<Worker> make_worker() const;

  /// Has this material no other lobe than a diffuse one? Only its points leave sights.
  bool is_diffuse(std::uint32_t material) const;

  /// Sets radiance, distance_m, hit_normal, source and lamps of h from the hits of its rays (distance_m
  /// infinite: none), by samples of the lamps at each hit (LampSampler::samples(), low-discrepancy over
  /// the hits) and `source`. Lamps' own emission is left out: a record's direct light is computed apart.
  /// Random numbers depend on (seed, item, pass, ray).
  void shade(const Vec3& origin, std::span<const Hit> hits, std::uint64_t item, std::uint32_t pass,
             Hemisphere& h, Worker& worker) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline estimate
