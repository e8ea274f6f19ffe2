// Gradients of irradiance from the photons of one zone.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"

namespace phos {

/// The photons of a zone, as columns. Directions and normals are world space and unit.
struct ZonePhotons {
  std::vector<Vec2> offset_m;           ///< on the tangent plane, from the zone's centre
  std::vector<Rgb> flux_lm;             ///< per unit of tangent-plane area
  std::vector<Vec3> direction;          ///< towards where it came from
  std::vector<float> inverse_distance;  ///< 1/m; 0 from infinitely far
  std::vector<Vec3> source_normal;      ///< of the surface it left; minus `direction` where there is none
  std::size_t size() const { return offset_m.size(); }
  /// Row `from` takes the place of row `to`.
  void move(std::size_t from, std::size_t to) {
    offset_m[to] = offset_m[from], flux_lm[to] = flux_lm[from], direction[to] = direction[from];
    inverse_distance[to] = inverse_distance[from], source_normal[to] = source_normal[from];
  }
  void resize(std::size_t n) {
    offset_m.resize(n), flux_lm.resize(n), direction.resize(n), inverse_distance.resize(n),
        source_normal.resize(n);
  }
  void clear() {
    offset_m.clear(), flux_lm.clear(), direction.clear(), inverse_distance.clear(), source_normal.clear();
  }
};

/// How gradients are made. Photons allow analytic (their default), hemisphere, positional, blend and none;
/// hemispheres of rays allow hybrid (their default), analytic, ward_heckbert, krivanek and none.
enum class GradientMode {
  automatic,      ///< the estimator's default
  analytic,       ///< each photon's or ray's own term (FORMULAS D2; RR-5264, B4): blind to occlusion
  hybrid,         ///< analytic, and occlusion from neighbouring rays (B5)
  ward_heckbert,  ///< differences between neighbouring rays (Ward and Heckbert 1992, B2)
  krivanek,       ///< moving cell walls (Krivanek et al. 2005, B3)
  hemisphere,  ///< thesis 6.3: photons binned in a discretised hemisphere, differences between its cells (D1,
               ///< B1, B2)
  positional,  ///< first moment of where photons landed (D3): sees all occlusion, at much noise
  blend,       ///< analytic, moved towards positional as far as the two differ beyond noise (D4)
  none,
};
const char* name_of(GradientMode mode);

/// Rows are channels, as in IrradianceRecord.
struct Gradients {
  Vec3 rotation[3]{Vec3(0), Vec3(0), Vec3(0)};     ///< lx/rad
  Vec3 translation[3]{Vec3(0), Vec3(0), Vec3(0)};  ///< lx/m, tangent to the surface
};

/// Relative change of the light that arrives along unit `w` from a surface of unit normal `source_normal` per
/// metre of movement of the receiver, 1/m, tangent to `normal` (FORMULAS B4, D2; the emitter's cosine is kept
/// above 0.1). `inverse_distance` is in 1/m, 0 from infinitely far; -w stands for a normal that there is not.
Vec3 translation_term(const Vec3& w, const Vec3& source_normal, float inverse_distance, const Vec3& normal);

/// Relative change of the light that arrives along unit `w` as the receiver turns, per radian, for use with
/// (normal x new normal): the mean of tan(theta) over the ring of eight in which w lies, across w (B1), so
/// that grazing light has bounded weight.
Vec3 rotation_term(const Vec3& w, const Vec3& normal);

/// T_j of B1: mean of tan(theta), cosine-weighted, over ring `ring` of `rings` of equal projected solid
/// angle.
double ring_tangent(int ring, int rings);

/// translation_term of photon i.
inline Vec3 photon_translation_term(const ZonePhotons& photons, std::size_t i, const Vec3& normal) {
  return translation_term(photons.direction[i], photons.source_normal[i], photons.inverse_distance[i],
                          normal);
}

/// Sums over the photons with used[i] != 0, divided by `area_m2`. Rotation: ring means of the tangent on 8
/// rings (B1), so that grazing photons have bounded weight. Blind to dark occluders (D4).
Gradients photon_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                           const Frame& frame);

/// The same from `rings` x round(pi rings) cells of equal projected solid angle. Empty cells are dark and
/// infinitely far.
Gradients hemisphere_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                               const Frame& frame, int rings);

}  // namespace phos
