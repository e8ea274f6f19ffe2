// A sampled hemisphere one frame on: its hits, moved (docs/methods.md#f6).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/hemisphere/hemisphere.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline temporal {

/// Two times of one scene, and which of its instances are elsewhere at the second (Changes::moved).
struct Motion {
  const Scene& now;
  const Scene& next;
  const std::vector<bool>& moved;

  bool moves(std::uint32_t triangle) const { return moved[now.triangle_instance[triangle]]; }
  /// How far the point that a ray hit moves, m; exactly 0 where its instance stays.
  Vec3 of(const Hit& hit) const;
};

/// What became of the hits.
struct ReprojectionCounts {
  std::size_t cells = 0;
  std::size_t empty = 0;   ///< cells that nothing moved to
  std::size_t hidden = 0;  ///< hits behind something nearer, behind the horizon, or that turned away
  double holes = 0;        ///< the unknown share that came into sight, in cells
};

/// Moves every hit of a stratified hemisphere `now` and sees them from where its place, displaced by
/// `shift_m`, is then, with `frame` about its normal. In each cell the nearest surface hides the hits
/// behind; cells that nothing falls into are flooded by their neighbours, the deepest known ones first. Rays
/// that escaped stay in their directions of the world: the environment does not move. Where all hits
/// keep their places, every bit stays the same.
///
/// Rays lie anywhere in their cells, so that motions far below a cell's size leave many cells empty and
/// others crowded. Each hit therefore takes its cover along: a cell's light is the sum of the hits
/// in it, each by the change of its solid angle in the hemisphere's measure. The share that is then missing
/// from the whole hemisphere came into sight, and flooded cells count only so much.
///
/// `radiance[i]` is the radiance of hit i at that time. `ahead` gets frame, directions (cell middles where a
/// cell was empty), distances, normals, and radiance as said. All spans are as long as `now`.
ReprojectionCounts reproject(const Hemisphere& now, std::span<const Hit> hits, std::span<const Rgb> radiance,
                             const Motion& motion, const Vec3& shift_m, const Frame& frame,
                             Hemisphere& ahead);

}  // namespace phos::inline temporal
