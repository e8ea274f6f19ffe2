// Lookup of irradiance records: an octree.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/vector.h"
#include "record/irradiance_cache.h"

namespace phos::inline scene {
class RayScene;
}

namespace phos::inline record {

struct RecordIndex;

/// Lookup structure over records: point queries in any order and from any thread; records may be added
/// serially.
class RecordTree {
 public:
  /// With `leak_test`, a record is valid only where no surface stands between it and the point (a ray per
  /// record and query; the tree holds a reference).
  RecordTree(const Bounds& bounds, double accuracy, const RayScene* leak_test = nullptr);
  ~RecordTree();
  RecordTree(RecordTree&&) noexcept;
  void insert(const IrradianceRecord& record);
  /// Gives a record (by its place in records()) a smaller radius; a larger one is our mistake.
  void shrink(std::size_t record, float radius_m);
  std::size_t size() const;
  std::span<const IrradianceRecord> records() const;
  /// Is any record valid at p, n? (docs/methods.md#a3)
  bool covered(const Vec3& p, const Vec3& n) const;
  /// The same. `record`, one of records() or any number beyond them, is asked first; it becomes the one that
  /// was found, which is likely to cover the next point too.
  bool covered(const Vec3& p, const Vec3& n, std::size_t& record) const;
  /// The irradiance of interpolate() alone, lx, without the cost of its errors. `weight` becomes the sum of
  /// weights; 0: a miss.
  Rgb irradiance(const Vec3& p, const Vec3& n, float& weight) const;
  /// The records valid at p, n, replacing the records in `found`; pointers last until the next insert().
  void valid(const Vec3& p, const Vec3& n, std::vector<const IrradianceRecord*>& found) const;
  Interpolated interpolate(const Vec3& p, const Vec3& n) const;
  /// Adds the records valid at p, n; finish() is the caller's.
  void add(const Vec3& p, const Vec3& n, Interpolated& sum) const;
  /// Adds the records valid at p, n that are no farther from it across their planes than `most_height`
  /// (height_over()); with a leak test, no more than the heaviest kMostInSight (record/in_sight.h) of them.
  /// finish() is the caller's.
  void add_few(const Vec3& p, const Vec3& n, Interpolated& sum, float most_height) const;
  /// A tree of the same records. Each reaches `factor` times as far, in every direction (all_around) or along
  /// its tangent plane only (along_plane): then a place may be no farther off that plane than in this tree.
  enum class Widen { all_around, along_plane };
  RecordTree widened(double factor, Widen widen = Widen::all_around) const;
  /// The same cells as columns.
  RecordIndex index() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline record
