// The scene's triangles in OpenGL. Private to the OpenGL sources of this module.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "splat/gl/objects.h"

namespace phos::inline splat {

/// How a picture or a shadow map is projected: the uniforms of shaders::scene_vertex.
struct GlView {
  Vec3 eye{0};
  Mat3 axes{1};  ///< world to view (looking along -z), times 1 / (size of the scene)
  Vec4 lens{1, 1, 0, 0};
  Vec2 depth{0, 0};  ///< clip z = x + y * distance along the view; 1 at the nearest, falling
  bool perspective = true;
};

class GlMesh {
 public:
  GlMesh(const Gl& gl, const Scene& scene);
  /// Draws every triangle into the bound framebuffer. Rows of a picture are counted from the top.
  void draw(const GlView& view) const;

 private:
  /// Consecutive triangles that are drawn alike.
  struct Range {
    std::uint32_t first, count;
    std::int32_t material;  // -1: opaque
  };
  void make_vertices();
  void make_ranges();
  void make_masks();
  void set_mask(const Material& material) const;

  const Gl& gl_;
  const Scene& scene_;
  GlObject vertices_, mask_vertices_, indices_, array_;
  GlProgram opaque_, masked_;
  std::vector<Range> ranges_;
  std::vector<GlObject> alpha_;  // per texture; empty where no mask uses it
};

}  // namespace phos::inline splat
