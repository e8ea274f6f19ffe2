#include "scene/load_mesh.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <limits>
#include <utility>

#include "core/error.h"
#include "scene/limits.h"
#include "scene/shading_frame.h"

namespace phos::inline scene {
namespace {

template <class T>
std::vector<T> gather(const std::vector<T>& from, const std::vector<std::uint32_t>& index) {
  std::vector<T> out;
  if (from.empty()) return out;
  out.reserve(index.size());
  for (const std::uint32_t i : index) out.push_back(from[i]);
  return out;
}

void keep_vertices(MeshData& mesh, const std::vector<std::uint32_t>& index) {
  mesh.position = gather(mesh.position, index);
  mesh.normal = gather(mesh.normal, index);
  mesh.uv0 = gather(mesh.uv0, index);
  mesh.uv1 = gather(mesh.uv1, index);
  mesh.tangent = gather(mesh.tangent, index);
  mesh.colour = gather(mesh.colour, index);
}

/// Twice the area times the normal, exact enough that only collinear vertices give zero.
DVec3 cross_of(const MeshData& mesh, const Triangle& t) {
  const DVec3 a = mesh.position[t.v[0]], b = mesh.position[t.v[1]], c = mesh.position[t.v[2]];
  return glm::cross(b - a, c - a);
}

void check(const Scene& scene, const MeshData& mesh, const std::string& what) {
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    if (is_finite(mesh.position[i])) continue;
    throw Error(ExitCode::bad_input, scene.path,
                text(what, ": vertex ", i, " is not finite; mend it in the modeller"));
  }
  for (const Triangle& t : mesh.triangle) {
    for (const std::uint32_t v : t.v) {
      if (v < mesh.position.size()) continue;
      throw Error(ExitCode::bad_input, scene.path,
                  text(what, ": index ", v, " is out of range; there are ", mesh.position.size(),
                       " vertices; export the scene again"));
    }
  }
}

void place(MeshData& mesh, const glm::dmat4& to_world) {
  for (Vec3& p : mesh.position) p = Vec3(DVec3(to_world * glm::dvec4(DVec3(p), 1.0)));
  // The cofactor matrix turns normals rightly also where the transform is singular or tiny.
  const glm::dmat3 m(to_world);
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const bool mirrored = glm::determinant(m) < 0;
  const double sign = mirrored ? -1 : 1;
  for (Vec3& n : mesh.normal) {
    const DVec3 v = sign * (cofactor * DVec3(normalized_or_zero(n)));
    const double length = glm::length(v);
    n = length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(0);
  }
  for (Vec4& t : mesh.tangent) {
    const DVec3 v = m * DVec3(t);
    const double length = glm::length(v);
    const Vec3 unit = length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(0);
    t = Vec4(unit, mirrored ? -t.w : t.w);
  }
  if (!mirrored) return;
  for (Triangle& t : mesh.triangle) std::swap(t.v[1], t.v[2]);
}

bool has_area(const MeshData& mesh, const Triangle& t) { return cross_of(mesh, t) != DVec3(0); }
bool has_three_corners(const Triangle& t) { return t.v[0] != t.v[1] && t.v[1] != t.v[2] && t.v[2] != t.v[0]; }

template <class Keep>
void keep_triangles(Scene& scene, MeshData& mesh, const Keep& keep) {
  const std::size_t dropped = std::erase_if(mesh.triangle, [&](const Triangle& t) { return !keep(t); });
  if (dropped) scene.events["degenerate triangles dropped"] += dropped;
}

void drop_unused_vertices(MeshData& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.position.size(), kUnused), kept;
  for (const Triangle& t : mesh.triangle) {
    for (const std::uint32_t v : t.v) place[v] = 0;
  }
  for (std::uint32_t i = 0; i < place.size(); ++i) {
    if (place[i] == kUnused) continue;
    place[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
  }
  if (kept.size() == mesh.position.size()) return;
  keep_vertices(mesh, kept);
  for (Triangle& t : mesh.triangle) {
    for (std::uint32_t& v : t.v) v = place[v];
  }
}

/// A normal that is zero or not finite becomes the mean of the triangles about its vertex, weighted by their
/// angles there, so that it does not depend on how polygons were cut. Vertices of triangles that all have no
/// area at this time do not count: nothing sees them.
std::uint64_t repair_normals(MeshData& mesh) {
  std::vector<DVec3> sum;
  std::vector<bool> seen(mesh.normal.size(), false);
  std::uint64_t repaired = 0;
  for (std::size_t i = 0; i < mesh.normal.size(); ++i) {
    if (is_finite(mesh.normal[i]) && glm::length(mesh.normal[i]) > 0.5f) continue;
    if (sum.empty()) {
      sum.resize(mesh.position.size(), DVec3(0));
      for (const Triangle& t : mesh.triangle) {
        add_corner_normals(mesh.position, t, sum);
        if (!has_area(mesh, t)) continue;
        for (const std::uint32_t v : t.v) seen[v] = true;
      }
    }
    const double length = glm::length(sum[i]);
    mesh.normal[i] = length > 0 ? Vec3(sum[i] / length) : Vec3(0, 0, 1);
    repaired += seen[i];
  }
  return repaired;
}

void make_flat_normals(MeshData& mesh) {
  unshare_vertices(mesh);
  mesh.normal.resize(mesh.position.size());
  for (const Triangle& t : mesh.triangle) {
    const Vec3 n = has_area(mesh, t) ? Vec3(glm::normalize(cross_of(mesh, t))) : Vec3(0, 0, 1);
    for (const std::uint32_t v : t.v) mesh.normal[v] = n;
  }
}

/// Direction of growing u, accumulated per vertex, made orthogonal to the normal. The bitangent is up in the
/// picture, against growing v, as glTF's normal maps have it.
void make_tangents_from_uv(MeshData& mesh) {
  std::vector<DVec3> along_u(mesh.position.size(), DVec3(0)), along_v(mesh.position.size(), DVec3(0));
  for (const Triangle& t : mesh.triangle) {
    const DVec3 p = mesh.position[t.v[0]];
    const DVec3 e1 = DVec3(mesh.position[t.v[1]]) - p, e2 = DVec3(mesh.position[t.v[2]]) - p;
    const glm::dvec2 o = mesh.uv0[t.v[0]];
    const glm::dvec2 d1 = glm::dvec2(mesh.uv0[t.v[1]]) - o, d2 = glm::dvec2(mesh.uv0[t.v[2]]) - o;
    const double det = d1.x * d2.y - d2.x * d1.y;
    if (det == 0 || !std::isfinite(det)) continue;
    for (const std::uint32_t v : t.v) {
      along_u[v] += (e1 * d2.y - e2 * d1.y) / det;
      along_v[v] += (e2 * d1.x - e1 * d2.x) / det;
    }
  }
  mesh.tangent.resize(mesh.position.size());
  for (std::size_t i = 0; i < mesh.tangent.size(); ++i) {
    const DVec3 n = mesh.normal[i];
    const DVec3 t = along_u[i] - glm::dot(along_u[i], n) * n;
    const double length = glm::length(t);
    const bool known = length > 0 && std::isfinite(length);
    const Vec3 unit = known ? Vec3(t / length) : level_tangent(mesh.normal[i]);
    const bool left = known && glm::dot(glm::cross(n, t), along_v[i]) > 0;
    mesh.tangent[i] = Vec4(unit, left ? -1.0f : 1.0f);
  }
}

template <class T>
void append(std::vector<T>& to, std::vector<T>&& from) {
  if (to.empty())
    to = std::move(from);
  else
    to.insert(to.end(), from.begin(), from.end());
}

/// Arrays that the scene has for every vertex or for none.
template <class T>
void append_optional(std::vector<T>& to, std::size_t before, std::vector<T>&& from, std::size_t added,
                     const T& absent) {
  if (from.empty() && to.empty()) return;
  to.resize(before, absent);
  append(to, std::move(from));
  to.resize(before + added, absent);
}

void append(Scene& scene, MeshData&& mesh) {
  const std::size_t before = scene.position.size(), added = mesh.position.size();
  append(scene.position, std::move(mesh.position));
  append(scene.normal, std::move(mesh.normal));
  append_optional(scene.uv0, before, std::move(mesh.uv0), added, Vec2(0));
  append_optional(scene.uv1, before, std::move(mesh.uv1), added, Vec2(0));
  append_optional(scene.tangent, before, std::move(mesh.tangent), added, Vec4(0, 0, 0, 1));
  append_optional(scene.colour, before, std::move(mesh.colour), added, Vec4(1));
  for (Triangle& t : mesh.triangle) {
    for (std::uint32_t& v : t.v) v += static_cast<std::uint32_t>(before);
  }
  append(scene.triangle, std::move(mesh.triangle));
  scene.triangle_instance.resize(scene.triangle.size(), static_cast<std::uint32_t>(scene.instance.size()));
}

template <class T>
void clear_where_not_finite(std::vector<T>& values, std::uint64_t& events) {
  for (T& v : values) {
    for (int c = 0; c < v.length(); ++c) {
      if (std::isfinite(v[c])) continue;
      v[c] = 0;
      ++events;
    }
  }
}

}  // namespace

