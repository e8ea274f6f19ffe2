// Where photons lie that face a way, roughly.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "estimate/zone/tangent_surface.h"
#include "photon/photon_map.h"

namespace phos::inline estimate {

/// Cells over the bounds of some photons, and which of six ways the photons in each face: enough to know that
/// a wide zone holds none of its facing, without a look at the thousands that other surfaces hold within its
/// sphere. Const and usable from any thread.
class FacingCells {
 public:
  /// Of the photons whose rows are `counted`.
  FacingCells(const PhotonMap& photons, const std::function<bool(std::uint32_t row)>& counted);

  /// May one of them lie in the zone of radius_m, within its slab, and face as the place does (kSameFacing)?
  /// "No" is certain.
  bool may_hold(const ZonePlace& place, float radius_m) const;

 private:
  static constexpr int kLevels = 7;  // from one cell to 64 along each axis

  struct Cell {
    int level, x, y, z;
  };
  int along(int axis, float coordinate_m) const;
  std::uint8_t& faces(const Cell& cell);
  std::uint8_t faces(const Cell& cell) const { return const_cast<FacingCells*>(this)->faces(cell); }

  Bounds bounds_;
  std::vector<std::uint8_t> faces_[kLevels];  // bit 2 a + 1: along -a mostly, 2 a: along +a
};

}  // namespace phos::inline estimate
