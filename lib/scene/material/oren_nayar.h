// Rough matt surfaces: Oren and Nayar's model, with all light that goes from facet to facet.
#pragma once

#include "core/vector.h"

namespace phos::inline scene {

/// The energy-preserving Oren-Nayar model (Portsmouth, Kutz and Hill 2025, "EON", docs/methods.md#m1):
/// single reflection by Fujii's form of Oren and Nayar's qualitative model (1994), multiple reflection in
/// closed form. It is reciprocal and never negative; a white surface reflects all light, and others at most
/// kd, from every direction. Directions are local, z the normal.
class OrenNayar {
 public:
  OrenNayar() = default;  ///< reflects nothing
  /// `kd`: reflectance of a facet. `sigma_rad`: standard deviation of the facets' slope angle, as Oren and
  /// Nayar have it.
  OrenNayar(const Rgb& kd, float sigma_rad);
  /// EON's roughness, 0 for Lambert, below 0.9: gives its lobe the contrast of the qualitative model.
  static float roughness(float sigma_rad);
  bool rough() const { return roughness_ > 0; }
  Rgb value(const Vec3& o, const Vec3& i) const;  ///< 1/sr
  Rgb albedo(float cosine) const;                 ///< reflectance of light from (or towards) there
  Rgb mean_albedo() const;                        ///< over all directions, cosine-weighted
  /// Only a share of the surface is there.
  void cover(float share) { single_ *= share, multiple_ *= share; }

 private:
  Rgb single_{0}, multiple_{0};  // 1/sr
  float roughness_ = 0;
};

struct ReflectionSummary;
struct SummaryInput;
ReflectionSummary summarise_oren_nayar(const SummaryInput&);

}  // namespace phos::inline scene
