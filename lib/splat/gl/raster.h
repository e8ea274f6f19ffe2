// Which triangle each pixel shows, by OpenGL. Private to the OpenGL sources of this module.
#pragma once

#include <vector>

#include "scene/rays.h"
#include "splat/gl/mesh.h"

namespace phos::inline splat {

inline constexpr std::uint32_t kNothingDrawn = ~0u;

/// Textures of one picture size.
struct GlRasterTarget {
  int width = 0, height = 0;
  GlObject triangle, depth, framebuffer;
};
/// Throws Error(usage) if a side is more than OpenGL can draw.
GlRasterTarget make_raster_target(const GlContext& context, int width, int height);
void require_size(const GlContext& context, int width, int height);

/// Sets `triangle` of each pixel, kNothingDrawn where there is none. The context must be current.
void draw_triangles(const Gl& gl, const GlMesh& mesh, const GlView& view, const GlRasterTarget& target,
                    std::vector<std::uint32_t>& triangle);

/// Where the ray meets the triangle's plane; moved onto the triangle where the ray passes beside it (by less
/// than the rasteriser's rounding).
Hit hit_triangle(const Scene& scene, const Ray& ray, std::uint32_t triangle);

}  // namespace phos::inline splat
