// From a mesh in its own coordinates, as a file holds it, to an instance in the world.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

/// Local coordinates. Every array but position may be empty; else it is as long as position.
struct MeshData {
  std::vector<Vec3> position, normal;
  std::vector<Vec2> uv0, uv1;
  std::vector<Vec4> tangent, colour;
  std::vector<Triangle> triangle;
  bool deforms = false;  ///< it has morph targets or a skin: its triangles have another shape at other times
};

/// Appends one instance. Winding is flipped under a mirroring transform, so that fronts stay fronts.
/// Triangles without area and vertices without a triangle are left out, normals made or repaired; events of
/// the scene count each. An instance that has no triangle left is not added. In a scene that has animations
/// only those are left out that have no area at any time, so that the result does not depend on the time:
/// by their own coordinates, or, where those deform, by their indices. `make_tangents`: from uv0 where the
/// mesh has none. Throws Error(bad_input) for an index out of range or a position that is not finite,
/// naming `what` and the vertex.
void add_instance(Scene& scene, MeshData mesh, const glm::dmat4& to_world, const std::string& node,
                  std::uint32_t material, bool make_tangents, const std::string& what);

/// Adds the unit normal of a triangle, times its angle at each corner, to the sums of its vertices.
void add_corner_normals(const std::vector<Vec3>& position, const Triangle& t, std::vector<DVec3>& sum);

/// Gives every triangle vertices of its own.
void unshare_vertices(MeshData& mesh);

}  // namespace phos::inline scene
