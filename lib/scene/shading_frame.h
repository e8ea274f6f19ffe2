// Interpolated and mapped normals, tangents, texture coordinates and colours of a point on a triangle.
#pragma once

#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// What a material needs to know of a point beyond its normals, so that plain ones pay for nothing.
struct Reads {
  bool uv0 = false, uv1 = false;
  bool normal_map = false, anisotropic = false;
  bool colour = false;
};
Reads reads_of(const Scene& scene, const Material& material);

/// Unit normal by winding; +z for a triangle without area.
Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// What stands in for the direction of growing u where a surface has neither tangents nor usable texture
/// coordinates: horizontal (+y is up), as a lathe brushes; +x on floors and ceilings.
Vec3 level_tangent(const Vec3& normal);

/// Fills smooth_normal, normal, tangent, uv and colour of a point whose other fields are set. `weight` are
/// the barycentric weights; `towards_eye` is the unit direction it is seen from; `flat` says that the
/// vertices have the triangle's normal.
void shade(const Scene& scene, const Reads& reads, const float weight[3], const Vec3& towards_eye,
           SurfacePoint& point, bool flat = false);

}  // namespace phos::inline scene
