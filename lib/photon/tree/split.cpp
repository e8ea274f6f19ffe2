#include "photon/tree/split.h"

#include <xmmintrin.h>

#include <algorithm>
#include <vector>

#include "core/parallel.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kChunk = 1 << 14;

/// The same swaps, once it is known which points take part.
template <class Before>
std::size_t partition_in_parallel(std::span<TreePoint> points, const Before& before) {
  const std::size_t n = points.size(), chunks = (n + kChunk - 1) / kChunk;
  std::vector<std::size_t> count(chunks);
  parallel_chunks(n, kChunk, [&](std::size_t begin, std::size_t end) {
    std::size_t own = 0;
    for (std::size_t i = begin; i < end; ++i) own += before(points[i]) ? 1 : 0;
    count[begin / kChunk] = own;
  });
  std::size_t first = 0;
  for (const std::size_t own : count) first += own;
  if (first == 0 || first == n) return first;
  // Of each chunk: how many misplaced points there are in it and, on the same side, before it (of the right
  // side: behind it).
  std::vector<std::size_t> on_left(chunks + 1), on_right(chunks + 1);
  const auto chunk_of = [&](std::size_t c) { return std::pair(c * kChunk, std::min(n, (c + 1) * kChunk)); };
  std::size_t border = 0;  // points `before` in the left part of the chunk that both sides share
  if (const auto [begin, end] = chunk_of(first / kChunk); begin < end)
    for (std::size_t i = begin; i < first; ++i) border += before(points[i]) ? 1 : 0;
  std::vector<std::size_t> left_of(chunks), right_of(chunks);
  for (std::size_t c = 0; c < chunks; ++c) {
    const auto [begin, end] = chunk_of(c);
    if (end <= first)
      left_of[c] = (end - begin) - count[c];
    else if (begin >= first)
      right_of[c] = count[c];
    else
      left_of[c] = (first - begin) - border, right_of[c] = count[c] - border;
  }
  for (std::size_t c = 0; c < chunks; ++c) on_left[c + 1] = on_left[c] + left_of[c];
  for (std::size_t c = chunks; c-- > 0;) on_right[c] = on_right[c + 1] + right_of[c];
  const std::size_t pairs = on_left[chunks];
  std::vector<std::uint32_t> left(pairs), right(pairs);
  parallel_chunks(n, kChunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t c = begin / kChunk, middle = std::clamp(first, begin, end);
    std::size_t l = on_left[c];
    if (left_of[c] > 0)
      for (std::size_t i = begin; i < middle; ++i)
        if (!before(points[i])) left[l++] = static_cast<std::uint32_t>(i);
    std::size_t r = on_right[c + 1];
    if (right_of[c] > 0)
      for (std::size_t i = end; i-- > middle;)
        if (before(points[i])) right[r++] = static_cast<std::uint32_t>(i);
  });
  parallel_for(pairs, kChunk, [&](std::size_t k) { std::swap(points[left[k]], points[right[k]]); });
  return first;
}

template <class Partition>
TreeSplit split_at(const SplitPlane& plane, std::span<TreePoint> points, const Partition& part) {
  const auto [axis, at] = plane;
  const std::size_t below = part(points, [=](const TreePoint& p) { return p.position[axis] < at; });
  const std::size_t not_above =
      below + part(points.subspan(below), [=](const TreePoint& p) { return p.position[axis] <= at; });
  return {axis, at, first_of_split(points.size(), below, not_above)};
}

}  // namespace

// The axis along which the box is widest; but one along which the box is wider than the points are along that
// one, if the points are, too.
SplitPlane split_plane(const Bounds& box, const Bounds& points) {
  const Vec3 about = box.hi - box.lo, extent = points.hi - points.lo;
  int widest = 0;
  for (int i = 1; i < 3; ++i)
    if (about[i] > about[widest]) widest = i;
  int axis = widest;
  for (int i = 0; i < 3; ++i)
    if (i != widest && about[i] > extent[axis] && extent[i] > extent[axis]) axis = i;
  return {axis, (points.lo[axis] + points.hi[axis]) / 2};
}

std::size_t first_of_split(std::size_t n, std::size_t below, std::size_t not_above) {
  const std::size_t half = n / 2;
  return below > half ? below : not_above < half ? not_above : half;
}

TreeSplit split_points(std::span<TreePoint> points, const Bounds& box) {
  return split_at(split_plane(box, tight_box(points)), points,
                  [](std::span<TreePoint> p, const auto& before) { return partition_points(p, before); });
}

TreeSplit split_points_in_parallel(std::span<TreePoint> points, const Bounds& box) {
  return split_at(
      split_plane(box, tight_box_in_parallel(points)), points,
      [](std::span<TreePoint> p, const auto& before) { return partition_in_parallel(p, before); });
}

Bounds tight_box(std::span<const TreePoint> points) {
  const auto load = [](const TreePoint& p) { return _mm_loadu_ps(&p.position.x); };
  // Of equal operands these give the second.
  __m128 lo = load(points[0]), hi = lo;
  for (const TreePoint& p : points.subspan(1)) lo = _mm_min_ps(load(p), lo), hi = _mm_max_ps(load(p), hi);
  float least[4], most[4];
  _mm_storeu_ps(least, lo), _mm_storeu_ps(most, hi);
  return {{least[0], least[1], least[2]}, {most[0], most[1], most[2]}};
}

Bounds tight_box_in_parallel(std::span<const TreePoint> points) {
  return parallel_reduce<Bounds>(
      points.size(), kChunk, tight_box(points.first(1)),
      [&](std::size_t begin, std::size_t end) { return tight_box(points.subspan(begin, end - begin)); },
      [](Bounds& all, const Bounds& part) { all = box_of_both(all, part); });
}

Bounds box_of_both(const Bounds& first, const Bounds& second) {
  Bounds box;
  for (int c = 0; c < 3; ++c) {
    box.lo[c] = std::min(first.lo[c], second.lo[c]);
    box.hi[c] = std::max(first.hi[c], second.hi[c]);
  }
  return box;
}

}  // namespace phos::inline photon
