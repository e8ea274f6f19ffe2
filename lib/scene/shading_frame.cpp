#include "scene/shading_frame.h"

#include <cmath>

#include "scene/material/models.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {

namespace {

/// Turns a unit vector just so far that its cosine with `axis` (unit) is about `least`.
Vec3 bent_towards(const Vec3& v, const Vec3& axis, float least) {
  const float cosine = glm::dot(v, axis);
  return cosine >= least ? v : glm::normalize(v + (least - cosine) * axis);
}

template <class T>
T blend(const std::vector<T>& of_vertex, const Triangle& triangle, const float weight[3]) {
  return weight[0] * of_vertex[triangle.v[0]] + weight[1] * of_vertex[triangle.v[1]] +
         weight[2] * of_vertex[triangle.v[2]];
}

/// Direction in which the first texture coordinate grows, and the handedness that makes cross(normal,
/// tangent) point against growing v (up in the picture). Zero where the coordinates do not span the triangle.
Vec4 tangent_from_uv(const Scene& scene, const SurfacePoint& point, int set) {
  const std::vector<Vec2>& uv = set == 0 ? scene.uv0 : scene.uv1;
  if (uv.empty()) return Vec4(0);
  const auto& corner = scene.triangle[point.triangle].v;
  const Vec3 e1 = scene.position[corner[1]] - scene.position[corner[0]];
  const Vec3 e2 = scene.position[corner[2]] - scene.position[corner[0]];
  const Vec2 d1 = uv[corner[1]] - uv[corner[0]], d2 = uv[corner[2]] - uv[corner[0]];
  const float determinant = d1.x * d2.y - d2.x * d1.y;
  const float sign = determinant < 0 ? -1.f : 1.f;
  const Vec3 along_u = normalized_or_zero(sign * (d2.y * e1 - d1.y * e2));
  if (determinant == 0 || along_u == Vec3(0)) return Vec4(0);
  // Front side, coordinates drawn as they lie in the picture (v down): the determinant is negative.
  return Vec4(along_u, -sign);
}

/// Tangent and handedness on the front side.
Vec4 tangent_of(const Scene& scene, const SurfacePoint& point, const float weight[3], int set) {
  if (!scene.tangent.empty()) {
    const Vec4 blended = blend(scene.tangent, scene.triangle[point.triangle], weight);
    const Vec3 direction = normalized_or_zero(Vec3(blended));
    if (direction != Vec3(0)) return Vec4(direction, blended.w < 0 ? -1.f : 1.f);
  }
  return tangent_from_uv(scene, point, set);
}

Vec3 smooth_normal_of(const Scene& scene, const SurfacePoint& point, const float weight[3]) {
  // Below this cosine with the geometric normal a smooth normal is bent, so that most of its hemisphere is
  // open.
  constexpr float kLeastCosine = 0.05f;
  if (scene.normal.empty()) return point.geometric_normal;
  // Vertex normals are unit, so the plain norm is safe; opposite ones may cancel.
  Vec3 n = blend(scene.normal, scene.triangle[point.triangle], weight);
  const float length2 = glm::dot(n, n);
  if (!(length2 > 0)) return point.geometric_normal;
  n *= 1 / std::sqrt(length2);
  if (!point.front) n = -n;
  // Normals that point well into the other side belong to a mesh of inverted winding; a little, to a coarse
  // crease.
  if (glm::dot(n, point.geometric_normal) < -0.5f) n = -n;
  return bent_towards(n, point.geometric_normal, kLeastCosine);
}

/// smooth_normal with the normal map applied; glTF reverses the whole frame for a back side.
Vec3 mapped_normal(const Scene& scene, const Material& material, const Vec4& tangent,
                   const SurfacePoint& point) {
  const float side = point.front ? 1.f : -1.f;
  const Vec3 n = side * point.smooth_normal;
  const Vec3 t = normalized_or_zero(Vec3(tangent) - glm::dot(Vec3(tangent), n) * n);
  if (t == Vec3(0)) return point.smooth_normal;
  const Vec3 b = tangent.w * glm::cross(n, t);
  const Vec4 texel = look_up(scene, material.normal, point.uv0, point.uv1);
  const Vec3 local = (2.f * Vec3(texel) - 1.f) * Vec3(material.normal_scale, material.normal_scale, 1);
  const Vec3 mapped = normalized_or_zero(local.x * t + local.y * b + local.z * n);
  return mapped == Vec3(0) ? point.smooth_normal : side * mapped;
}

/// The tangent turned as KHR_materials_anisotropy says, in the frame of the front side.
Vec3 turned_tangent(const Scene& scene, const Material& material, const Vec4& tangent,
                    const SurfacePoint& point) {
  const Vec3 n = point.front ? point.normal : -point.normal;
  const Vec3 t = normalized_or_zero(Vec3(tangent) - glm::dot(Vec3(tangent), n) * n);
  Vec2 along(1, 0);
  if (material.anisotropy_map.used()) {
    const Vec2 d = 2.f * Vec2(look_up(scene, material.anisotropy_map, point.uv0, point.uv1)) - 1.f;
    if (glm::dot(d, d) > 0) along = d;
  }
  const float c = std::cos(material.anisotropy_rad), s = std::sin(material.anisotropy_rad);
  along = {c * along.x - s * along.y, s * along.x + c * along.y};
  return along.x * t + along.y * tangent.w * glm::cross(n, t);
}

}  // namespace

