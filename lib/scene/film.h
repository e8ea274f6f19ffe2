// Frames of an animation: which there are, the scene at each, and what changes from one to another.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/frames.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace phos {

/// Throws Error(usage), saying which frames there are, for a range that goes beyond an animation's. A scene
/// that is not animated has any frame.
void require_frames(const Scene& scene, const FrameRange& range);

/// The scene at a frame. Throws as load_scene(), and Error(usage) where `options` state a time of their own.
/// At every frame an animated scene has the same instances, triangles and materials in the same order: those
/// that have no area at that time (scale 0) are there, and nothing hits them.
Scene load_frame(const std::string& path, const SceneOptions& options, std::int64_t frame);

/// What differs between two times of one scene.
struct Changes {
  std::vector<bool> moved;  ///< by instance: any vertex is elsewhere
  bool lights = false;      ///< any lamp moved, turned, dimmed (moved area lights too)
  bool materials = false;   ///< any material (emission too)
  bool cameras = false;
  bool anything_moved() const;
  /// Could the light anywhere be another?
  bool light() const { return lights || materials || anything_moved(); }
};
/// Throws Error(bad_input), naming the first instance that differs, if the two are not times of one scene.
Changes changes(const Scene& a, const Scene& b);

/// Does something jump from the middle frame to the next one: a lamp that is switched on or off or is
/// elsewhere at once, an object that teleports, appears or vanishes? So it is where the step from b to c is
/// far beyond those before (a to b) and after (c to d), and large by itself: light must not be interpolated
/// over it. At an end of an animation give the same scene twice.
bool jumps(const Scene& a, const Scene& b, const Scene& c, const Scene& d);

}  // namespace phos
