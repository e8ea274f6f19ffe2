#include "splat/cpu/splatter.h"

#include "splat/cpu/splatter_kernel.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "core/processor.h"
#include "splat/tiles.h"

namespace phos::inline splat {
namespace {

/// Pixels of a tile in a picture: where its row y starts, and its numbers of columns and rows.
struct TileWindow {
  int x0, y0, columns, rows, width;
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x0 + x);
  }
};

void load(SplatTile& tile, const GBuffer& g, const TileWindow& window) {
  tile = {};
  for (int y = 0; y < window.rows; ++y) {
    for (int x = 0; x < window.columns; ++x) {
      const std::size_t i = window.pixel(x, y);
      const int t = y * kTileSide + x;
      tile.px[t] = g.position[i].x, tile.py[t] = g.position[i].y, tile.pz[t] = g.position[i].z;
      if (!g.covered(i)) continue;
      tile.nx[t] = g.normal[i].x, tile.ny[t] = g.normal[i].y, tile.nz[t] = g.normal[i].z;
    }
  }
}

void store(const SplatTile& tile, SplatBuffer& buffer, const TileWindow& window) {
  for (int y = 0; y < window.rows; ++y) {
    for (int x = 0; x < window.columns; ++x) {
      const std::size_t i = window.pixel(x, y);
      const int t = y * kTileSide + x;
      buffer.light[i] = {tile.light[0][t], tile.light[1][t], tile.light[2][t], tile.light[3][t]};
      buffer.error[i] = {tile.error[0][t], tile.error[1][t], tile.error[2][t], tile.error[3][t]};
      buffer.spread[i] = {tile.spread[0][t], tile.spread[1][t], tile.spread[2][t], 0};
    }
  }
}

}  // namespace

PackedRecord pack_record(const IrradianceRecord& r) {
  PackedRecord p{};
  // A tiny radius must not become infinite: 0 * infinity at the record itself is not a number.
  p.inverse_radius = std::min(1 / r.radius_m, std::numeric_limits<float>::max());
  p.front_limit_m = -kFrontTolerance * r.radius_m, p.over_limit_m = over_limit_m(r.distance_m, r.radius_m);
  p.weight = r.weight, p.shared = r.shared;
  for (int i = 0; i < 3; ++i) {
    p.position[i] = r.position[i], p.normal[i] = r.normal[i];
    p.irradiance[i] = r.irradiance[i], p.limit[i] = kGrowthLimit * r.irradiance[i],
    p.stderr_lx[i] = r.stderr_lx[i];
  }
  for (int c = 0; c < 3; ++c) {
    const Vec3 turn = glm::cross(r.rotation_gradient[c], r.normal);
    for (int i = 0; i < 3; ++i) p.turn[c][i] = turn[i], p.translation[c][i] = r.translation_gradient[c][i];
  }
  return p;
}

PackedFootprint pack_footprint(const IrradianceRecord& r) {
  const AdaptiveFootprint& f = *r.footprint;
  static_assert(PackedFootprint::kAxes == AdaptiveFootprint::kAxes);
  PackedFootprint p{};
  for (int i = 0; i < 3; ++i) p.x[i] = f.x()[i], p.y[i] = f.y()[i];
  p.inverse_shortest = std::min(1 / f.shortest_m(), std::numeric_limits<float>::max());
  p.per_radius = f.longest_m() / r.radius_m;
  for (int k = 0; k < PackedFootprint::kAxes; ++k) {
    const AdaptiveFootprint::Axis& axis = f.axes()[static_cast<std::size_t>(k)];
    p.inverse[k] = f.inverse_m()[static_cast<std::size_t>(k)];
    for (int c = 0; c < 3; ++c) {
      p.slope[c][k] = axis.slope[c], p.half_bend[c][k] = 0.5f * axis.bend[c];
      p.turn_slope[c][k] = axis.turn_slope[c], p.half_turn_bend[c][k] = 0.5f * axis.turn_bend[c];
    }
  }
  return p;
}

SplatKernels best_splat_kernels() {
#ifdef PHOS_SPLAT_AVX2
  if (has_avx2()) return {splat_tile_avx2, splat_footprint_avx2};
#endif
  return {splat_tile_plain, splat_footprint_plain};
}

