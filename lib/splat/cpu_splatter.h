// The inner loop of the CPU splatter: plain arrays only, because it is compiled twice (for x86-64-v3, and for
// any machine) and shares no inline function with the rest. Both give the same bits: no contraction, no
// reassociation.
#pragma once

#include <cstddef>
#include <cstdint>

namespace phos {

struct IrradianceRecord;

inline constexpr int kTileSide = 16, kTilePixels = kTileSide * kTileSide;

/// Positions and normals of a tile's pixels, and the sums of SplatBuffer, side by side. Pixels in which
/// nothing is visible have a zero normal.
struct alignas(64) SplatTile {
  float px[kTilePixels], py[kTilePixels], pz[kTilePixels];
  float nx[kTilePixels], ny[kTilePixels], nz[kTilePixels];
  float light[4][kTilePixels], error[4][kTilePixels], spread[3][kTilePixels];
};

/// An IrradianceRecord as the loop wants it. front_limit_m = -tolerance * radius; over_limit_m is that of
/// record_apart(); turn = g_r x n_i, so that the change by rotation, (n_i x n).g_r, is (n - n_i).turn.
struct PackedRecord {
  float position[3], inverse_radius, normal[3], front_limit_m;
  float irradiance[3], weight, limit[3], stderr_lx[3], shared;
  float turn[3][3], over_limit_m, translation[3][3];
};
PackedRecord pack_record(const IrradianceRecord& record);

using SplatKernel = void(SplatTile& tile, const PackedRecord* records, const std::uint32_t* list,
                         std::size_t count, float inverse_accuracy, float least_weight, float per_unit);

/// Adds the listed records in order to a tile.
/// `per_unit` is 1 / SplatBuffer::unit_lx.
SplatKernel splat_tile_plain;
#ifdef PHOS_SPLAT_AVX2
SplatKernel splat_tile_avx2;
#endif
/// The fastest one that this machine can run.
SplatKernel* best_splat_kernel();

}  // namespace phos
