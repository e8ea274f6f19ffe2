// Frames of an animation: their range, the scene at each, and the changes from one to another.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/frames.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Throws Error(usage), saying which frames there are, for a range that goes beyond an animation's. A scene
/// that is not animated has any frame.
void require_frames(const Scene& scene, const FrameRange& range);

/// The scene at a frame. Throws as load_scene(), and Error(usage) where `options` state a time of their own.
/// At every frame an animated scene has the same instances, triangles and materials in the same order: those
/// that have no area at that time (scale 0) are there, and nothing hits them. Only the winding of an instance
/// turns where its transform comes to mirror it. Lamps that are black, or without area, are left out.
Scene load_frame(const std::string& path, const SceneOptions& options, std::int64_t frame);

/// What differs between two times of one scene.
struct Changes {
  std::vector<bool> moved;  ///< by instance: any vertex is elsewhere, or its normal turned
  bool lights = false;      ///< any lamp moved, turned, dimmed (moved area lights too)
  bool materials = false;   ///< any material (emission too)
  bool cameras = false;
  bool anything_moved() const;
  /// Could the light anywhere be another?
  bool light() const { return lights || materials || anything_moved(); }
};
/// Throws Error(bad_input), naming the first instance that differs, if the two are not times of one scene.
Changes changes(const Scene& a, const Scene& b);

/// Does something jump from b to c, of four scenes that follow one another: a lamp that is switched on or off
/// or is elsewhere at once, an object that teleports, appears or vanishes? Light must not be interpolated
/// over it. At an end of an animation give the same scene twice.
///
/// A jump is a step from b to c that is more than four times those from a to b and from c to d, and that is
/// large by itself:
///  - an object: its farthest moving vertex goes farther than a tenth of the object's diagonal, or a
///    twentieth of the scene's. Where it has no area on one side of the step (scale 0), only how far its
///    vertices go from its middle counts; where on both, nothing moves;
///  - a lamp's flux (directional: illuminance): more than a tenth of the larger one, in any colour;
///  - the place of a point or spot light: more than a hundredth of the scene's diagonal;
///  - the direction of a spot or directional light: more than a tenth of a radian.
/// So nothing that takes three frames or more to change steadily is a jump, however fast, and no corner of a
/// movement is one. An object that comes to be mirrored always jumps: its triangles have other corners.
bool jumps(const Scene& a, const Scene& b, const Scene& c, const Scene& d);

}  // namespace phos::inline scene
