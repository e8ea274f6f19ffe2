// How much of a surface is there: cut-outs (alpha mask) and coverage (alpha blend).
#pragma once

#include "scene/rays.h"

namespace phos::inline scene {

/// Alpha at a point of a triangle: the material's, times the base colour texture's and the vertex colours'.
/// `u` and `v` are the barycentric weights of the second and third vertex.
float alpha_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// Share of a surface that is there at one of its points, 0 to 1: 0 in holes of a mask, alpha of blending,
/// else
/// 1. Light that a surface emits is multiplied by it.
float visible_share(const Scene& scene, std::uint32_t triangle, float u, float v);
/// The same at a point that a ray has hit: not in a hole.
float visible_share(const Scene& scene, const SurfacePoint& point);

}  // namespace phos::inline scene
