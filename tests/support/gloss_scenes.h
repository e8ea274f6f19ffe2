// Glossy scenes with radiance records, to draw.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/random.h"
#include "radiance/gloss_cache.h"
#include "support/scenes.h"

namespace phos::test {

inline GlossTables gloss_tables(const Scene& scene, GlossBy by = GlossBy::automatic) {
  Counters counters;
  return GlossTables(scene, {}, by, {}, counters);
}

/// Radiance records where a camera sees glossy surfaces: any light, gradients that change it by up to about
/// its size over the radius, radii lo..hi.
inline std::vector<RadianceRecord> radiance_in_view(const RayScene& rays, const GlossTables& tables,
                                                    const Camera& camera, std::size_t count, float lo_m,
                                                    float hi_m) {
  std::vector<RadianceRecord> records;
  for (std::uint64_t item = 0; records.size() < count && item < 1000 * count; ++item) {
    RandomStream random(3, Stage::test, item);
    const Camera::Ray ray = camera.ray(random.uniform2(), 1);
    SurfacePoint point;
    if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
    const int order = tables.order(point.material);
    if (order == 0) continue;
    RadianceRecord r;
    r.position = point.position, r.frame = make_frame(point.smooth_normal);
    r.distance_m = r.radius_m = lo_m + (hi_m - lo_m) * random.uniform();
    for (int i = 0; i < 3 * order * order; ++i) {
      r.light.push_back(i < 3 ? 20 + 10 * random.uniform() : 4 * random.uniform() - 2);
      r.gradient_x.push_back(2 * (random.uniform() - 0.5f) / r.radius_m);
      r.gradient_y.push_back(2 * (random.uniform() - 0.5f) / r.radius_m);
    }
    for (int i = 0; i < 3 * order; ++i) r.stderr_light.push_back(random.uniform());
    records.push_back(r);
  }
  return records;
}

/// Three in four records get footprints, with axes of a tenth to all of their reach.
inline void shape(std::vector<RadianceRecord>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i % 4 == 0) continue;
    RandomStream random(7, Stage::test, i);
    for (float& length_m : records[i].footprint_m.emplace())
      length_m = records[i].radius_m * (0.1f + 0.9f * random.uniform());
  }
}

/// A cache of them.
inline GlossCache gloss_cache(const RayScene& rays, const GlossTables& tables, double accuracy,
                              const std::vector<RadianceRecord>& records) {
  GlossCache cache(rays.scene().bounds, accuracy, tables);
  for (const RadianceRecord& r : records) cache.insert(r);
  return cache;
}

/// The glossy Cornell box.
inline Scene glossy_cornell() { return load_scene(PHOS_SOURCE "/data/cornell-glossy22.glb"); }

/// A sphere with smooth normals, seen from inside, of a glossy material.
inline AnalyticScene glossy_sphere(float exponent = 10) {
  AnalyticScene s = integrating_sphere(0.3f, 1280);
  for (std::size_t i = 0; i < s.scene.normal.size(); ++i)
    s.scene.normal[i] = -glm::normalize(s.scene.position[i]);
  for (Material& m : s.scene.material)
    m.model = Model::phong, m.ks = Rgb(0.5f, 0.4f, 0.3f), m.exponent = exponent;
  return s;
}

}  // namespace phos::test
