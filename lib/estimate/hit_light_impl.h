// How gathered rays are lit where they land. Private to HitLight.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "direct/image_sampler.h"
#include "direct/lamp_sampler.h"
#include "direct/lamp_sequence.h"
#include "estimate/hit_light.h"
#include "scene/material/bsdf.h"

namespace phos::inline estimate {

/// One hit in so many is lit from other places too, to tell their noise.
inline constexpr std::uint32_t kOfWhichOneTells = 4;
/// Walks over gloss and mirrors, and reflections at places that are followed, are survived at most so often.
inline constexpr float kMostSurvival = 0.999f;
/// A ray's walks are cut after so many places without photons: such places lie within a body, which rays
/// enter by cracks and light does not.
inline constexpr std::uint32_t kMostDark = 8;

/// A ray of a record's pass.
struct RayName {
  std::uint64_t item;
  std::uint32_t pass, ray;

  /// Numbers it for random streams of its own (Steele et al. 2014, SplitMix64).
  std::uint64_t key() const {
    std::uint64_t z = item + 0x9e3779b97f4a7c15u * (std::uint64_t{pass} << 32 | ray | 1u << 31);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
};

inline bool positive(const Rgb& c) { return c.x > 0 || c.y > 0 || c.z > 0; }

struct HitLight::Impl {
  const RayScene& rays;
  const Scene& scene;
  const Luminaires& lights;
  GatherSource source;
  std::uint64_t seed;
  std::int64_t bounces;
  LampSampler lamps;
  const LampLight* told = nullptr;  // the lamps' light, where it is not sampled
  ImageSampler images;
  bool caustics_apart;
  bool follow_near;  // places near by are followed instead of read
  /// The facts of a material that do not depend on the point.
  struct Surface {
    bool diffuse = false;   // it has no other lobe
    bool constant = false;  // its reflectance is the same all over, but for vertex colours
    Rgb reflectance{0};
    bool straight = false;  // rays may pass straight through it
  };
  std::vector<Surface> surface;  // per material

  Impl(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
       const RecordOptions& resolved, std::uint64_t seed);

  bool reads_cache(std::int64_t bounces_left) const {
    return bounces_left != 1 && (source.indirect || source.fallback);
  }
  /// Is the light of lamps' images, at a place so many reflections from the record, in no source there?
  bool lacks_images(std::int64_t bounces_left) const {
    return !images.empty() && (reads_cache(bounces_left) ? source.lacks_images : bounces_left != 1);
  }
  Rgb arriving(const ArrivingLight& light) const {
    return light.certain ? Rgb(1) : rays.transmittance(light.ray);
  }
  Rgb cached_lx(const SurfacePoint& point, std::uint64_t item, Worker& worker) const;
  Rgb reflectance(const SurfacePoint& point) const;
  static LocalDensity caustic(const CausticLight* light, const SurfacePoint& point, float other_lx,
                              Worker& worker);
  bool counts_lamps_in_mirrors(std::uint32_t followed) const;
  bool is_near(const SurfacePoint& point, const Rgb& lux) const;
  double common_error(const SurfacePoint& point) const;
  Rgb indirect(const SurfacePoint& point, const Vec3& wo, const Rgb& f, const RayName& ray,
               std::uint32_t followed, Worker& worker) const;
  Rgb from_diffuse(const SurfacePoint& point, const Vec3& wo, const LampSequence& lamp_points,
                   const RayName& ray, Worker& worker) const;
  /// Where a ray ends that goes straight through panes.
  struct Landing {
    float distance_m = kInfinity;
    Vec3 normal{0};
  };
  /// A Walk.
  Rgb from_any(const Ray& start, const Rgb& throughput, const RayName& ray, std::uint32_t followed,
               Worker& worker, Landing* landing = nullptr) const;

  struct Walk;
  struct Step;
  std::optional<Rgb> recorded(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                              std::int64_t bounces_left, Worker& worker) const;
  bool choose_step(const Bsdf& bsdf, const Vec3& wo, bool follow_gloss, RandomStream& random,
                   Step& step) const;
  Rgb beyond(const SurfacePoint& point, const Step& step) const;
  Rgb gloss_of_lamp(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, float gloss_probability,
                    RandomStream& random) const;
  Rgb from_images(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, std::int64_t bounces_left,
                  bool gloss_known, RandomStream& random) const;
};

/// The next ray of a walk over gloss, mirrors and glass.
struct HitLight::Impl::Step {
  Vec3 direction{0};
  Rgb weight{0};
  float density = 0;            // per sr, the choice of the lobe included; 0: mirror or glass
  float gloss_probability = 0;  // with which the glossy lobes are followed
  bool taken = false;
  bool straight = false;  // through a pane: no event
  bool mirror = false;    // reflected without a lobe
};

}  // namespace phos::inline estimate
