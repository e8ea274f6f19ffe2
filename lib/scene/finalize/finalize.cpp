#include <algorithm>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "scene/finalize/hash.h"
#include "scene/finalize/lights.h"
#include "scene/load_mesh.h"
#include "scene/material/models.h"
#include "scene/scene.h"

namespace phos::inline scene {
namespace {

[[noreturn]] void fail(const Scene& scene, const std::string& message) {
  throw Error(ExitCode::bad_input, scene.path, message);
}

/// Twice the area along the normal.
DVec3 cross_of(const Scene& scene, std::uint32_t tri) {
  const Triangle& t = scene.triangle[tri];
  const DVec3 a = scene.position[t.v[0]], b = scene.position[t.v[1]], c = scene.position[t.v[2]];
  return glm::cross(b - a, c - a);
}

void check_indices(const Scene& scene) {
  if (scene.triangle.empty()) fail(scene, "the scene has no triangles, and nothing can be lit; add a mesh");
  if (scene.triangle_instance.size() != scene.triangle.size())
    fail(scene, "every triangle needs an instance");
  for (std::size_t i = 0; i < scene.position.size(); ++i) {
    if (!is_finite(scene.position[i]))
      fail(scene, text("vertex ", i, " is not finite; mend it in the modeller"));
  }
  for (std::size_t i = 0; i < scene.triangle.size(); ++i) {
    for (const std::uint32_t v : scene.triangle[i].v) {
      if (v >= scene.position.size())
        fail(scene, text("triangle ", i, " has vertex ", v, ", which is out of range"));
    }
    if (scene.triangle_instance[i] >= scene.instance.size())
      fail(scene, text("triangle ", i, " has no instance"));
  }
  for (const Light& light : scene.light) {
    const bool absent = light.fitting < 0 || light.fitting >= static_cast<std::int64_t>(scene.fitting.size());
    if (light.kind == Light::Kind::measured && absent)
      fail(scene, text("light \"", light.name, "\" has no luminaire"));
  }
  std::uint64_t covered = 0;
  for (std::size_t i = 0; i < scene.instance.size(); ++i) {
    const Instance& instance = scene.instance[i];
    if (instance.material >= scene.material.size()) fail(scene, text("instance ", i, " has no material"));
    if (instance.fitting >= static_cast<std::int64_t>(scene.fitting.size()))
      fail(scene, text("instance ", i, " has no luminaire"));
    if (instance.first_triangle != covered)
      fail(scene, text("instance ", i, " does not follow the one before it"));
    covered += instance.triangle_count;
    if (covered > scene.triangle.size()) fail(scene, text("instance ", i, " has triangles out of range"));
    for (std::uint64_t t = instance.first_triangle; t < covered; ++t) {
      if (scene.triangle_instance[t] != i) fail(scene, text("triangle ", t, " is of another instance"));
    }
  }
  if (covered != scene.triangle.size()) fail(scene, "some triangles are in no instance");
}

void check_arrays(const Scene& scene) {
  const std::size_t n = scene.position.size();
  const auto check = [&](std::size_t size, const char* name) {
    if (size != 0 && size != n) fail(scene, text(name, " must be given for every vertex or for none"));
  };
  check(scene.normal.size(), "normal");
  check(scene.uv0.size(), "uv0");
  check(scene.uv1.size(), "uv1");
  check(scene.tangent.size(), "tangent");
  check(scene.colour.size(), "colour");
  for (const Material& m : scene.material) {
    for (const TextureUse* use : m.texture_uses()) {
      if (use->texture >= static_cast<std::int64_t>(scene.texture.size())) {
        fail(scene, text("material \"", m.name, "\" uses a texture that is not there"));
      }
    }
    const bool there = m.measured >= 0 && m.measured < static_cast<std::int64_t>(scene.measured.size());
    if (row_of(m).measured && !there) {
      fail(scene, text("material \"", m.name, "\" has no measured data"));
    }
  }
}

template <class T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& index) {
  if (values.empty()) return;
  std::vector<T> out;
  out.reserve(index.size());
  for (const std::uint32_t i : index) out.push_back(values[i]);
  values = std::move(out);
}

/// Flat normals, as glTF asks where a file has none: every triangle gets vertices of its own.
void make_flat_normals(Scene& scene) {
  std::vector<std::uint32_t> index;
  for (Triangle& t : scene.triangle) {
    for (std::uint32_t& v : t.v) {
      index.push_back(v);
      v = static_cast<std::uint32_t>(index.size() - 1);
    }
  }
  unshare(scene.position, index);
  unshare(scene.uv0, index);
  unshare(scene.uv1, index);
  unshare(scene.tangent, index);
  unshare(scene.colour, index);
  scene.normal.resize(scene.position.size());
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    const Vec3 n = geometric_normal(scene, t);
    for (const std::uint32_t v : scene.triangle[t].v) scene.normal[v] = n;
  }
  scene.events["triangles given flat normals"] += scene.triangle.size();
}

