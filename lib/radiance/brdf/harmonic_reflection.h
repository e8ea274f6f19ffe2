// One material's reflection of light from one direction, through harmonics.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/counters.h"
#include "hsh/rotation.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/table.h"

namespace phos::inline radiance {

/// Through which harmonics.
struct ReflectionHarmonics {
  BasisKind basis = BasisKind::hsh;
  int order = 7;
  bool cosine = true;   ///< the projected lobe is f times the cosine of the incident direction; else f alone
  int resolution = 32;  ///< of the table of directions of view (BrdfTable)
  /// HSH alone: the method that rotates the light's harmonics to the surface's frame, from a frame whose z
  /// axis points to the light. Empty: the light is projected in the surface's frame, without a rotation.
  std::optional<HshRotation> rotation = {};
};

/// The BRDF of a material without its delta lobes: a table of its harmonics over the directions of view. Its
/// value is the sum of c_i(wo) H_i(wi) (Gautron et al. 2004, eq. 16 and figure 6). Holds references to
/// nothing. Const, usable from any thread.
class HarmonicReflection {
 public:
  /// Counted as project_brdf() does. Throws Error(usage) for an order outside 1 .. 30 or a resolution outside
  /// 2 .. 1024.
  HarmonicReflection(const Scene& scene, std::uint32_t material, const ReflectionHarmonics& through,
                     Counters& counters);

  /// f(wo, wi) cos(theta_i) of the bands, RGB, 1/sr; below 0 where the bands ring. Local frame, z the normal,
  /// unit, both above the horizon (z > 0). Nothing where the lobe was too intricate to project.
  std::optional<Rgb> operator()(const Vec3& wo, const Vec3& wi) const;

 private:
  std::vector<float> harmonics_of_light(const Vec3& wi) const;

  ReflectionHarmonics through_;
  BrdfTable table_;
  HarmonicBasis<float> basis_;
  std::optional<HshRotator> rotator_;
};

}  // namespace phos::inline radiance
