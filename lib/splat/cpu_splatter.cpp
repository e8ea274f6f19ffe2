#include "splat/cpu_splatter.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "splat/splatter.h"
#include "splat/tiles.h"

namespace phos {
namespace {

/// Pixels of a tile in a picture: where its row y starts, and how many columns and rows of it there are.
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

/// A record with a footprint, which the kernel knows nothing of.
void add_footprint(SplatTile& tile, const IrradianceRecord& r, float accuracy, float per_unit) {
  const float reach_m = accuracy * r.radius_m;
  for (int t = 0; t < kTilePixels; ++t) {
    const Vec3 p(tile.px[t], tile.py[t], tile.pz[t]), n(tile.nx[t], tile.ny[t], tile.nz[t]),
        step = p - r.position;
    if (!(glm::dot(step, step) < reach_m * reach_m)) continue;
    float w = weight_within(*r.footprint, r, accuracy, p, n);
    if (!(w > kLeastWeight) || record_apart(r, p, n)) continue;
    w *= r.weight;
    const Rgb e = extrapolate(r, p, n);
    for (int c = 0; c < 3; ++c) tile.light[c][t] += w * e[c], tile.error[c][t] += w * r.stderr_lx[c];
    tile.light[3][t] += w, tile.error[3][t] += w > 0 ? 1.f : 0.f;
    const float value = luminance(e) * per_unit;
    tile.spread[0][t] += w * w, tile.spread[1][t] += w * r.shared, tile.spread[2][t] += w * value * value;
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

SplatKernel* best_splat_kernel() {
#ifdef PHOS_SPLAT_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) {
    return splat_tile_avx2;
  }
#endif
  return splat_tile_plain;
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

  SplatKernel* const kernel = best_splat_kernel();
  // One row of tiles at a time. Each tile adds its records in their order, whoever draws it.
  parallel_for(static_cast<std::size_t>(grid.rows()), 1, [&](std::size_t tile_row) {
    const int row = static_cast<int>(tile_row), y0 = row * kTileSide;
    std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(grid.columns()));
    for (std::size_t i = 0; i < records.size(); ++i) {
      const PixelRect& rect = bounds[i];
      if (rect.empty() || rect.y1 <= y0 || rect.y0 >= y0 + kTileSide) continue;
      for (int column = rect.x0 / kTileSide; column * kTileSide < rect.x1; ++column) {
        if (grid.touches(records[i], a, column, row)) {
          lists[static_cast<std::size_t>(column)].push_back(static_cast<std::uint32_t>(i));
        }
      }
    }
    SplatTile tile;
    for (int column = 0; column < grid.columns(); ++column) {
      const std::vector<std::uint32_t>& list = lists[static_cast<std::size_t>(column)];
      if (list.empty()) continue;
      const int x0 = column * kTileSide;
      const TileWindow window{x0, y0, std::min(kTileSide, gbuffer.width - x0),
                              std::min(kTileSide, gbuffer.height - y0), gbuffer.width};
      load(tile, gbuffer, window);
      // Runs of records of one kind, in their order.
      const auto shaped = [&](std::size_t k) { return records[list[k]].footprint != nullptr; };
      for (std::size_t first = 0, last = 0; first < list.size(); first = last) {
        while (last < list.size() && shaped(last) == shaped(first)) ++last;
        if (!shaped(first)) {
          kernel(tile, packed.data(), list.data() + first, last - first, 1 / a, kLeastWeight,
                 1 / buffer.unit_lx);
          continue;
        }
        for (std::size_t k = first; k < last; ++k)
          add_footprint(tile, records[list[k]], a, 1 / buffer.unit_lx);
      }
      store(tile, buffer, window);
    }
  });
  return buffer;
}

}  // namespace phos
