// Shadow maps (Williams 1978): the scene's depth as it is drawn from places on lamps. Private to the OpenGL
// sources of this module.
#pragma once

#include <span>
#include <vector>

#include "splat/direct/lamp_places.h"
#include "splat/gl/mesh.h"

namespace phos::inline splat {

/// A place that light comes from, with the views that its shadow map is made of.
struct ShadowSample : LampPlace {
  const ShareMap* map = nullptr;
  std::vector<GlView> faces;  ///< none: it lights nothing that is seen
  float bias = 0;             ///< half a texel: of the distance (perspective), or of the depth range
};

/// The views from a place on a lamp, of maps of map_size pixels each way; the colour is then over the square
/// of the views' scale. `places`: surfaces that are lit, w = 0: none; the view of directional light is only
/// as wide as these. Holds a reference to `map`.
ShadowSample shadow_sample(const Scene& scene, std::span<const Vec4> places, const LampPlace& lamp,
                           const ShareMap& map, int map_size);

/// The maps of one place at a time. Its context must be current.
class ShadowTarget {
 public:
  /// Of places with so many faces at most. No wider than OpenGL allows.
  ShadowTarget(const GlContext& context, int size, int faces = 6);
  int size() const { return size_; }
  void draw(const GlMesh& mesh, const ShadowSample& sample) const;
  /// All faces, by rows from the first of OpenGL's; 0 where nothing was drawn.
  std::vector<float> read() const;
  const GlObject& maps() const { return maps_; }

 private:
  const Gl& gl_;
  int size_, faces_;
  GlObject maps_, framebuffer_;
};

}  // namespace phos::inline splat
