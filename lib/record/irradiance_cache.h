// Irradiance records: their content, their file, and interpolation between them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"
#include "file/kinds/tensor_io.h"
#include "record/blend.h"
#include "record/footprint.h"
#include "record/header.h"
#include "record/weight.h"

namespace phos::inline photon {
struct CausticPhotons;
}
namespace phos::inline scene {
class RayScene;
}

namespace phos::inline record {

/// One record. Gradients are absolute (docs/methods.md#a5), world space: row c is the gradient of channel c.
struct IrradianceRecord {
  Vec3 position{0};      ///< m
  Vec3 normal{0, 0, 1};  ///< unit, on the side it lights
  Rgb irradiance{0};     ///< lx
  Rgb stderr_lx{0};      ///< standard error of irradiance
  /// Part of its variance that records about it have too (0 to 1), so that it does not average out.
  float shared = kSharedByZones;
  float distance_m = kInfinity;  ///< mean distance of the surroundings (docs/methods.md#a7, #c6), unclamped
  float radius_m = 0;            ///< R of the weight; the zone of influence is accuracy * radius, at most
  Vec3 rotation_gradient[3]{Vec3(0), Vec3(0), Vec3(0)};  ///< lx per radian: E += dot(cross(n_i, n), g_r)
  Vec3 translation_gradient[3]{Vec3(0), Vec3(0),
                               Vec3(0)};  ///< lx/m: E += dot(p - p_i, g_t); tangent to the surface
  /// Its share among others, in (0, 1]: less for a record of a film that fades in or out. Of no influence
  /// where it is alone. Not in files.
  float weight = 1;
  /// Its shape, and how its light changes in it; null: a disc, and the gradients above.
  std::shared_ptr<const AdaptiveFootprint> footprint{};
};

struct IrradianceCache {
  std::vector<IrradianceRecord> records;
  double accuracy = 0.2;  ///< a that placed them
  std::string scene_hash;
  Quantity quantity = Quantity::indirect;
  /// Caustic photons, where records hold no caustic light (RecordOptions::caustics_apart): readers add it at
  /// each point (estimate/caustic_light.h). Null: it is in the records.
  std::shared_ptr<const CausticPhotons> caustics{};
};

/// Throws Error(mismatch), naming `where`, if of two caches that are read together one holds caustic light in
/// its records and the other does not.
void require_same_caustics(bool apart, bool other_apart, const std::string& where);

/// Says in a header that caustic light is apart; adds its photons. Nothing where it is not.
void add_caustics(const std::shared_ptr<const CausticPhotons>& caustics, TensorWriter& file,
                  Provenance& provenance);
/// Null: the records of the file hold it.
std::shared_ptr<const CausticPhotons> caustics_of(const Container& file);

/// The accuracy a for reading records that were placed with accuracy `placed`. Placement leaves few records
/// about a point, which show their noise; where more are blended it averages out (as Tabellion and Lamorlette
/// 2004 do). Up to 2.5 times `placed`, but no farther than `most`, where blur begins to outweigh the noise
/// that it takes away (measured), or `placed`.
inline double reading_accuracy(double placed, double most = 0.5) {
  return std::min(2.5 * placed, std::max(placed, most));
}

/// Has any of them a footprint?
bool any_footprint(std::span<const IrradianceRecord> records);

/// Appends the records of another cache of the same light, each with the reach that it was placed with. Where
/// both have caustic photons, the photons of `all` stay.
void append(IrradianceCache& all, const IrradianceCache& more);

/// Throws Error(bad_input) with the remedy, unless the file, which holds records, is of this form.
void require_form(FileForm form, const Container& file);

/// The file also holds an index (record/index.h) where there are many records of a cache.
/// The part of their variance that records share is in it where it is not kSharedByZones for all.
/// Of a part of a run it holds the least radii that neighbours leave instead; of a film, `more` columns.
void write_irradiance(const std::string& path, const IrradianceCache& cache, Provenance provenance,
                      std::span<const float> least_radius_m = {},
                      TensorWriter more = TensorWriter(FileKind::irradiance));
/// Reads one file; throws Error(bad_input) for a damaged one (checksums verified, non-finite rows named), a
/// part or a film.
IrradianceCache read_irradiance(const Container& file);

/// The records of a file, read where they lie. Copies share the mapping.
class RecordColumns {
 public:
  /// Throws Error(bad_input) like read_irradiance, or for a file of another form.
  explicit RecordColumns(const Container& file, FileForm form = FileForm::whole);
  std::size_t size() const { return size_; }
  double accuracy() const { return accuracy_; }
  Quantity quantity() const { return quantity_; }
  const Container& file() const { return file_; }
  Vec3 position(std::size_t i) const { return vector(position_, i); }
  Vec3 normal(std::size_t i) const { return vector(normal_, i); }
  float radius_m(std::size_t i) const { return radius_[i]; }
  const AdaptiveFootprint* footprint(std::size_t i) const {
    return footprints_.empty() ? nullptr : footprints_[i].get();
  }
  IrradianceRecord operator[](std::size_t i) const;
  /// All of them, in memory.
  IrradianceCache cache() const;

