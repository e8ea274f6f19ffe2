// Sensors read in memory.
#pragma once

#include "core/error.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "sense/sensors.h"
#include "support/indexed_file.h"
#include "support/scenes.h"

namespace phos::test {

inline Sensors sensors_at(const std::vector<Check>& checks) {
  Sensors sensors;
  for (const Check& check : checks) sensors.points.push_back({check.position, check.normal});
  return sensors;
}

/// A file of records at these places, all of one irradiance and without gradients.
inline Container even_cache(const std::string& name, const Scene& scene, const std::vector<Check>& places,
                            float irradiance_lx, float radius_m, Quantity quantity) {
  IrradianceCache cache;
  cache.scene_hash = scene.hash;
  cache.quantity = quantity;
  cache.accuracy = 0.5;
  for (const Check& place : places) {
    IrradianceRecord r;
    r.position = place.position, r.normal = place.normal;
    r.irradiance = Rgb(irradiance_lx), r.stderr_lx = Rgb(0.01f * irradiance_lx);
    r.radius_m = r.distance_m = radius_m;
    cache.records.push_back(r);
  }
  const std::string path = text(scratch("sensors"), "/", name);
  write_irradiance(path, cache, irradiance_provenance());
  return Container::open(path, FileKind::irradiance);
}

struct Read {
  std::vector<Reading> readings;
  SensorReport report;
};

inline Read read_sensors_of(const Scene& scene, const Sensors& sensors, const std::vector<Container>& files,
                            const SensorOptions& options) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const SensorCaches caches(files, options.leak_test == LeakTest::ray ? &rays : nullptr);
  Read read;
  read.readings = read_light(sensors, rays, lights, caches, options, read.report);
  return read;
}

}  // namespace phos::test
