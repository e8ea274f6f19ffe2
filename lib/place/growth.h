// The cache while it grows: radii that neighbours and bounds settle, and the places that are covered.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/counters.h"
#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "place/neighbour_clamp.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"

namespace phos::inline place {

/// Bounds of every radius, m.
struct RadiusBounds {
  float least_m = 0, most_m = kInfinity;
};

/// A radius within the bounds of its record, and then of all.
float within_bounds_m(float radius_m, const Made& made, const RadiusBounds& bounds);

/// The least radius of a record with a footprint: its shortest axis keeps the least radius.
float least_radius_m(const RadiusBounds& bounds, const IrradianceRecord& shaped);

/// Final radii of records in the order in which they come (docs/methods.md#a7): clamped to their neighbours
/// as they were made, and only then to the bounds, so that a lower bound does not spread. Records with
/// footprints have looked in eight directions, and in bounds, when they were made: they neither clamp nor are
/// clamped.
class RadiusRules {
 public:
  /// `slope`: of the clamp, 1 or less.
  RadiusRules(const Bounds& scene, const RadiusBounds& bounds, ClampBy by = ClampBy::all, float slope = 1)
      : bounds_(bounds), clamp_(scene, by, slope) {}

  /// A record that stays as it is and clamps those after it.
  void keep(const IrradianceRecord& record);
  /// A new record. Returns its radius by now; calls shrunk(place in order, radius) for others that lose some.
  float add(const Made& made, const std::function<void(std::size_t, float)>& shrunk);
  /// Limits the radius of a new record (by its place in order) besides, but for the lower bounds. Returns its
  /// radius by now.
  float limit(std::size_t record, float radius_m);
  /// The same, and new records come to be clamped by it.
  float lower(std::size_t record, float radius_m);
  /// Appends the new records with their final radii. Where a lower bound is above the right radius, gradients
  /// are reduced so that extrapolation stays bounded. Of those that stand for radiance records, these are
  /// appended to `radiance` (if it is not null), treated alike.
  void finish(std::vector<IrradianceRecord>& records, std::vector<RadianceRecord>* radiance = nullptr);

  std::size_t size() const { return made_.size(); }
  /// The new records as they were made, in their order.
  std::span<const Made> made() const { return std::span(made_).subspan(kept_); }
  std::uint64_t clamped_to_neighbour() const { return clamped_to_neighbour_; }
  std::uint64_t raised_to_least() const { return raised_to_least_; }  ///< known after finish()
  void count_into(Counters& counters) const;                          ///< the same, as events

 private:
  float radius_m(std::size_t record) const;
  RadiusBounds bounds_;
  NeighbourClamp clamp_;
  std::vector<Made> made_;      // radius before clamping
  std::vector<float> limit_m_;  // per record; infinity: none
  std::size_t kept_ = 0;
  std::uint64_t clamped_to_neighbour_ = 0, raised_to_least_ = 0;
};

/// Bounds that resolved options set.
RadiusBounds bounds_of(const RecordOptions& resolved);

/// How radii come about.
enum class GrowthBy {
  rules,  ///< RadiusRules
  /// docs/methods.md#h7: records start with a reach of kStartReach times their harmonic distance (or the
  /// light's), whatever their gradients say, and are judged afterwards (Refinement). Records that were
  /// found to reach too far clamp new records by half of the distance between; other records clamp none, for
  /// at an edge the distance goes to zero, and all records about it would be small. Not of footprints.
  error,
};
/// In harmonic distances.
inline constexpr float kStartReach = 0.8f;

/// RadiusRules with a lookup of the places that the records so far cover.
class Growth {
 public:
  /// Takes the cache's own records as they are. Holds a reference to rays.
  Growth(const IrradianceCache& cache, const RayScene& rays, const RecordOptions& resolved,
         GrowthBy by = GrowthBy::rules);

  bool covered(const RecordSite& site) const { return tree_.covered(site.position, site.normal); }
  /// The same, with the record that covered a site near by (RecordTree::covered).
  bool covered(const RecordSite& site, std::size_t& record) const {
    return tree_.covered(site.position, site.normal, record);
  }
  void accept(const Made& made);
  /// From now on it is this pass, numbered from 1 on.
  void begin_pass(int number) { pass_ = number; }
  /// The last pass in or after which a record (by its place in tree()) has lost reach; 0: none.
  int shrunk_in(std::size_t record) const { return record < shrunk_in_.size() ? shrunk_in_[record] : 0; }
  /// Adaptive caching (Krivanek et al. 2006), of footprints that ask for it: a new record that foretells
  /// another's light wrongly, where it would be read, comes to reach less far: not there, but at least half
  /// as far as before. Wrong is by more than twice the stated errors of both and a share of the light, the
  /// tolerance. Returns how many have been shrunk; places that they covered may be open.
  std::size_t compare();
  /// Lowers the radius of a new record. False: bounds hold it where it is.
  bool lower(std::size_t record, float radius_m);
  std::size_t kept() const { return kept_; }  ///< the cache's own records, which come first
  const RecordTree& tree() const { return tree_; }
  RadiusRules& rules() { return rules_; }
  std::size_t size() const { return rules_.size(); }

 private:
  void shrink(std::size_t record, float radius_m);
  RecordTree tree_;
  RadiusRules rules_;
  std::optional<float> tolerance_;     // of compare(); none: records are not compared
  std::optional<RecordTree> as_read_;  // of those that are: each with the reach at which it is read
  float accuracy_, reading_accuracy_, most_m_;
  std::size_t kept_;
  GrowthBy by_;
  int pass_ = 1;
  std::vector<int> shrunk_in_;  // of records that have
};

}  // namespace phos::inline place
