#include "cache/gradients.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cache/hemisphere.h"

namespace phos {
namespace {

constexpr int kRotationRings = 8;

int ring_of(float cos_theta, int rings) {
  return std::clamp(static_cast<int>(static_cast<float>(rings) * (1 - cos_theta * cos_theta)), 0, rings - 1);
}

/// Light and mean distance of the photons of each cell of a hemisphere (FORMULAS D1).
Hemisphere bin(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
               const Frame& frame, int rings) {
  Hemisphere h;
  h.frame = frame, h.rings = rings, h.slices = slices_for(rings);
  const std::size_t cells = h.at(rings, 0);
  const double turns_per_slice = 1.0 / h.slices, cell_sr = std::numbers::pi / static_cast<double>(cells);
  std::vector<DVec3> flux(cells, DVec3(0));
  std::vector<double> weight(cells, 0), weight_over_distance(cells, 0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    const Vec3 w = frame.to_local(photons.direction[i]);
    double turn = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * std::numbers::pi);
    if (turn < 0) turn += 1;
    const int slice = std::clamp(static_cast<int>(turn / turns_per_slice), 0, h.slices - 1);
    const std::size_t cell = h.at(ring_of(w.z, rings), slice);
    const auto y = static_cast<double>(luminance(photons.flux_lm[i]));
    flux[cell] += DVec3(photons.flux_lm[i]), weight[cell] += y;
    weight_over_distance[cell] += y * static_cast<double>(photons.inverse_distance[i]);
  }
  h.resize(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    h.radiance[c] = Rgb(flux[c] / (area_m2 * cell_sr)), h.projected_sr[c] = static_cast<float>(cell_sr);
    h.distance_m[c] =
        weight_over_distance[c] > 0 ? static_cast<float>(weight[c] / weight_over_distance[c]) : kInfinity;
  }
  return h;
}

}  // namespace

double ring_tangent(int ring, int rings) {
  const double inner = std::asin(std::sqrt(ring / double(rings))),
               outer = std::asin(std::sqrt((ring + 1) / double(rings)));
  return rings * ((outer - inner) - (std::sin(2 * outer) - std::sin(2 * inner)) / 2);
}

Vec3 translation_term(const Vec3& w, const Vec3& source_normal, float inverse_distance, const Vec3& normal) {
  const float cos_source = std::max(0.1f, -glm::dot(source_normal, w));
  const Vec3 term = source_normal / cos_source + 4.f * w;
  return (term - glm::dot(term, normal) * normal) * inverse_distance;
}

Vec3 rotation_term(const Vec3& w, const Vec3& normal) {
  static const std::array<float, kRotationRings> tangent = [] {
    std::array<float, kRotationRings> t;
    for (int j = 0; j < kRotationRings; ++j)
      t[static_cast<std::size_t>(j)] = static_cast<float>(ring_tangent(j, kRotationRings));
    return t;
  }();
  const Vec3 across = glm::cross(normal, w);
  const float length = glm::length(across);
  const int ring = ring_of(glm::dot(w, normal), kRotationRings);
  return length > 0 ? across * (tangent[static_cast<std::size_t>(ring)] / length) : Vec3(0);
}

Gradients photon_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                           const Frame& frame) {
  glm::dmat3 rotation(0), translation(0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    const DVec3 flux(photons.flux_lm[i]);
    const DVec3 step(photon_translation_term(photons, i, frame.z));
    const DVec3 turn(rotation_term(photons.direction[i], frame.z));
    for (int c = 0; c < 3; ++c) translation[c] += flux[c] * step, rotation[c] += flux[c] * turn;
  }
  Gradients g;
  for (int c = 0; c < 3; ++c) {
    g.translation[c] = Vec3(translation[c] / area_m2), g.rotation[c] = Vec3(rotation[c] / area_m2);
  }
  return g;
}

Gradients hemisphere_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                               const Frame& frame, int rings) {
  return ray_gradients(bin(photons, used, area_m2, frame, rings), GradientMode::ward_heckbert,
                       std::numeric_limits<float>::min());
}

}  // namespace phos
