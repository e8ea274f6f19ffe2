// Gradients of irradiance from the photons of one zone.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"

namespace phos::inline estimate {

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
  analytic,       ///< each photon's or ray's own term (docs/methods.md#d2, #b4): blind to occlusion
  hybrid,         ///< analytic, and occlusion from neighbouring rays (docs/methods.md#b5)
  ward_heckbert,  ///< differences between neighbouring rays (Ward and Heckbert 1992, docs/methods.md#b2)
  krivanek,       ///< moving cell walls (Krivanek et al. 2005, docs/methods.md#b3)
  hemisphere,     ///< photons binned in a hemisphere, differences between its cells (docs/methods.md#d1)
  positional,     ///< first moment of where photons landed (docs/methods.md#d3): sees all occlusion, noisy
  blend,          ///< analytic, moved to positional where they differ beyond noise (docs/methods.md#d4)
  none,
};
const char* name_of(GradientMode mode);

/// Rows are channels, as in IrradianceRecord.
struct Gradients {
  Vec3 rotation[3]{Vec3(0), Vec3(0), Vec3(0)};     ///< lx/rad
  Vec3 translation[3]{Vec3(0), Vec3(0), Vec3(0)};  ///< lx/m, tangent to the surface
};

/// Relative change of the light that arrives along unit `w` from a surface of unit normal `source_normal` per
/// metre of movement of the receiver, 1/m, tangent to `normal` (docs/methods.md#b4, #d2; the emitter's cosine
/// is kept above 0.1). `inverse_distance` is in 1/m, 0 from infinitely far; -w stands for a normal that there
/// is not.
Vec3 translation_term(const Vec3& w, const Vec3& source_normal, float inverse_distance, const Vec3& normal);

/// Relative curvature of the same light: its Laplacian over the receiver's plane over itself, 1/m2. Of light
/// that falls with the p-th power of the distance D and the emitter's cosine, with t for tangential parts:
/// (2 p n_t.w_t / cos xi - 2 p + p (p + 2) w_t.w_t) / d2, p = 4 (the two cosines included); of a light
/// without surface (source_normal = -w) p = 3 and no term of n. With `step_m`, in the receiver's plane, the
/// Laplacian is taken at a place so far away, still over the irradiance here; the source counts as no nearer
/// to that place than half of the distance.
float curvature_term(const Vec3& w, const Vec3& source_normal, float inverse_distance, const Vec3& normal,
                     const Vec3& step_m = Vec3(0));

/// Relative change of the light that arrives along unit `w` as the receiver turns, per radian, for use with
/// (normal x new normal): the mean of tan(theta) over the ring of eight in which w lies, across w
/// (docs/methods.md#b1), so that grazing light has bounded weight.
Vec3 rotation_term(const Vec3& w, const Vec3& normal);

/// T_j (docs/methods.md#b1): mean of tan(theta), cosine-weighted, over ring `ring` of `rings` of equal
/// projected solid angle.
double ring_tangent(int ring, int rings);

/// translation_term of photon i.
inline Vec3 photon_translation_term(const ZonePhotons& photons, std::size_t i, const Vec3& normal) {
  return translation_term(photons.direction[i], photons.source_normal[i], photons.inverse_distance[i],
                          normal);
}

/// Sums over the photons with used[i] != 0, divided by `area_m2`. Rotation: ring means of the tangent on 8
/// rings (docs/methods.md#b1), so that grazing photons have bounded weight. Blind to dark occluders
/// (docs/methods.md#d4).
Gradients photon_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                           const Frame& frame);

/// Where the photons of a zone can have landed: on all of a flat shape, and nowhere else.
struct ZoneShape {
  glm::dvec2 centroid_m{0};         ///< from the zone's centre
  glm::dmat2 second_moments_m4{0};  ///< integral of (x - centroid)(x - centroid)^T over its area
};
ZoneShape disc_shape(double radius_m);
/// The exact shape of a polygon, `vertices` (rows of `points`) in order either way round: Hull::vertices.
ZoneShape polygon_shape(std::span<const Vec2> points, std::span<const std::uint32_t> vertices);

/// Above this z2 photons say that dark occluders, which the analytic gradient cannot see, make a gradient
/// here: the record should reach less far (docs/methods.md#d4).
inline constexpr double kOccludedZ2 = 12;

struct ComparedGradients {
  Gradients analytic;    ///< photon_gradients
  Gradients positional;  ///< translation by where photons landed (docs/methods.md#d3); rotation as analytic
  Gradients blend;       ///< moved from analytic to positional by max(0, 1 - 3 / z2) (docs/methods.md#d4)
  double z2 = 0;  ///< squared difference of the two translations of luminance over its variance: 1 by chance
};

/// Gradients with and without occlusion, and whether they differ. `photons.offset_m` and `shape` have the
/// same origin. `used` must be all photons that landed inside of `shape`, without those that decided its
/// outline:
///  - all of the zone lies on the surface and was counted (ZoneKind::full or few): disc_shape(zone's radius);
///  - ZoneKind::hull: polygon_shape of the hull, `used` without the hull's vertices, as DensityScratch has
///  it.
/// Where part of the shape is not surface (area_m2 below the shape's area), positions tell of the border and
/// not of light: do not use. Positional has standard error 2 E / (R sqrt(n)) per axis on a disc; a shape
/// without extent in some direction, or no photon, gives positional = blend = analytic, z2 = 0.
ComparedGradients compare_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used,
                                    double area_m2, const Frame& frame, const ZoneShape& shape);

/// The same from `rings` x round(pi rings) cells of equal projected solid angle. Empty cells are dark and
/// infinitely far.
Gradients hemisphere_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                               const Frame& frame, int rings);

}  // namespace phos::inline estimate
