#include "scene/opening/find_portals.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "core/sampling.h"
#include "core/text/comma_list.h"
#include "scene/opening/portals_about_rooms.h"
#include "scene/sky/access.h"

namespace phos::inline scene {
namespace {

constexpr int kLooks = 64;  // from each side of a piece

/// Unit normal of the side from which less of the sky is seen; 0 where both see as much.
Vec3 side_within(const RayScene& rays, const Portal& p) {
  const Vec3 normal(glm::normalize(glm::cross(DVec3(p.edge[0]), DVec3(p.edge[1]))));
  const Frame frame = make_frame(normal);
  const float lift_m = 1e-5f * rays.scene().bounds.diagonal_m();
  int seen[2] = {0, 0};
  for (int k = 0; k < kLooks; ++k) {
    const Vec3 up = sample_cosine_hemisphere(r2_point(k, Vec2(0.5f)));
    const Vec2 place = r2_point(k, Vec2(0.25f, 0.75f));
    const Vec3 from = p.at(p.triangle ? sample_triangle(place) : place);
    for (const bool back : {false, true}) {
      const float side = back ? -1.f : 1.f;
      seen[back] += sees_sky(rays, {from + side * lift_m * normal, side * frame.to_world(up)});
    }
  }
  if (seen[0] == seen[1]) return Vec3(0);
  return seen[0] < seen[1] ? normal : -normal;
}

}  // namespace

std::vector<Portal> named_portals(const Scene& scene, const std::string& names) {
  std::vector<Portal> pieces;
  const auto is_named = [&](const Instance& instance, const std::string& name) {
    return instance.node == name || scene.material[instance.material].name == name;
  };
  const auto known = [&](const std::string& name) {
    return std::any_of(scene.instance.begin(), scene.instance.end(),
                       [&](const Instance& instance) { return is_named(instance, name); });
  };
  for (const std::string& name : split_known_names(names, known)) {
    bool found = false;
    for (const Instance& instance : scene.instance) {
      if (!is_named(instance, name)) continue;
      found = true;
      for (std::uint32_t t = 0; t < instance.triangle_count; ++t) {
        const auto& v = scene.triangle[instance.first_triangle + t].v;
        const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
        pieces.push_back({a, {b - a, c - a}, true, Vec3(0)});
      }
    }
    if (!found)
      throw Error(ExitCode::usage, "--portals",
                  text("there is no node or material \"", name, "\"; give names of the scene, or auto"));
  }
  std::erase_if(pieces, [](const Portal& p) { return !(p.area_m2() > 0); });
  return pieces;
}

std::vector<Portal> find_portals(const RayScene& rays, const std::string& which) {
  if (which == "auto") return portals_about_rooms(rays);
  std::vector<Portal> pieces = named_portals(rays.scene(), which);
  for (Portal& p : pieces) p.inwards = side_within(rays, p);
  return pieces;
}

}  // namespace phos::inline scene
