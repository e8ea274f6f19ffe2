// Square blocks of a G-buffer with bounds on the visible surfaces in them, so that records are only drawn
// where they can weigh something.
#pragma once

#include <span>
#include <vector>

#include "record/irradiance_cache.h"
#include "splat/gbuffer.h"
#include "splat/projection.h"

namespace phos::inline splat {

class TileGrid {
 public:
  TileGrid(const GBuffer& gbuffer, int tile_size);

  int tile_size() const { return size_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// May the record weigh anything in the tile? A lower bound of record_error over the tile's positions and
  /// normals is compared with the accuracy; never false for a record that is valid at one of its pixels.
  bool touches(const IrradianceRecord& record, float accuracy, int column, int row) const;

  /// Cuts a record's rectangle down to the tiles that it touches: runs along each row of tiles, joined with
  /// the row above where they are alike. `rects`, in pixels, do not overlap.
  void cut(const IrradianceRecord& record, float accuracy, const PixelRect& bounds,
           std::vector<PixelRect>& rects) const;

 private:
  struct Tile {
    Bounds position, normal;
  };
  int size_, width_, height_, columns_, rows_;
  std::vector<Tile> tiles_;
};

/// Can the record be drawn at all (positive radius)?
inline bool drawable(const IrradianceRecord& r) { return r.radius_m > 0; }

/// Pixel bounds of each record's zone of influence, radius accuracy * radius_m.
std::vector<PixelRect> record_bounds(std::span<const IrradianceRecord> records, double accuracy,
                                     const Camera& camera, int width, int height);

}  // namespace phos::inline splat
