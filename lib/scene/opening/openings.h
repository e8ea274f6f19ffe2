// Parts of a rectangle through which the sky is seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/opening/cell_grid.h"
#include "scene/opening/lookers.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Parts a rectangle into cells and finds those through which lookers see the sky: they look at places of the
/// cells. A cell that is found has all closed neighbours looked at more often, by the lookers that have seen
/// the sky beside it, until no further cell is found: so an opening is found whole wherever a part is. Same
/// for any number of threads.
class Openings {
 public:
  /// `number` tells the random numbers of several searches apart. References must outlive it.
  Openings(const RayScene& rays, std::span<const Looker> lookers, const Portal& rectangle, int side,
           std::uint64_t number);

  /// A looker has seen the sky in a direction, through this place of the rectangle.
  void mark(std::size_t looker, const Vec3& direction, const Vec3& place);
  /// Has every cell looked at, by all lookers and by the lookers of `knowing`.
  void look(std::span<const std::uint32_t> knowing);
  /// Has the neighbours of open cells looked at, until nothing is found.
  void grow();
  /// Rectangles that hold the open cells and a row of cells about them; see CellGrid::open_rectangles().
  std::vector<Portal> rectangles(double least_saved) const;
  /// Lookers that have seen the sky through cells of a part of the rectangle, a few of each cell.
  std::vector<std::uint32_t> witnesses(const Portal& part) const;

 private:
  static constexpr std::uint32_t kNobody = 0xffffffffu;
  void open(std::size_t cell, std::uint32_t looker);
  std::uint32_t find_looker(std::size_t cell, std::uint32_t looks,
                            std::span<const std::uint32_t> knowing) const;
  std::vector<std::uint32_t> look_at(std::span<const std::size_t> cells, std::uint32_t looks,
                                     std::span<const std::span<const std::uint32_t>> knowing);

  const RayScene& rays_;
  std::span<const Looker> lookers_;
  CellGrid grid_;
  std::vector<std::vector<std::uint32_t>> witness_;  // of each cell
  std::uint64_t number_;
  std::uint32_t round_ = 0;
};

}  // namespace phos::inline scene
