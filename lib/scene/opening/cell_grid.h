// A rectangle parted into equal cells, some of which are open.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/opening/portal.h"

namespace phos::inline scene {

class CellGrid {
 public:
  /// `side` x `side` cells; all are closed.
  CellGrid(const Portal& rectangle, int side);

  std::size_t size() const { return open_.size(); }
  const Portal& rectangle() const { return rectangle_; }
  bool is_open(std::size_t cell) const { return open_[cell] != 0; }
  void open(std::size_t cell) { open_[cell] = 1; }
  bool any_open() const;
  /// Does a line cross the rectangle outwards, not along it? Lines along it carry little light, and cross it
  /// far from the opening before it.
  bool crosses_clearly(const Vec3& direction) const;

  /// The cell that holds a place of the rectangle; of places beyond it, the nearest.
  std::size_t cell_at(const Vec3& place) const;
  /// A place in a cell, by weights of its sides from 0 to 1.
  Vec3 place_in(std::size_t cell, const Vec2& weight) const;
  /// The cells that touch one, at an edge or a corner.
  std::vector<std::size_t> neighbours(std::size_t cell) const;

  /// Opens all neighbours of open cells.
  void widen();
  /// Rectangles that hold all open cells, few of them: a rectangle is cut in two where that saves at least
  /// `least_saved` of its cells.
  std::vector<Portal> open_rectangles(double least_saved) const;

 private:
  struct Cells {
    int u, v, wide, high;
    int count() const { return wide * high; }
  };
  Cells trimmed(const Cells& c) const;
  void cut(const Cells& all, double least_saved, std::vector<Cells>& out) const;
  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v * side_ + u); }
  int u_of(std::size_t cell) const { return static_cast<int>(cell) % side_; }
  int v_of(std::size_t cell) const { return static_cast<int>(cell) / side_; }

  Portal rectangle_;
  int side_;
  std::vector<std::uint8_t> open_;
};

}  // namespace phos::inline scene
