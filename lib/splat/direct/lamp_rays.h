// Shadow rays towards lamps, sent together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scene/lamp/form.h"
#include "scene/lamp/luminaires.h"
#include "scene/lamp/panel.h"
#include "scene/rays.h"

namespace phos::inline splat {

/// What rays to one lamp found.
struct LampVisibility {
  float seen = 0,
        sent = 0;  ///< sums of projected solid angles over density, of the rays that arrive and of all
  std::uint32_t rays = 0;
};

/// Sums of the light that they brought, lx, and of its squares, for lamps without closed form.
struct Brought {
  Rgb light{0};
  DVec3 light2{0};
};

/// The same of several places, weighted.
struct PooledVisibility {
  float seen = 0, sent = 0, rays = 0, rays2 = 0;
  Rgb light{0};
  DVec3 light2{0};
  void add(const LampVisibility& s, float weight);
  void add(const Brought& b, float weight);
  /// Of the lamp, as seen; there must be rays that were sent.
  float share() const { return seen / sent; }
  /// Variance of `share`, as these rays would find it.
  float variance_of(float share) const { return share * (1 - share) / std::max(independent() - 1, 1.f); }
  float independent() const { return rays * rays / rays2; }
};

/// Illuminance of a diffuse visible surface, and the variance of that, lx and lx^2.
struct SharedLight {
  Rgb illuminance{0};
  DVec3 variance{0};
  /// Adds a lamp without closed form: the mean light of the rays.
  void add_mean(const PooledVisibility& found);
  /// Adds one of which a share is seen, with its variance.
  void add_share(const Rgb& whole_lx, float share, float variance);
};

/// The lamps of a scene, as shadow rays are aimed at them. Holds references.
struct AimedLamps {
  AimedLamps(const RayScene& rays, const Luminaires& lights);
  const RayScene& rays;
  const Luminaires& lights;
  std::vector<LampPanel> panel;  ///< per lamp; empty where Luminaires chooses its points
  std::vector<LampForm> form;    ///< per lamp
  /// Per lamp: would it have a closed form, were there no panes? Such a lamp's light is even but for shadows.
  std::vector<std::uint8_t> even;
};

/// Rays on their way. Holds a reference.
class LampRays {
 public:
  explicit LampRays(const AimedLamps& lamps) : lamps_(lamps) {}
  /// A ray from p to the place on a lamp that numbers in [0, 1] choose; to a lamp without an area, of which a
  /// ray brings everything. `sight`, and `brought` unless it is null, must live until send(); where rays are
  /// many, some are sent before.
  void aim(std::size_t lamp, const SurfacePoint& p, float u_triangle, const Vec2& u, LampVisibility& sight,
           Brought* brought);
  /// Gives each sight the result of the rest of its rays.
  void send();

 private:
  struct Aim {
    LampVisibility* sight;
    Brought* brought;
    float weight;
    Rgb brings{0};
  };
  void add(const Ray& ray, const Aim& aim);

  const AimedLamps& lamps_;
  std::vector<Ray> ray_;
  std::vector<Aim> aim_;
  std::vector<Rgb> share_;
};

}  // namespace phos::inline splat
