// The kd-tree over photon positions. The only place that sees FLANN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"

namespace phos::inline file {
class ScratchFile;
}

namespace phos::inline photon {

/// Exact neighbour search over points that stay where they are: the tree refers to the span it was made with.
/// Queries are const and thread-safe. A tree of no points answers every query with nothing.
class KdTree {
 public:
  /// Coordinates beyond this (m) would overflow squared distances.
  static constexpr float kLargestCoordinate_m = 1e18f;
  /// Is each coordinate a number up to that?
  static bool in_range(const Vec3& point);

  KdTree();
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  /// Throws Error(numerical) for a coordinate that is not finite or larger than kLargestCoordinate_m, or for
  /// more than 2^31-1 points.
  static void require_fit(std::span<const Vec3> points);
  /// The same of a number of points that are in range.
  static void require_fit(std::size_t count);

  /// The same points give the same tree; in space_order() they are faster to build over, and to ask. Throws
  /// as require_fit().
  static KdTree build(std::span<const Vec3> points);

  /// The tree of save() over the same points. Whoever wrote `bytes`, FLANN, which trusts the bytes that it
  /// reads, sees them only once they are known to be a tree over these points (photon/tree/check.h). Throws
  /// Error(bad_input) naming `where` if they are not, or if a point is not finite.
  static KdTree load(std::span<const Vec3> points, std::span<const std::byte> bytes,
                     const std::string& where);

  /// Bytes for load(); none if there are no points.
  std::vector<std::byte> save() const;

  /// Appends to `saved` the bytes of save() over `count` points that need not fit in memory: `points` holds
  /// one TreePoint (photon/tree/split.h) for each, in order, and in another order afterwards. They must be in
  /// range. Holds about `memory_bytes`, and files beside `output`. Throws Error(bad_input) for a full disk.
  static void save_on_disk(ScratchFile& points, std::size_t count, std::uint64_t memory_bytes,
                           const std::string& output, ScratchFile& saved);

  /// Points with |p - point| <= radius_m, unsorted, replacing `rows`; nothing for a negative or NaN radius.
  void in_sphere(const Vec3& p, float radius_m, std::vector<std::uint32_t>& rows) const;
  /// The k nearest of those with |p - point| <= most_m (all if there are fewer), nearest first, equal
  /// distances by number.
  void nearest(const Vec3& p, std::size_t k, std::vector<std::uint32_t>& rows,
               std::vector<float>& distance2_m2, float most_m = std::numeric_limits<float>::infinity()) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline photon
