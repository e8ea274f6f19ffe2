#include "splat/picture/mapped_lamps.h"

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/material/bsdf.h"
#include "splat/gl/lamp_map.h"

namespace phos::inline splat {

void MappedLamps::add(const LampMap& map, bool extended, std::span<const SeenSample> samples,
                      std::span<LampsAt> light) const {
  PHOS_CHECK(samples.size() == light.size(), samples.size(), " samples, ", light.size(), " results");
  const Scene& scene = rays_.scene();
  parallel_for(samples.size(), 1024, [&](std::size_t i) {
    if (!std::isfinite(samples[i].hit.distance_m)) return;
    const SurfacePoint point = rays_.surface(samples[i].ray, samples[i].hit);
    MappedLight found;
    if (!map.light(point.position, point.geometric_normal, taps_, found)) return;
    const float cosine = glm::dot(point.normal, found.direction);
    if (!(cosine > 0)) return;
    const Rgb lux = cosine * found.lux;
    light[i].lux += lux;
    if (!gloss_ || scene.material[point.material].diffuse_alone()) return;
    Bsdf bsdf(scene, point);
    if (!bsdf.has_gloss()) return;
    const Vec3 wo = -samples[i].ray.direction;
    bsdf.look_from(wo);
    (extended ? light[i].extended_gloss : light[i].point_gloss) +=
        bsdf.evaluate_gloss(wo, found.direction) * lux;
  });
}

}  // namespace phos::inline splat
