// Halls with many lamps.
#pragma once

#include <cmath>

#include "core/random.h"
#include "support/scenes.h"

namespace phos::test {

/// A black floor of 60 x 30 m, y = 0, under a grid of point lamps 7 m above it, of powers between 1 and 3;
/// with partitions of 5 m across its width every 10 m, in which doors are left open, or without.
inline Scene hall_of_lamps(int lamps, bool partitions) {
  constexpr float kLong = 60, kWide = 30, kHigh = 7, kWall = 5, kDoor = 4;
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "black", 0));
  add_quad(scene, {0, 0, 0}, {0, 0, kWide}, {kLong, 0, 0});
  for (float x = 10; partitions && x < kLong; x += 10) {
    add_quad(scene, {x, 0, 0}, {0, 0, kWide - kDoor}, {0, kWall, 0});
    add_quad(scene, {x + 0.1f, 0, 0}, {0, kWall, 0}, {0, 0, kWide - kDoor});
  }
  const int across = std::max(1, static_cast<int>(std::lround(std::sqrt(lamps / 2.0)))),
            along = (lamps + across - 1) / across;
  for (int i = 0; i < lamps; ++i) {
    RandomStream random(1, Stage::test, static_cast<std::uint64_t>(i));
    const float x = (static_cast<float>(i / across) + 0.5f) / static_cast<float>(along),
                z = (static_cast<float>(i % across) + 0.5f) / static_cast<float>(across);
    Light light;
    light.kind = Light::Kind::point, light.name = "lamp";
    light.position = {x * kLong, kHigh, z * kWide};
    light.intensity = Rgb((1 + 2 * random.uniform()) * 20000 / static_cast<float>(lamps));
    scene.light.push_back(light);
  }
  finalize(scene);
  return scene;
}

/// Of all its lamps at a place on its floor, where nothing stands between, lx.
inline double open_hall_lx(const Scene& hall, const Vec3& p) {
  double sum = 0;
  for (const Light& light : hall.light) {
    const DVec3 way = DVec3(light.position) - DVec3(p);
    sum += static_cast<double>(light.intensity.y) * way.y / std::pow(glm::dot(way, way), 1.5);
  }
  return sum;
}

}  // namespace phos::test