/// Normals to unit length; those that are zero or not finite from the triangles about them.
void repair_normals(Scene& scene) {
  std::vector<DVec3> sum;
  std::uint64_t repaired = 0;
  for (std::size_t i = 0; i < scene.normal.size(); ++i) {
    Vec3& n = scene.normal[i];
    const Vec3 unit = normalized_or_zero(n);
    if (unit != Vec3(0)) {
      // Twice normalised is not bitwise once normalised; leave vectors that are unit already.
      if (std::abs(glm::dot(n, n) - 1.0f) > 1e-6f) n = unit;
      continue;
    }
    if (sum.empty()) {
      sum.resize(scene.position.size(), DVec3(0));
      for (const Triangle& t : scene.triangle) add_corner_normals(scene.position, t, sum);
    }
    const double length = glm::length(sum[i]);
    n = length > 0 ? Vec3(sum[i] / length) : Vec3(0, 0, 1);
    ++repaired;
  }
  if (repaired) scene.events["normals repaired"] += repaired;
}

/// What has no area at this time may be anywhere: nothing sees it.
Bounds bounds_of(const Scene& scene, bool with_area) {
  Bounds bounds;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    if (with_area && geometric_normal(scene, t) == Vec3(0)) continue;
    for (const std::uint32_t v : scene.triangle[t].v) bounds.include(scene.position[v]);
  }
  return bounds;
}

/// Between these, estimates hold (docs/reference/measured-limits.md); beyond, squares of slopes and of
/// distances begin to be lost. What has no size at this time is not looked at.
void require_size(const Scene& scene) {
  constexpr float kLeast_m = 1e-9f, kMost_m = 1e10f;
  const float size_m = scene.bounds.diagonal_m();
  if (!(size_m <= kMost_m)) fail(scene, "the scene is larger than 1e10 m; scale it down");
  if (size_m > 0 && size_m < kLeast_m) fail(scene, "the scene is smaller than 1e-9 m; scale it up");
}

}  // namespace

Vec3 geometric_normal(const Scene& scene, std::uint32_t tri) {
  const DVec3 c = cross_of(scene, tri);
  const double length = glm::length(c);
  return length > 0 ? Vec3(c / length) : Vec3(0);
}

float area_m2(const Scene& scene, std::uint32_t tri) {
  return static_cast<float>(0.5 * glm::length(cross_of(scene, tri)));
}

float bounding_radius_m(const Scene& scene) { return 0.5f * scene.bounds.diagonal_m(); }

void finalize(Scene& scene) {
  check_indices(scene);
  check_arrays(scene);
  if (scene.normal.empty()) make_flat_normals(scene);
  repair_normals(scene);
  scene.bounds = bounds_of(scene, true);
  if (scene.bounds.empty()) scene.bounds = bounds_of(scene, false);
  require_size(scene);
  fill_lights(scene);
  fill_hash(scene);
}

}  // namespace phos::inline scene
