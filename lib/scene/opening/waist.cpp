#include "scene/opening/waist.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "scene/opening/cell_grid.h"
#include "scene/opening/room_box.h"

namespace phos::inline scene {
namespace {

/// A waist saves so much of the area before it at least.
constexpr double kLeastNarrowed = 0.1;
/// Parts of the lookers that may lie before a waist.
constexpr std::array kOutermost{0.002, 0.005, 0.01, 0.02, 0.05, 0.09};
constexpr double kMostLeft = 0.1;
constexpr int kCoarseCells = 32;

/// Area of the box that lookers see the sky through, in coarse cells.
double open_area_m2(std::span<const Looker> lookers, const Bounds& box) {
  std::vector<CellGrid> face;
  for (int f = 0; f < 6; ++f) face.emplace_back(face_of(box, f), kCoarseCells);
  for (const Looker& looker : lookers)
    for (const Vec3& direction : looker.sky) {
      const auto [f, place] = way_out(box, looker.position, direction);
      CellGrid& grid = face[static_cast<std::size_t>(f)];
      if (grid.crosses_clearly(direction)) grid.open(grid.cell_at(place));
    }
  double sum = 0;
  for (const CellGrid& grid : face)
    for (std::size_t cell = 0; cell < grid.size(); ++cell)
      if (grid.is_open(cell)) sum += grid.rectangle().area_m2() / static_cast<double>(grid.size());
  return sum;
}

/// All but the share that lies outermost on one side, and the places in one plane with that share.
std::vector<Looker> without_outermost(std::span<const Looker> lookers, int axis, float side, double share) {
  std::vector<float> out;
  for (const Looker& looker : lookers) out.push_back(side * looker.position[axis]);
  const auto last =
      out.begin() + static_cast<std::ptrdiff_t>((1 - share) * static_cast<double>(out.size() - 1));
  std::nth_element(out.begin(), last, out.end());
  std::vector<Looker> rest;
  std::copy_if(lookers.begin(), lookers.end(), std::back_inserter(rest),
               [&](const Looker& looker) { return side * looker.position[axis] < *last; });
  return rest;
}

}  // namespace

void draw_to_waists(std::vector<Looker>& lookers) {
  for (bool found = true; found && !lookers.empty();) {
    found = false;
    const Bounds box = box_about(lookers);
    double most_saved_m2 = 0;
    std::vector<Looker> best;
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.f, 1.f})
        for (const double share : kOutermost) {
          std::vector<Looker> rest = without_outermost(lookers, axis, side, share);
          const auto left = static_cast<double>(lookers.size() - rest.size());
          if (rest.empty() || left > kMostLeft * static_cast<double>(lookers.size())) continue;
          const double before_m2 = open_area_m2(rest, box),
                       saved_m2 = before_m2 - open_area_m2(rest, box_about(rest));
          if (!(saved_m2 > std::max(most_saved_m2, kLeastNarrowed * before_m2))) continue;
          most_saved_m2 = saved_m2, best = std::move(rest), found = true;
        }
    if (found) lookers = std::move(best);
  }
}

}  // namespace phos::inline scene
