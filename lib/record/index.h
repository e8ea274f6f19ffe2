// Read-only lookup of records as columns, which a file of many records holds, so that a program that opens
// the file builds none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "record/irradiance_cache.h"

namespace phos::inline record {

/// Cells of an octree lie at most this deep; points and zones beyond the root fall into its border cells.
inline constexpr int kDeepestCell = 40;
/// Octant of a point in a cell with this middle.
inline unsigned octant_of(const DVec3& p, const DVec3& middle) {
  return (p.x >= middle.x ? 1u : 0u) | (p.y >= middle.y ? 2u : 0u) | (p.z >= middle.z ? 4u : 0u);
}
/// Lower corner of an octant whose side is `half`.
inline DVec3 corner_of(const DVec3& cell_lo, double half, unsigned o) {
  return cell_lo + half * DVec3(o & 1u ? 1 : 0, o & 2u ? 1 : 0, o & 4u ? 1 : 0);
}

/// RecordTree's octree as columns. Cells are numbered breadth first, so that the children of one follow each
/// other and first children only grow: columns that violate this are no tree, and are refused.
struct RecordIndex {
  std::array<double, 4> box{0, 0, 0, 1};  ///< lower corner and side of the root, m
  std::vector<std::uint8_t> children;     ///< per cell: bit o tells whether octant o has a cell
  std::vector<std::uint32_t> cell;        ///< per cell, and once after the last: first child, first entry
  std::vector<std::uint32_t> entry;       ///< numbers of records, cell after cell
};

/// Files of fewer records have no index: it is made in memory sooner than one looks.
inline constexpr std::size_t kIndexedRecords = 1 << 16;

/// Name of the accuracy, in the header, that a file's index was made for.
inline constexpr const char* kIndexAccuracy = "index_accuracy";

/// Depends on the records and their order alone.
RecordIndex index_records(std::span<const IrradianceRecord> records, double accuracy);
/// As tensors index_box, index_children, index_cells and index_entries; `index` must live until write().
void add_index(TensorWriter& file, const RecordIndex& index);

/// Lookup in a file's records where they lie: the same sums as RecordTree at their reading_accuracy(). Any
/// thread, any order.
class RecordLookup {
 public:
  /// Throws Error(bad_input) for damaged records or a damaged index. A file without index, or with
  /// one for another accuracy, gets one in memory.
  /// Keeps the mapping open; holds a reference to `leak_test` (see RecordTree).
  explicit RecordLookup(const Container& file, const RayScene* leak_test = nullptr);
  const RecordColumns& records() const { return records_; }
  double accuracy() const { return accuracy_; }  ///< at which they are read
  /// Does the index come from the file?
  bool stored() const { return made_.children.empty(); }
  bool covered(const Vec3& p, const Vec3& n) const;
  Interpolated interpolate(const Vec3& p, const Vec3& n) const;
  /// As RecordTree's.
  void add_few(const Vec3& p, const Vec3& n, Interpolated& sum, float most_height = kInfinity) const;

 private:
  template <class Visit>
  void visit_unseen(const Vec3& p, const Vec3& n, const Visit& visit) const;
  void use_stored();
  void check_stored() const;
  RecordColumns records_;
  const RayScene* leak_test_;
  double accuracy_;
  RecordIndex made_;  // empty if the file has its own
  DVec3 lo_{0};
  double side_m_ = 1;
  std::span<const std::uint8_t> children_;
  std::span<const std::uint32_t> cell_, entry_;
};

}  // namespace phos::inline record
