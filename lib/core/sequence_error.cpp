#include "core/sequence_error.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/sampling.h"

namespace phos {
namespace {

/// Measured gains: of integrands that are smooth, and of those with edges, over the square.
constexpr double kSmooth = 0.12, kEdges = 0.45;
/// The same of a lamp of many parts, each of which has its own even points.
constexpr double kSmoothInParts = 0.08;
/// (Mean of |difference|)^2 / mean of its square, at which each is taken to be had: 2 / pi where differences
/// are normal, next to nothing where a few are all.
constexpr double kOfSmooth = 0.55, kOfEdges = 0.25;
/// From this part of what any two samples differ by, on the mean, neighbours tell less and less of each
/// other.
constexpr double kRelated = 0.6;
/// Where a few samples are most of the sum, there may be others that have been missed.
constexpr double kMissed = 2;

double between(double x, double lo, double hi) { return std::clamp((x - lo) / (hi - lo), 0.0, 1.0); }

/// Of half the mean square of differences between neighbours: `evenness` is the ratio above, `roughness` that
/// of their mean square to the one of any two samples.
double gain(double evenness, double roughness, bool in_plane) {
  const double uneven = 1 - between(evenness, kOfEdges, kOfSmooth);
  const double smooth = in_plane ? kSmooth : kSmoothInParts;
  const double related = smooth + uneven * (kEdges - smooth), alone = 1 + uneven * (kMissed - 1);
  const double rough = between(roughness, kRelated, 1);
  return related + rough * (alone - related);
}

constexpr std::array<std::size_t, 32> kPadovan{1,   2,    3,    4,    5,    7,    9,    12,   16,   21,   28,
                                               37,  49,   65,   86,   114,  151,  200,  265,  351,  465,  616,
                                               816, 1081, 1432, 1897, 2513, 3329, 4410, 5842, 7739, 10252};

/// The largest three of them that leave 4/10 of n points a neighbour; at least the first.
std::span<const std::size_t> neighbours(std::size_t n) {
  std::size_t end = 1;
  while (end < kPadovan.size() && 10 * kPadovan[end] <= 6 * n) ++end;
  const std::size_t count = std::min<std::size_t>(end, 3);
  return std::span(kPadovan).subspan(end - count, count);
}

DVec3 independent(std::span<const DVec3> parts) {
  const auto n = static_cast<double>(parts.size());
  DVec3 sum(0), squares(0);
  for (const DVec3& p : parts) sum += p, squares += p * p;
  return glm::max(n * squares - sum * sum, DVec3(0)) / (n - 1);
}

/// Sums over pairs of neighbours.
struct Differences {
  DVec3 squares{0}, sizes{0};  // means over sets of pairs
  double sets = 0;

  /// Those of each point and partner(k), in [0, n).
  template <typename Partner>
  void add(std::span<const DVec3> parts, const Partner& partner) {
    DVec3 square(0), size(0);
    double pairs = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::size_t other = partner(k);
      if (other <= k || other >= parts.size()) continue;
      const DVec3 change = parts[k] - parts[other];
      square += change * change, size += glm::abs(change), pairs += 1;
    }
    if (pairs > 0) squares += square / pairs, sizes += size / pairs, sets += 1;
  }
};

/// Digits by which the indices of neighbours among 2^bits points differ: the two that move a point least, of
/// 8 points the one.
constexpr std::size_t kLeastSobol = 8;
struct Digits {
  std::size_t mask[2] = {0, 0};
};
Digits nearest_digits(int bits) {
  const int n = 1 << bits;
  std::array<std::pair<float, int>, 2> nearest{{{2.f, 0}, {2.f, 0}}};
  for (int k = 1; k < n; ++k) {
    const Vec2 p = sobol_point(k, 0, 0);
    const std::pair<float, int> found{std::max(p.x, p.y), k};
    if (found < nearest[1]) nearest[1] = found;
    if (nearest[1] < nearest[0]) std::swap(nearest[0], nearest[1]);
  }
  const auto mask = [&](int i) {
    return static_cast<std::size_t>(nearest[static_cast<std::size_t>(i)].second);
  };
  return {{mask(0), n > static_cast<int>(kLeastSobol) ? mask(1) : 0}};
}
/// Of the greatest power of two that is not above n, or 4096.
const Digits& neighbour_digits(std::size_t n) {
  constexpr std::size_t kMost = 12;
  static const auto table = [] {
    std::array<Digits, kMost + 1> all;
    for (std::size_t bits = 3; bits <= kMost; ++bits) all[bits] = nearest_digits(static_cast<int>(bits));
    return all;
  }();
  return table[std::min<std::size_t>(std::bit_width(n) - 1, kMost)];
}

}  // namespace

DVec3 sequence_variance(std::span<const DVec3> parts, bool in_plane, const PointOrder& order) {
  const std::size_t n = parts.size();
  if (n < 2) return DVec3(0);
  const bool sobol = order.kind == PointOrder::Kind::sobol;
  if (n < (sobol ? kLeastSobol : 4)) return independent(parts);
  Differences found;
  if (!in_plane) {
    found.add(parts, [](std::size_t k) { return k + 1; });
  } else if (sobol) {
    const auto first = static_cast<std::size_t>(order.first);
    for (const std::size_t mask : neighbour_digits(n).mask)
      if (mask != 0) found.add(parts, [&](std::size_t k) { return ((first + k) ^ mask) - first; });
  } else {
    for (const std::size_t lag : neighbours(n)) found.add(parts, [&](std::size_t k) { return k + lag; });
  }
  if (found.sets == 0) return independent(parts);
  const DVec3 squares = found.squares / found.sets, sizes = found.sizes / found.sets;
  const DVec3 all = independent(parts), near = static_cast<double>(n) / 2 * squares;
  DVec3 variance(0);
  for (int c = 0; c < 3; ++c)
    if (squares[c] > 0 && all[c] > 0)
      variance[c] = gain(sizes[c] * sizes[c] / squares[c], near[c] / all[c], in_plane) * near[c];
  return variance;
}

}  // namespace phos