void add_corner_normals(const std::vector<Vec3>& position, const Triangle& t, std::vector<DVec3>& sum) {
  const DVec3 p[3] = {position[t.v[0]], position[t.v[1]], position[t.v[2]]};
  const DVec3 c = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double length = glm::length(c);
  if (!(length > 0)) return;
  for (int k = 0; k < 3; ++k) {
    const DVec3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
    sum[t.v[k]] += std::atan2(length, glm::dot(a, b)) / length * c;
  }
}

void unshare_vertices(MeshData& mesh) {
  std::vector<std::uint32_t> index;
  index.reserve(3 * mesh.triangle.size());
  for (Triangle& t : mesh.triangle) {
    for (std::uint32_t& v : t.v) {
      index.push_back(v);
      v = static_cast<std::uint32_t>(index.size() - 1);
    }
  }
  keep_vertices(mesh, index);
}

void add_instance(Scene& scene, MeshData mesh, const glm::dmat4& to_world, const std::string& node,
                  std::uint32_t material, bool make_tangents, const std::string& what) {
  check(scene, mesh, what);
  const auto with_area = [&](const Triangle& t) { return has_area(mesh, t); };
  const bool animated = !scene.animation.empty();
  if (animated && mesh.deforms) keep_triangles(scene, mesh, has_three_corners);
  if (animated && !mesh.deforms) keep_triangles(scene, mesh, with_area);
  place(mesh, to_world);
  check(scene, mesh, what + " placed by its transform");
  std::uint64_t not_finite = 0;
  clear_where_not_finite(mesh.uv0, not_finite);
  clear_where_not_finite(mesh.uv1, not_finite);
  clear_where_not_finite(mesh.colour, not_finite);
  if (not_finite) scene.events["vertex attributes not finite, set to zero"] += not_finite;
  if (!animated) keep_triangles(scene, mesh, with_area);
  if (mesh.triangle.empty()) return;
  drop_unused_vertices(mesh);
  if (mesh.normal.empty()) {
    make_flat_normals(mesh);
    scene.events["triangles given flat normals"] += mesh.triangle.size();
  } else if (const std::uint64_t n = repair_normals(mesh)) {
    scene.events["normals repaired"] += n;
  }
  if (make_tangents && mesh.tangent.empty() && !mesh.uv0.empty()) make_tangents_from_uv(mesh);
  if (scene.position.size() + mesh.position.size() > kMostVertices.as<std::size_t>()) {
    throw Error(ExitCode::bad_input, scene.path,
                text("more than ", kMostVertices.most, " vertices; leave out part of the scene"));
  }
  Instance instance;
  instance.node = node;
  instance.material = material;
  instance.first_triangle = static_cast<std::uint32_t>(scene.triangle.size());
  instance.triangle_count = static_cast<std::uint32_t>(mesh.triangle.size());
  instance.to_world = Mat4(to_world);
  append(scene, std::move(mesh));
  scene.instance.push_back(std::move(instance));
}

}  // namespace phos::inline scene