 private:
  static Vec3 vector(const float* v, std::size_t i) { return {v[3 * i], v[3 * i + 1], v[3 * i + 2]}; }
  Container file_;
  std::size_t size_ = 0;
  double accuracy_ = 0;
  Quantity quantity_ = Quantity::indirect;
  const float *position_, *normal_, *irradiance_, *stderr_, *distance_, *radius_, *rotation_, *translation_;
  const float* shared_ = nullptr;                                     // not in every file
  std::vector<std::shared_ptr<const AdaptiveFootprint>> footprints_;  // likewise
};

/// How far p lies off a record's plane, on either side, in units of its radius.
inline float height_over(const IrradianceRecord& r, const Vec3& p) {
  return std::fabs(glm::dot(p - r.position, r.normal)) / r.radius_m;
}
/// eps (docs/methods.md#a1): |p - p_i|/R_i + |n - n_i|/sqrt(2); R_i is the radius in the direction of p where
/// the record has a footprint.
inline float record_error(const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  if (r.footprint) return r.footprint->error(p - r.position, n, r.normal, r.radius_m);
  return disc_error(p - r.position, n - r.normal, r.radius_m);
}
/// Of the direction in which the record reaches least far.
inline float least_radius_m(const IrradianceRecord& r) {
  return r.footprint ? r.radius_m * (r.footprint->shortest_m() / r.footprint->longest_m()) : r.radius_m;
}
/// Does the record lie where it must not light p, whatever its weight? In front of p's surface
/// (docs/methods.md#a6); so deep that p is over its plane by more than over_limit_m(); or where dot(n, n_i)
/// <= 0.
bool record_apart(const IrradianceRecord& r, const Vec3& p, const Vec3& n);
/// What rises above a straight line over a surface by less than this share of its length is unevenness of the
/// surface (facets under smooth normals), no wall.
inline constexpr float kRoughness = 0.125f;
/// Can the record and a point p that faces n see each other? Both ends are raised along their normals by the
/// rounding of positions and by the height of the ridge between two flat pieces with these normals that meet
/// halfway; if that is not clear, by kRoughness of their distance, but no more than halfway to the surface
/// above them, so that neither flat nor gently curved surfaces stand in their own way, and thin walls do.
bool record_in_sight(const RayScene& rays, const IrradianceRecord& r, const Vec3& p, const Vec3& n);
/// docs/methods.md#a5: E_i + (n_i x n).g_r + (p - p_i).g_t per channel, limited to [0, 2 E_i]; or E_i +
/// change() of its footprint, which has been tested, at least 0. lx
inline Rgb extrapolate(const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  const Vec3 step = p - r.position;
  if (r.footprint) return glm::max(r.irradiance + r.footprint->change(step, n), Rgb(0));
  const Vec3 turning = glm::cross(r.normal, n);
  Rgb e;
  for (int c = 0; c < 3; ++c)
    e[c] = carried_light(r.irradiance[c], turning, r.rotation_gradient[c], step, r.translation_gradient[c],
                         kGrowthLimit * r.irradiance[c]);
  return e;
}

/// Weight (docs/methods.md#a4): 1 - eps/a, in [0,1]; 0 = not valid. The one used by every splatter and
/// lookup.
inline float record_weight(float eps, float accuracy) { return weight_left(eps, accuracy, 0); }

/// The weight of a record that serves a disc at p, n; 0 beyond its reach. No footprint gives it more.
inline float weight_at(const Vec3& record_position, const Vec3& record_normal, float radius_m, float accuracy,
                       const Vec3& p, const Vec3& n) {
  const Vec3 d = p - record_position;
  const float reach = accuracy * radius_m;
  if (!(glm::dot(d, d) < reach * reach)) return 0;
  return record_weight(disc_error(d, n - record_normal, radius_m), accuracy);
}

/// The same of a record with a footprint, which weight_at() of its longest axis has let pass.
inline float weight_within(const AdaptiveFootprint& footprint, const IrradianceRecord& r, float accuracy,
                           const Vec3& p, const Vec3& n) {
  return record_weight(footprint.error(p - r.position, n, r.normal, r.radius_m), accuracy);
}

struct Interpolated {
  Rgb irradiance{0};  ///< lx
  Rgb stderr_lx{0};   ///< of the mean of records (blended_error)
  float weight = 0;   ///< sum of weights; 0: a miss
  BlendSums sums;

  /// Adds the light that a valid record states at the point p that faces n; until finish(), irradiance and
  /// the records' own errors are sums.
  void add(const IrradianceRecord& r, float w, const Vec3& p, const Vec3& n) {
    const Rgb e = extrapolate(r, p, n);
    irradiance += w * e;
    stderr_lx += w * r.stderr_lx;
    weight += w;
    sums.add(w, r.shared, static_cast<double>(luminance(e)));
  }
  void finish() {
    if (!(weight > 0)) return;
    irradiance /= weight, stderr_lx /= weight;
    stderr_lx =
        blended_error(sums, weight, irradiance, stderr_lx, static_cast<double>(luminance(irradiance)));
  }
};

}  // namespace phos::inline record
