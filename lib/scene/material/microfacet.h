// The GGX distribution of microfacets, and Fresnel's equations. Directions are local, z the normal.
#pragma once

#include "core/vector.h"

namespace phos::inline scene {

/// Trowbridge-Reitz (GGX) with roughness alpha along x and y (Walter et al. 2007; anisotropic: Burley 2012).
struct Ggx {
  float alpha_x, alpha_y;
  /// Density of microfacet normals per sr of h and per unit of macroscopic area.
  float distribution(const Vec3& h) const;
  /// Height-correlated Smith shadowing over 4 cos_o cos_i (Heitz 2014, eq. 99), 1/sr when multiplied by D;
  /// o.z, i.z > 0.
  float visibility(const Vec3& o, const Vec3& i) const;
  /// Normal seen from o, o.z > 0 (Heitz 2018).
  Vec3 sample_visible(const Vec3& o, const Vec2& u) const;
  /// Density, per sr of i, of reflecting o about sample_visible(o).
  float density(const Vec3& o, const Vec3& i) const;
};

/// (1 - c)^5 of Schlick's approximation, c clamped to [0,1].
inline float schlick_power(float cos_theta) {
  const float m = std::fmin(std::fmax(1 - cos_theta, 0.f), 1.f);
  return (m * m) * (m * m) * m;
}

/// Unpolarised reflectance of a smooth boundary; `eta` = index beyond / index on this side. 1 under total
/// reflection. `cos_t` receives the cosine of the refracted direction (0 under total reflection).
float fresnel_dielectric(float cos_i, float eta, float& cos_t);

/// Albedo of a GGX surface whose Fresnel term is f0 + (f90 - f0)(1-c)^5: f0 A + f90 B, from a table made on
/// first use by quadrature. Linear between its entries, which errs on the side of more albedo.
float ggx_albedo(float cos_theta, float alpha, float f0, float f90);
/// Its cosine-weighted mean over the hemisphere.
float ggx_mean_albedo(float alpha, float f0, float f90);

}  // namespace phos::inline scene
