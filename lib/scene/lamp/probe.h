// Rays that leave the lamps, to look at where their light goes. Estimates of light are made from other rays
// (photon/emission.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "scene/lamp/luminaires.h"

namespace phos::inline scene {

/// A lamp as people name it: a light of the scene; of an environment, its sun and the rest, each apart.
struct Lamp {
  enum class Part : std::uint8_t { whole, sun, sky };
  std::string name;  ///< of the light; "sun" for a sun
  std::size_t light = 0;
  Part part = Part::whole;
};
std::vector<Lamp> lamps_of(const Scene& scene);

/// A ray along which a lamp's light leaves it.
struct ProbeRay {
  Ray ray;
  double flux_lm =
      0;  ///< luminance of RGB; its mean over many rays is the lamp's flux. 0: no light goes there
  // How large the lamp is, as seen from where the ray leads.
  double seen_m2 = 0;  ///< area across the ray, of lamps at a finite distance; 0: a point
  double seen_sr = 0;  ///< solid angle, of lamps infinitely far away; 0: a single direction
};

/// Of an environment the solid angle is the one that would hold all light of the part if it were as bright
/// as where the ray comes from. Its rays start from the scene's bounding disc or, where the scene has
/// portals, on these. Holds references.
class LampProbe {
 public:
  LampProbe(const Scene& scene, const Luminaires& luminaires) : scene_(&scene), luminaires_(&luminaires) {}
  /// The numbers of ray `number` of a lamp. sample() draws from bounce 0; the others are for later bounces.
  static RandomStream stream(const Lamp& lamp, std::uint32_t number);
  ProbeRay sample(const Lamp& lamp, RandomStream& random) const;

 private:
  ProbeRay from_area(std::size_t light, RandomStream& random) const;
  ProbeRay from_opening(const Light& light, std::size_t i, RandomStream& random) const;
  ProbeRay from_beyond(const Lamp& lamp, RandomStream& random) const;
  ProbeRay from_infinity(const Vec3& direction, double lux, RandomStream& random) const;
  ProbeRay from_portal(const Vec3& direction, double lux, RandomStream& random) const;

  const Scene* scene_;
  const Luminaires* luminaires_;
};

}  // namespace phos::inline scene
