#include "scene/nested_glass.h"

#include <vector>

#include "core/error.h"
#include "scene/connected_parts.h"
#include "scene/material/models.h"
#include "scene/receiver.h"

namespace phos::inline scene {

std::optional<std::string> nested_glass(const RayScene& rays) {
  constexpr std::uint32_t kEnough = 16;  // triangles of a part
  const Scene& scene = rays.scene();
  std::vector<std::uint32_t> glass;  // triangles
  std::vector<Vec3> corner;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    if (!is_solid_glass(scene.material_of(t))) continue;
    glass.push_back(t);
    for (const std::uint32_t v : scene.triangle[t].v) corner.push_back(scene.position[v]);
  }
  if (glass.empty()) return std::nullopt;
  const ConnectedParts connected = find_connected_parts(corner);
  if (connected.parts < 2) return std::nullopt;
  struct Part {
    std::uint32_t triangles = 0, met = 0, asked = 0, within = 0;
    const Material *inner = nullptr, *outer = nullptr;
  };
  std::vector<Part> parts(connected.parts);
  for (const std::size_t p : connected.part) ++parts[p].triangles;
  for (std::size_t k = 0; k < glass.size(); ++k) {
    Part& part = parts[connected.part[k]];
    const std::uint32_t stride = (part.triangles + kEnough - 1) / kEnough;
    if (part.met++ % stride != 0) continue;
    ++part.asked;
    const Vec3 middle = (corner[3 * k] + corner[3 * k + 1] + corner[3 * k + 2]) / 3.f;
    const Vec3 normal = geometric_normal(scene, glass[k]);
    const SurfacePoint at = receiver(scene, middle, normal);
    Hit hit;
    if (!rays.intersect({at.leave(normal), normal}, hit)) continue;
    const Material& about = scene.material_of(hit.triangle);
    if (is_solid_glass(about) && glm::dot(geometric_normal(scene, hit.triangle), normal) > 0)
      ++part.within, part.outer = &about, part.inner = &scene.material_of(glass[k]);
  }
  for (const Part& part : parts)
    if (2 * part.within > part.asked)
      return text("glass \"", part.inner->name, "\" lies within glass \"", part.outer->name,
                  "\", and bends light as it would in air: give it the ratio of both indices");
  return std::nullopt;
}

}  // namespace phos::inline scene