Interpolated SplatBuffer::at(std::size_t i) const {
  Interpolated found;
  found.weight = light[i].w;
  if (!(found.weight > 0)) return {};
  found.sums.weight2 = spread[i].x, found.sums.shared = spread[i].y;
  found.sums.value2 = static_cast<double>(spread[i].z);
  found.irradiance = Rgb(light[i]) / found.weight;
  found.stderr_lx =
      blended_error(found.sums, found.weight, found.irradiance, Rgb(error[i]) / found.weight,
                    static_cast<double>(luminance(found.irradiance)) / static_cast<double>(unit_lx));
  return found;
}

float splat_unit_lx(std::span<const IrradianceRecord> records) {
  float most = 0;
  for (const IrradianceRecord& r : records) most = std::max(most, max_component(r.irradiance));
  return most > 0 && std::isfinite(most) ? most : 1;
}

SplatBuffer splat_on_cpu(std::span<const IrradianceRecord> records, double accuracy, const GBuffer& gbuffer,
                         const Camera& camera) {
  PHOS_CHECK(accuracy > 0 && std::isfinite(accuracy), "accuracy ", accuracy);
  const std::size_t pixels = gbuffer.position.size();
  SplatBuffer buffer;
  // Side by side: most of the time goes into the system's handing out of pages.
  std::vector<Vec4>* const sums[] = {&buffer.light, &buffer.error, &buffer.spread};
  parallel_for(3, 1, [&](std::size_t i) { sums[i]->assign(pixels, Vec4(0)); });
  if (pixels == 0 || records.empty()) return buffer;

  buffer.unit_lx = splat_unit_lx(records);
  const auto a = static_cast<float>(accuracy);
  const TileGrid grid(gbuffer, kTileSide);
  const std::vector<PixelRect> bounds =
      record_bounds(records, accuracy, camera, gbuffer.width, gbuffer.height);
  std::vector<PackedRecord> packed(records.size());
  parallel_for(records.size(), 1024, [&](std::size_t i) {
    if (drawable(records[i])) packed[i] = pack_record(records[i]);
  });

  const SplatKernels kernels = best_splat_kernels();
  const SplatRule rule{1 / a, kLeastWeight, 1 / buffer.unit_lx};
  // One row of tiles at a time. Each tile adds its records in their order, whoever draws it.
  parallel_for(static_cast<std::size_t>(grid.rows()), 1, [&](std::size_t tile_row) {
    const int row = static_cast<int>(tile_row), y0 = row * kTileSide;
    std::vector<std::vector<TileRecord>> lists(static_cast<std::size_t>(grid.columns()));
    for (std::size_t i = 0; i < records.size(); ++i) {
      const PixelRect& rect = bounds[i];
      if (rect.empty() || rect.y1 <= y0 || rect.y0 >= y0 + kTileSide) continue;
      const TileRecord reached{static_cast<std::uint32_t>(i),
                               static_cast<std::uint16_t>(std::max(rect.y0 - y0, 0) * kTileSide),
                               static_cast<std::uint16_t>(std::min(rect.y1 - y0, kTileSide) * kTileSide)};
      for (int column = rect.x0 / kTileSide; column * kTileSide < rect.x1; ++column) {
        if (grid.touches(records[i], a, column, row)) {
          lists[static_cast<std::size_t>(column)].push_back(reached);
        }
      }
    }
    SplatTile tile;
    for (int column = 0; column < grid.columns(); ++column) {
      const std::vector<TileRecord>& list = lists[static_cast<std::size_t>(column)];
      if (list.empty()) continue;
      const int x0 = column * kTileSide;
      const TileWindow window{x0, y0, std::min(kTileSide, gbuffer.width - x0),
                              std::min(kTileSide, gbuffer.height - y0), gbuffer.width};
      load(tile, gbuffer, window);
      // Runs of records of one kind, in their order.
      const auto shaped = [&](std::size_t k) { return records[list[k].record].footprint != nullptr; };
      for (std::size_t first = 0, last = 0; first < list.size(); first = last) {
        while (last < list.size() && shaped(last) == shaped(first)) ++last;
        if (!shaped(first)) {
          kernels.discs(tile, packed.data(), list.data() + first, last - first, rule);
          continue;
        }
        for (std::size_t k = first; k < last; ++k)
          kernels.footprint(tile, packed[list[k].record], pack_footprint(records[list[k].record]),
                            list[k].first, list[k].last, rule);
      }
      store(tile, buffer, window);
    }
  });
  return buffer;
}

}  // namespace phos::inline splat
