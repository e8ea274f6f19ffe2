// The inner loops of the CPU splatter: plain arrays only, because they are compiled twice (for x86-64-v3, and
// for any machine) and share no inline function with the rest. Both give the same bits: no contraction, no
// reassociation.
#pragma once

#include <cstddef>
#include <cstdint>

namespace phos::inline record {
struct IrradianceRecord;
}

namespace phos::inline splat {

inline constexpr int kTileSide = 16, kTilePixels = kTileSide * kTileSide;

/// Positions and normals of a tile's pixels, and the sums of SplatBuffer, side by side. Pixels in which
/// nothing is visible have a zero normal.
struct alignas(64) SplatTile {
  float px[kTilePixels], py[kTilePixels], pz[kTilePixels];
  float nx[kTilePixels], ny[kTilePixels], nz[kTilePixels];
  float light[4][kTilePixels], error[4][kTilePixels], spread[3][kTilePixels];
};

/// An IrradianceRecord as the loop wants it. front_limit_m = -tolerance * radius; over_limit_m is the limit
/// of record_apart(); turn = g_r x n_i, so that the change by rotation, (n_i x n).g_r, is (n - n_i).turn.
struct PackedRecord {
  float position[3], inverse_radius, normal[3], front_limit_m;
  float irradiance[3], weight, limit[3], stderr_lx[3], shared;
  float turn[3][3], over_limit_m, translation[3][3];
};
PackedRecord pack_record(const IrradianceRecord& record);

/// An AdaptiveFootprint as its loop wants it: its frame, and of each axis the inverse of its length and, by
/// colour, AdaptiveFootprint::Axis with bends halved. per_radius = longest axis / radius.
struct PackedFootprint {
  static constexpr int kAxes = 8;
  float x[3], y[3], inverse_shortest, per_radius;
  float inverse[kAxes], slope[3][kAxes], half_bend[3][kAxes], turn_slope[3][kAxes], half_turn_bend[3][kAxes];
};
/// Of a record that has one.
PackedFootprint pack_footprint(const IrradianceRecord& record);

/// A record and the rows of a tile that it may reach, as a range of the tile's pixels.
struct TileRecord {
  std::uint32_t record;
  std::uint16_t first = 0, last = kTilePixels;
};

/// What is the same for all records: least_weight = kLeastWeight, per_unit = 1 / SplatBuffer::unit_lx.
struct SplatRule {
  float inverse_accuracy, least_weight, per_unit;
};

/// Adds the listed records in order to a tile. None of them has a footprint.
using SplatKernel = void(SplatTile& tile, const PackedRecord* records, const TileRecord* list,
                         std::size_t count, const SplatRule& rule);
/// Adds a record with a footprint to the pixels [first, last) of a tile.
using FootprintKernel = void(SplatTile& tile, const PackedRecord& record, const PackedFootprint& footprint,
                             int first, int last, const SplatRule& rule);

SplatKernel splat_tile_plain;
FootprintKernel splat_footprint_plain;
#ifdef PHOS_SPLAT_AVX2
SplatKernel splat_tile_avx2;
FootprintKernel splat_footprint_avx2;
#endif
struct SplatKernels {
  SplatKernel* discs;
  FootprintKernel* footprint;
};
/// The fastest ones that this machine can run.
SplatKernels best_splat_kernels();

}  // namespace phos::inline splat
