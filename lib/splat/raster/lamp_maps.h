// Light of all lamps from shadow maps in memory (docs/methods.md#r3).
#pragma once

#include <vector>

#include "estimate/lamp_light.h"
#include "scene/lamp/luminaires.h"
#include "splat/gl/lamp_map.h"

namespace phos::inline splat {

/// Drawn once, read for every record. Of a lamp with an area and of the sky a point asks one of kLampPlaces,
/// so that points beside each other ask others; of other lamps the only one. Maps are not filtered, for sums
/// over points are. Light through panes is not seen.
class LampMaps : public LampLight {
 public:
  static constexpr int kLampPlaces = 16;
  /// Draws in a context that is current, and needs it no more. Maps of lamps without an area have 1024 pixels
  /// each way, others 256, and a half, a quarter and so on of that where all would take more than 512 MiB.
  /// Throws Error(usage) where there are too many lamps for that. Holds no reference.
  LampMaps(const GlContext& context, const GlMesh& mesh, const Scene& scene);
  LampMaps(const LampMaps&) = delete;
  LampMaps& operator=(const LampMaps&) = delete;
  Rgb lux(const SurfacePoint& point, std::uint32_t turn) const override;

 private:
  struct Lamp {
    ShareMap shares;
    std::vector<LampMap> places;  // dark ones too
    int count = 0;
  };
  std::vector<Lamp> lamps_;
};

}  // namespace phos::inline splat
