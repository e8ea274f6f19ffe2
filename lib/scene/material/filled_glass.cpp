#include "scene/material/filled_glass.h"

#include <cmath>

#include "scene/connected_parts.h"
#include "scene/instance_bounds.h"
#include "scene/material/models.h"

namespace phos::inline scene {
namespace {

/// Thickness (twice volume over area) of a block over the side of its faces (a square of half its area): .19
/// of a cube, .08 of a plate ten times as wide as thick.
constexpr double kBlock = 0.1;

constexpr float kSlack = 0.01f;

struct Part {
  Bounds box;
  double volume_m3 = 0, area_m2 = 0;
  std::uint32_t material = 0;

  bool is_block() const { return 2 * std::fabs(volume_m3) / area_m2 > kBlock * std::sqrt(area_m2 / 2); }
};

/// What stands on the bottom, or sticks out a little, is within.
bool within(const Bounds& inner, const Bounds& outer) {
  const Vec3 slack = kSlack * outer.size();
  return glm::all(glm::greaterThan(inner.lo, outer.lo - slack)) &&
         glm::all(glm::lessThan(inner.hi, outer.hi + slack));
}

/// Is it full of anything, and not hollow, nor a hollow?
bool is_filled(const Scene& scene, const Part& part, const std::vector<Part>& parts,
               const std::vector<Bounds>& box_of_instance) {
  for (const Part& other : parts)
    if (&other != &part && other.material == part.material &&
        (within(other.box, part.box) || within(part.box, other.box)))
      return false;
  for (std::size_t i = 0; i < scene.instance.size(); ++i)
    if (scene.instance[i].material != part.material && within(box_of_instance[i], part.box)) return true;
  return false;
}

}  // namespace

std::vector<std::uint8_t> find_filled_glass(const Scene& scene) {
  std::vector<std::uint32_t> glass;  // triangles
  std::vector<Vec3> corner;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    if (!is_solid_glass(scene.material_of(t))) continue;
    glass.push_back(t);
    for (const std::uint32_t v : scene.triangle[t].v) corner.push_back(scene.position[v]);
  }
  if (glass.empty()) return {};
  const ConnectedParts connected = find_connected_parts(corner);
  std::vector<Part> parts(connected.parts);
  for (std::size_t k = 0; k < glass.size(); ++k) {
    Part& part = parts[connected.part[k]];
    const DVec3 a(corner[3 * k]), b(corner[3 * k + 1]), c(corner[3 * k + 2]);
    for (std::size_t i = 0; i < 3; ++i) part.box.include(corner[3 * k + i]);
    part.volume_m3 += glm::dot(a, glm::cross(b, c)) / 6;
    part.area_m2 += glm::length(glm::cross(b - a, c - a)) / 2;
    part.material = scene.instance[scene.triangle_instance[glass[k]]].material;
  }
  std::vector<Bounds> box_of_instance;
  std::vector<std::uint8_t> filled_part(parts.size()), filled;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].is_block()) continue;
    if (box_of_instance.empty())
      for (const Instance& instance : scene.instance) box_of_instance.push_back(bounds_of(scene, instance));
    filled_part[i] = is_filled(scene, parts[i], parts, box_of_instance);
  }
  for (std::size_t k = 0; k < glass.size(); ++k) {
    if (!filled_part[connected.part[k]]) continue;
    filled.resize(scene.triangle.size());
    filled[glass[k]] = 1;
  }
  return filled;
}

}  // namespace phos::inline scene
