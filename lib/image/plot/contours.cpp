#include "image/plot/contours.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "core/error.h"

namespace phos::inline image {

namespace {

constexpr std::size_t kNone = SIZE_MAX;

/// Points on edges of cells, each joined to one or two others.
class Net {
 public:
  Net(const GridField& field, double level) : field_(field), level_(level) {
    for (int y = 0; y + 1 < field.height; ++y)
      for (int x = 0; x + 1 < field.width; ++x) cell(x, y);
  }

  std::vector<std::vector<PlotPoint>> lines() {
    std::vector<std::vector<PlotPoint>> all;
    // Lines with ends first, from an end; the other lines are closed.
    std::vector<bool> seen(points_.size(), false);
    for (const bool closed : {false, true})
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (!seen[i] && (closed || points_[i].next[1] == kNone)) all.push_back(from(i, closed, seen));
    return all;
  }

 private:
  struct Joined {
    PlotPoint at;
    std::size_t next[2] = {kNone, kNone};
  };

  void cell(int x, int y) {
    const double v[4] = {field_.at(x, y), field_.at(x + 1, y), field_.at(x + 1, y + 1), field_.at(x, y + 1)};
    int above = 0;
    for (int i = 0; i < 4; ++i) {
      if (!std::isfinite(v[i])) return;
      above |= v[i] >= level_ ? 1 << i : 0;
    }
    if (above == 0 || above == 15) return;
    // Edges: 0 upper, 1 right, 2 lower, 3 left; edge i lies between the corners i and i + 1.
    std::size_t cut[4];
    int many = 0, edge[4];
    for (int i = 0; i < 4; ++i)
      if ((above >> i & 1) != (above >> (i + 1) % 4 & 1)) cut[i] = point(x, y, i, v), edge[many++] = i;
    if (many == 2) return join(cut[edge[0]], cut[edge[1]]);
    // Two lines: each cuts off a corner that the middle does not belong to.
    const bool middle = (v[0] + v[1] + v[2] + v[3]) / 4 >= level_;
    const bool cuts_first = middle != ((above & 1) != 0);
    join(cut[0], cut[cuts_first ? 3 : 1]), join(cut[2], cut[cuts_first ? 1 : 3]);
  }

  std::size_t point(int x, int y, int edge, const double (&v)[4]) {
    const bool across = edge % 2 == 0;
    const int px = x + (edge == 1 ? 1 : 0), py = y + (edge == 2 ? 1 : 0);
    const std::uint64_t key = 2 * (static_cast<std::uint64_t>(py) * static_cast<std::uint64_t>(field_.width) +
                                   static_cast<std::uint64_t>(px)) +
                              (across ? 0 : 1);
    const auto [found, fresh] = index_.try_emplace(key, points_.size());
    if (fresh) {
      // From the corner that is nearer to the origin, so that both cells of an edge have the same point.
      const int a = edge == 2 ? 3 : edge == 3 ? 0 : edge, b = edge == 2 ? 2 : edge == 3 ? 3 : edge + 1;
      const double t = (level_ / 2 - v[a] / 2) / (v[b] / 2 - v[a] / 2);  // halves: no overflow
      points_.push_back({{px + (across ? t : 0), py + (across ? 0 : t)}});
    }
    return found->second;
  }

  void join(std::size_t a, std::size_t b) {
    for (const auto& [from, to] : {std::pair{a, b}, {b, a}}) {
      std::size_t(&next)[2] = points_[from].next;
      PHOS_CHECK(next[1] == kNone, "an edge of three cells");
      next[next[0] == kNone ? 0 : 1] = to;
    }
  }

  std::vector<PlotPoint> from(std::size_t start, bool closed, std::vector<bool>& seen) const {
    std::vector<PlotPoint> line;
    std::size_t i = start;
    while (i != kNone) {
      seen[i] = true;
      line.push_back(points_[i].at);
      const std::size_t(&next)[2] = points_[i].next;
      i = next[0] != kNone && !seen[next[0]] ? next[0] : next[1] != kNone && !seen[next[1]] ? next[1] : kNone;
    }
    if (closed) line.push_back(line.front());
    return line;
  }

  const GridField& field_;
  double level_;
  std::unordered_map<std::uint64_t, std::size_t> index_;  ///< of an edge, in points_
  std::vector<Joined> points_;
};

}  // namespace

std::vector<std::vector<PlotPoint>> contour_lines(const GridField& field, double level) {
  PHOS_CHECK(field.width >= 0 && field.height >= 0 &&
                 field.values.size() ==
                     static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height),
             field.width, " x ", field.height, ", ", field.values.size());
  return Net(field, level).lines();
}

std::vector<double> round_levels(double most) {
  std::vector<double> levels;
  if (!(most > 0) || !std::isfinite(most)) return levels;
  const double decade = std::pow(10.0, std::floor(std::log10(most))), s = most / decade;
  const double step = (s < 1.5 ? 0.2 : s < 3 ? 0.5 : s < 7 ? 1 : 2) * decade;
  for (int k = 1; k * step < most; ++k) levels.push_back(k * step);
  return levels;
}

}  // namespace phos::inline image
