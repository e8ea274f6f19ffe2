// A sampled hemisphere one frame on: what it saw, moved (thesis 5.2.4, FORMULAS F6).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cache/hemisphere.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos {

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
  std::size_t empty = 0;   ///< cells that nothing moved to: they are flooded
  std::size_t holes = 0;   ///< of those, cells flooded by another surface than they showed: it came to light
  std::size_t hidden = 0;  ///< hits behind something nearer, behind the horizon, or that turned away
};

/// Moves every hit of a stratified hemisphere `now` and sees them from where its place, displaced by
/// `shift_m`, is then, with `frame` about its normal: each cell keeps the nearest of what falls into it.
/// Cells without any are flooded by their neighbours, the deepest known ones first. Rays that escaped stay
/// in their cells of the world: the environment does not move. Where all that is seen keeps its place, so
/// does every bit of it.
///
/// `radiance[i]` is that of hit i as it will be then. `ahead` gets it with frame, directions (cell middles
/// where a cell was flooded), distances and normals. All spans are as long as `now`.
ReprojectionCounts reproject(const Hemisphere& now, std::span<const Hit> hits, std::span<const Rgb> radiance,
                             const Motion& motion, const Vec3& shift_m, const Frame& frame,
                             Hemisphere& ahead);

}  // namespace phos
