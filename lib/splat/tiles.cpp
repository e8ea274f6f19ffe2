#include "splat/tiles.h"

#include <algorithm>

#include "core/parallel.h"

namespace phos::inline splat {
namespace {

float distance_to(const Bounds& box, const Vec3& p) {
  return glm::length(glm::max(glm::max(box.lo - p, p - box.hi), Vec3(0)));
}

}  // namespace

TileGrid::TileGrid(const GBuffer& g, int tile_size)
    : size_(tile_size),
      width_(g.width),
      height_(g.height),
      columns_((g.width + tile_size - 1) / tile_size),
      rows_((g.height + tile_size - 1) / tile_size),
      tiles_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  parallel_for(static_cast<std::size_t>(rows_), 1, [&](std::size_t row) {
    const int first = static_cast<int>(row) * size_, last = std::min(first + size_, height_);
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < width_; ++x) {
        const auto i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (!g.covered(i)) continue;
        Tile& tile = tiles_[row * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x / size_)];
        tile.position.include(Vec3(g.position[i]));
        tile.normal.include(Vec3(g.normal[i]));
      }
    }
  });
}

bool TileGrid::touches(const IrradianceRecord& r, float accuracy, int column, int row) const {
  const Tile& tile = tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(column)];
  if (tile.position.empty()) return false;
  const float apart = distance_to(tile.position, r.position) / r.radius_m;
  // The margins cover the rounding of this bound and of the error it bounds.
  if (!(apart < accuracy * 1.0001f)) return false;
  return apart + turn_error(distance_to(tile.normal, r.normal)) < accuracy * 1.0001f + 1e-6f;
}

void TileGrid::cut(const IrradianceRecord& record, float accuracy, const PixelRect& bounds,
                   std::vector<PixelRect>& rects) const {
  rects.clear();
  const int end_column = (bounds.x1 + size_ - 1) / size_;
  const auto add = [&](const PixelRect& rect) {
    for (PixelRect& upper : rects) {
      if (upper.y1 != rect.y0 || upper.x0 != rect.x0 || upper.x1 != rect.x1) continue;
      upper.y1 = rect.y1;
      return;
    }
    rects.push_back(rect);
  };
  for (int row = bounds.y0 / size_; row * size_ < bounds.y1; ++row) {
    int start = -1;
    for (int column = bounds.x0 / size_; column <= end_column; ++column) {
      const bool in = column < end_column && touches(record, accuracy, column, row);
      if (in && start < 0) start = column;
      if (in || start < 0) continue;
      add({std::max(start * size_, bounds.x0), std::max(row * size_, bounds.y0),
           std::min(column * size_, bounds.x1), std::min((row + 1) * size_, bounds.y1)});
      start = -1;
    }
  }
}

std::vector<PixelRect> record_bounds(std::span<const IrradianceRecord> records, double accuracy,
                                     const Camera& camera, int width, int height) {
  const Projection projection(camera, width, height);
  std::vector<PixelRect> bounds(records.size());
  parallel_for(records.size(), 256, [&](std::size_t i) {
    const IrradianceRecord& r = records[i];
    if (drawable(r))
      bounds[i] = projection.sphere_bounds(r.position, accuracy * static_cast<double>(r.radius_m));
  });
  return bounds;
}

}  // namespace phos::inline splat
