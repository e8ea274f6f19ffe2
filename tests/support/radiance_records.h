// Radiance records of known light.
#pragma once

#include <functional>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "file/container.h"
#include "hsh/projection.h"
#include "radiance/cache.h"

namespace phos::test {

/// Radiance along a direction of the world, RGB.
using WorldLight = std::function<Rgb(const Vec3& w)>;

/// Coefficients [order^2][3] of light in a frame.
inline std::vector<float> projected(const WorldLight& light, const Frame& frame, int order) {
  static const Quadrature quadrature = hemisphere_quadrature(24, 48);
  std::vector<float> out(3 * static_cast<std::size_t>(harmonic_count(order)));
  for (int c = 0; c < 3; ++c) {
    const auto one = [&](double x, double y, double z) {
      return static_cast<double>(light(frame.to_world(Vec3(DVec3(x, y, z))))[c]);
    };
    const std::vector<double> sums = project(one, BasisKind::hsh, order, quadrature);
    for (std::size_t i = 0; i < sums.size(); ++i)
      out[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(sums[i]);
  }
  return out;
}

inline RadianceRecord radiance_record(const WorldLight& light, const Vec3& position, const Frame& frame,
                                      int order, float radius_m = 1) {
  RadianceRecord r;
  r.position = position, r.frame = frame;
  r.distance_m = r.radius_m = radius_m;
  r.light = projected(light, frame, order);
  r.gradient_x.resize(r.light.size()), r.gradient_y.resize(r.light.size());
  r.stderr_light.assign(3 * static_cast<std::size_t>(order), 0.01f);
  return r;
}

inline Frame turned_about_z(const Frame& f, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * f.x + s * f.y, c * f.y - s * f.x, f.z};
}

/// Any numbers, in place and kind as they should be; a record of each of these orders.
inline RadianceCache random_radiance(const std::vector<int>& orders) {
  RadianceCache cache;
  cache.accuracy = 0.3;
  cache.scene_hash = "none";
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const int order = orders[i];
    RandomStream random(5, Stage::test, i);
    RadianceRecord r;
    r.position = {random.uniform(), random.uniform(), random.uniform()};
    r.frame = make_frame(sample_uniform_sphere(random.uniform2()));
    r.distance_m = i == 0 ? kInfinity : 1 + random.uniform();
    r.radius_m = 0.1f + random.uniform();
    const auto fill = [&](std::vector<float>& v, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) v.push_back(random.uniform());
    };
    const auto numbers = 3 * static_cast<std::size_t>(harmonic_count(order));
    fill(r.light, numbers), fill(r.gradient_x, numbers), fill(r.gradient_y, numbers);
    fill(r.stderr_light, 3 * static_cast<std::size_t>(order));
    cache.records.push_back(r);
  }
  return cache;
}
inline RadianceCache random_radiance(std::size_t n, int order) {
  return random_radiance(std::vector<int>(n, order));
}

inline Provenance radiance_provenance() {
  Provenance p;
  p.tool = "test", p.command = "test", p.parameters = Json::Object{}, p.extra = Json::Object{};
  p.key = "none";
  return p;
}

}  // namespace phos::test
