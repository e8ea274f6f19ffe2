#include "splat/raster/lamp_maps.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "scene/rays.h"

namespace phos::inline splat {
namespace {

constexpr int kPointMap = 1024, kAreaMap = 256, kLeastMap = 16;  // pixels of a side
constexpr double kMostBytes = 512.0 * 1024 * 1024;
constexpr double kMostFaces = 6;

int side_of(const Light& light, int halvings) {
  return (light.extended() ? kAreaMap : kPointMap) >> halvings;
}

/// How often all maps are halved to fit.
int halvings_for(const Scene& scene) {
  for (int halvings = 0; (kAreaMap >> halvings) >= kLeastMap; ++halvings) {
    double bytes = 0;
    for (const Light& light : scene.light) {
      const double side = side_of(light, halvings);
      bytes += place_count(light, LampMaps::kLampPlaces) * kMostFaces * sizeof(float) * side * side;
    }
    if (bytes <= kMostBytes) return halvings;
  }
  throw Error(ExitCode::usage, "--raster-light",
              text(scene.light.size(), " lamps have too many shadow maps; give traced"));
}

/// Corners of the box about the scene: what directional light may fall on.
std::vector<Vec4> corners(const Bounds& bounds) {
  std::vector<Vec4> all;
  for (int i = 0; i < 8; ++i)
    all.emplace_back(i & 1 ? bounds.hi.x : bounds.lo.x, i & 2 ? bounds.hi.y : bounds.lo.y,
                     i & 4 ? bounds.hi.z : bounds.lo.z, 1);
  return all;
}

}  // namespace

LampMaps::LampMaps(const GlContext& context, const GlMesh& mesh, const Scene& scene) {
  const int halvings = halvings_for(scene);
  const std::vector<Vec4> lit = corners(scene.bounds);
  const Luminaires luminaires(scene);
  Progress progress("shadow maps", scene.light.size(), "lamps");
  lamps_.resize(scene.light.size());
  for (std::size_t i = 0; i < scene.light.size(); ++i, progress.advance()) {
    const Light& light = scene.light[i];
    Lamp& lamp = lamps_[i];
    if (light.fitting >= 0) lamp.shares = share_map(scene, light);
    lamp.count = place_count(light, kLampPlaces);
    std::optional<ShadowTarget> target;
    std::size_t faces = 0;
    for (int k = 0; k < lamp.count; ++k) {
      throw_if_interrupted();
      const auto place = lamp_place(scene, luminaires, i, k, lamp.count, lamp.shares);
      LampMap map;
      if (place) map.sample = shadow_sample(scene, lit, *place, lamp.shares, side_of(light, halvings));
      if (!map.sample.faces.empty()) {
        if (!target || faces != map.sample.faces.size()) {
          faces = map.sample.faces.size();
          target.emplace(context, side_of(light, halvings), static_cast<int>(faces));
        }
        target->draw(mesh, map.sample);
        map.size = target->size(), map.depth = target->read();
      }
      lamp.places.push_back(std::move(map));
    }
  }
  context.check("drawing shadow maps");
}

Rgb LampMaps::lux(const SurfacePoint& point, std::uint32_t turn) const {
  // Multiples of the golden ratio: places that are asked next to each other, in rows and across, differ.
  const std::uint32_t share = turn * 0x9e3779b9u;
  Rgb sum(0);
  for (const Lamp& lamp : lamps_) {
    const auto n = static_cast<std::size_t>(lamp.count);
    const std::size_t k = static_cast<std::size_t>(std::uint64_t{share} * n >> 32);
    MappedLight light;
    if (!lamp.places[k].light(point.position, point.geometric_normal, 1, light)) continue;
    const float cosine = glm::dot(point.normal, light.direction);
    if (cosine > 0) sum += static_cast<float>(n) * cosine * light.lux;
  }
  return sum;
}

}  // namespace phos::inline splat
