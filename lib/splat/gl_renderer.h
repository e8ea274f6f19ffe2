// What the OpenGL sources of this module share.
#pragma once

#include "splat/gl_mesh.h"
#include "splat/gl_raster.h"
#include "splat/splatter.h"

namespace phos {

/// Textures of one picture size, and what draws into them. Made when a size is first asked for.
struct GlPictureTarget {
  int width = 0, height = 0;
  GlObject position, normal, facet;    // of the G-buffer
  GlObject light, error, framebuffer;  // RGBA32F
};

struct GlRenderer::Impl {
  explicit Impl(const Scene& s) : scene(s), mesh(context.gl(), s) {}
  ~Impl() { context.make_current(); }

  GlRasterTarget& raster_target(int width, int height);
  /// With the G-buffer's positions and normals uploaded.
  GlPictureTarget& picture_target(const GBuffer& gbuffer);
  /// Draws are added to light and error from now on, with the G-buffer's textures at hand.
  void bind_for_sum(const GlPictureTarget& target) const;
  void prepare_splat();
  void read(const GlObject& texture, std::vector<Vec4>& pixels) const;

  const Scene& scene;
  GlContext context;  // outlives everything below
  GlMesh mesh;
  GlRasterTarget raster;
  GlPictureTarget picture;
  GlProgram splat_program, shadow_program;
  GlObject empty_array, splat_array, splat_instances;
};

}  // namespace phos