Vec3 level_tangent(const Vec3& normal) {
  // Flatter surfaces than this slope are floors and ceilings: no direction on them is more level than others.
  constexpr float kFlatSlope = 1e-3f;
  const Vec3 across(normal.z, 0, -normal.x);  // cross(+y, normal)
  const float length = glm::length(across);
  return length > kFlatSlope ? across / length : Vec3(1, 0, 0);
}

Reads reads_of(const Scene& scene, const Material& material) {
  Reads reads;
  for (const TextureUse* use : material.texture_uses()) {
    if (!use->used()) continue;
    reads.uv0 |= use->set == 0 && !scene.uv0.empty();
    reads.uv1 |= use->set == 1 && !scene.uv1.empty();
  }
  reads.normal_map = material.normal.used();
  reads.anisotropic = material.anisotropic();
  reads.colour = !scene.colour.empty();
  return reads;
}

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const glm::dvec3 e1 = glm::dvec3(b) - glm::dvec3(a), e2 = glm::dvec3(c) - glm::dvec3(a);
  const glm::dvec3 n = glm::cross(e1, e2);
  const double length = glm::length(n);
  return length > 0 ? Vec3(n / length) : Vec3(0, 0, 1);
}

void shade(const Scene& scene, const Reads& reads, const float weight[3], const Vec3& towards_eye,
           SurfacePoint& point, bool flat) {
  // Seen from below its own horizon a shading normal would be black; it is tilted until this cosine is left.
  constexpr float kLeastCosine = 0.01f;
  const Material& material = scene.material[point.material];
  if (reads.uv0) point.uv0 = texture_coordinates(scene, point.triangle, 0, weight[1], weight[2]);
  if (reads.uv1) point.uv1 = texture_coordinates(scene, point.triangle, 1, weight[1], weight[2]);
  if (reads.colour) point.colour = blend(scene.colour, scene.triangle[point.triangle], weight);
  point.smooth_normal = flat ? point.geometric_normal : smooth_normal_of(scene, point, weight);
  point.normal = point.smooth_normal;

  Vec4 tangent(0);
  if (reads.normal_map || reads.anisotropic) {
    const TextureUse& map = reads.normal_map ? material.normal : material.anisotropy_map;
    tangent = tangent_of(scene, point, weight, map.set);
  }
  if (reads.normal_map) {
    point.normal =
        bent_towards(mapped_normal(scene, material, tangent, point), point.geometric_normal, 0.05f);
  }
  const float grazing = glm::dot(towards_eye, point.geometric_normal);
  if (!flat || reads.normal_map) {
    point.normal = bent_towards(point.normal, towards_eye, std::fmin(kLeastCosine, grazing));
  }
  point.tangent = make_frame(point.normal).x;
  if (reads.anisotropic) {
    if (Vec3(tangent) == Vec3(0)) tangent = Vec4(level_tangent(point.normal), 1);
    const bool turned = row_of(material).gltf_core;
    const Vec3 t = turned ? turned_tangent(scene, material, tangent, point) : Vec3(tangent);
    const Vec3 along = normalized_or_zero(t - glm::dot(t, point.normal) * point.normal);
    if (along != Vec3(0)) point.tangent = along;
  }
}

}  // namespace phos::inline scene
