#include "view/growth/points_to_grow.h"

#include <algorithm>
#include <optional>

#include "place/points_on_surfaces.h"
#include "scene/material/bsdf.h"

namespace phos::inline view {
namespace {

bool shows_records(const Scene& scene, std::uint32_t material) {
  const Bsdf bsdf(scene, material);
  const bool is_black = !bsdf.scatters() && !bsdf.has_specular();
  return bsdf.has_diffuse() || (is_black && !scene.material[material].emits());
}

}  // namespace

std::vector<SurfaceSample> points_to_grow(const RayScene& rays, std::span<const SurfaceSample> points,
                                          float beside_m) {
  std::vector<SurfaceSample> found = put_on_surfaces(rays, points, beside_m).points;
  std::erase_if(found, [&](const SurfaceSample& p) {
    const std::optional<std::uint32_t> material = material_at(rays, p.position, p.normal);
    return !material || !shows_records(rays.scene(), *material);
  });
  return found;
}

}  // namespace phos::inline view
