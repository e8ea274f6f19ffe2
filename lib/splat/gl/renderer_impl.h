// What the sources of GlRenderer share.
#pragma once

#include <map>
#include <utility>

#include "splat/gl/mesh.h"
#include "splat/gl/raster.h"
#include "splat/gl/renderer.h"
#include "splat/projection.h"

namespace phos::inline splat {

/// Textures of one picture size, and the objects that draw into them. Made when a size is first asked for.
struct GlPictureTarget {
  int width = 0, height = 0;
  GlObject position, normal, facet;            // of the G-buffer
  GlObject light, error, spread, framebuffer;  // RGBA32F
  GlObject with_spread;                        // framebuffer of all three
};

/// Side of the tiles that records are cut down to.
inline constexpr int kSplatTile = 32;
/// A rectangle of pixels in the coordinates of OpenGL's viewport: x0, y0, x1, y1.
inline Vec4 in_viewport(const PixelRect& rect, int width, int height) {
  const float x = 2.f / static_cast<float>(width), y = 2.f / static_cast<float>(height);
  return {static_cast<float>(rect.x0) * x - 1, static_cast<float>(rect.y0) * y - 1,
          static_cast<float>(rect.x1) * x - 1, static_cast<float>(rect.y1) * y - 1};
}

struct GlRenderer::Impl {
  explicit Impl(const Scene& s) : scene(s), mesh(context.gl(), s) {}
  ~Impl() { context.make_current(); }

  GlRasterTarget& raster_target(int width, int height);
  /// With the G-buffer's positions and normals uploaded.
  GlPictureTarget& picture_target(const GBuffer& gbuffer);
  /// Draws are added to light and error (and spread) from now on, with the G-buffer's textures at hand.
  void bind_for_sum(const GlPictureTarget& target, bool spread = false) const;
  void prepare_splat();
  void prepare_footprints();
  /// The program that draws radiance records of an order, with or without footprints, made when it is first
  /// asked for.
  GlProgram& gloss_program(int order, bool shaped);
  void read(const GlObject& texture, std::vector<Vec4>& pixels) const;

  const Scene& scene;
  GlContext context;  // outlives everything below
  GlMesh mesh;
  GlRasterTarget raster;
  GlPictureTarget picture;
  GlProgram splat_program, footprint_program, shadow_program;
  std::map<std::pair<int, bool>, GlProgram> gloss_programs;  // by order and shape
  GlObject empty_array, splat_array, splat_instances;
  GlObject footprint_array, footprint_rects, footprint_block;
  GlObject gloss_array, gloss_rects, gloss_record;
};

}  // namespace phos::inline splat
