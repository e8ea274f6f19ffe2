// Caustic paths aimed: from lamps to places on mirrors and glass.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "photon/emission.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline photon {

/// Starts paths at the lamps towards mirrors and glass, so that small ones get as many photons as large ones.
/// A path counts if the first event on it happens on the triangle that it was aimed at (panes may be passed
/// straight before): over all aimed paths together their flux is then all that lamps send to mirrors and
/// glass. Const and usable from any thread; holds references.
class CausticAim {
 public:
  explicit CausticAim(const RayScene& rays);

  /// Is light to be found whose first event is on this material, by aimed paths?
  bool takes(std::uint32_t material) const { return taken_[material] != 0; }
  /// Is there anything to aim at?
  bool empty() const { return target_.empty(); }
  /// Number of aimed paths that go well with `paths` others: as many where a mirror or glass turns at least
  /// half of the light that comes to it, and else in proportion to the share that is turned (turned_share()).
  /// Where there are only panes, a sixth does.
  std::uint64_t paths_for(std::uint64_t paths) const;

  struct Start {
    EmittedPhoton photon;  ///< flux 0: no light goes there
    std::uint32_t triangle = 0;
  };
  /// A path of light `light`; the expected flux of all paths that count is the flux that the light sends
  /// to mirrors and glass.
  Start start(std::size_t light, RandomStream& random) const;

 private:
  /// The triangles of one instance, chosen by area.
  struct Target {
    double share = 0, area_m2 = 0;
    std::vector<std::uint32_t> triangle;
    std::vector<double> until;  // cumulative area
  };

  const RayScene& rays_;
  Luminaires luminaires_;
  std::vector<std::uint8_t> taken_;  // by material
  std::vector<Target> target_;
  float turned_ = 0;  // the largest share of light that a target turns
  float far_m_ = 0;   // longer than any way within the scene
};

}  // namespace phos::inline photon
