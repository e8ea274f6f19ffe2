#include "cache/gradients.h"

#include <algorithm>
#include <cmath>

namespace phos {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr int kRotationRings = 8;

/// T_j of FORMULAS B1: mean of tan(theta) over ring j of m rings of equal projected solid angle.
double ring_tangent(int j, int m) {
  const double inner = std::asin(std::sqrt(j / double(m))), outer = std::asin(std::sqrt((j + 1) / double(m)));
  return m * ((outer - inner) - (std::sin(2 * outer) - std::sin(2 * inner)) / 2);
}

int ring_of(float cos_theta, int m) {
  return std::clamp(static_cast<int>(static_cast<float>(m) * (1 - cos_theta * cos_theta)), 0, m - 1);
}

/// Light and nearness of one cell of the hemisphere.
struct Cell {
  DVec3 light{0};  // radiance, cd/m2
  double flux = 0, flux_over_distance = 0;
  double nearness() const { return flux > 0 ? flux_over_distance / flux : 0; }  // 1/m
};

struct Hemisphere {
  int rings, slices;
  std::vector<Cell> cells;
  const Cell& at(int j, int k) const {
    return cells[static_cast<std::size_t>(j * slices + (k + slices) % slices)];
  }
  double slice_angle() const { return 2 * kPiD / slices; }
};

Hemisphere bin(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
               const Frame& frame, int rings) {
  Hemisphere h{rings, std::max(3, static_cast<int>(std::lround(kPiD * rings))), {}};
  h.cells.resize(static_cast<std::size_t>(h.rings * h.slices));
  const double per_flux = h.rings * h.slices / (kPiD * area_m2);  // D1
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    const Vec3 w = frame.to_local(photons.direction[i]);
    double turn = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * kPiD);
    if (turn < 0) turn += 1;
    const int slice = std::clamp(static_cast<int>(turn * h.slices), 0, h.slices - 1);
    Cell& c = h.cells[static_cast<std::size_t>(ring_of(w.z, rings) * h.slices + slice)];
    const double flux = static_cast<double>(luminance(photons.flux_lm[i]));
    c.light += DVec3(photons.flux_lm[i]) * per_flux;
    c.flux += flux, c.flux_over_distance += flux * static_cast<double>(photons.inverse_distance[i]);
  }
  return h;
}

void add(Vec3 (&rows)[3], const DVec3& light, const Vec3& direction) {
  for (int c = 0; c < 3; ++c) rows[c] += static_cast<float>(light[c]) * direction;
}

}  // namespace

Vec3 photon_translation_term(const ZonePhotons& photons, std::size_t i, const Vec3& normal) {
  const Vec3 w = photons.direction[i], source = photons.source_normal[i];
  const float cos_source = std::max(0.1f, -glm::dot(source, w));
  const Vec3 term = source / cos_source + 4.f * w;
  return (term - glm::dot(term, normal) * normal) * photons.inverse_distance[i];
}

Gradients photon_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                           const Frame& frame) {
  double tangent[kRotationRings];
  for (int j = 0; j < kRotationRings; ++j) tangent[j] = ring_tangent(j, kRotationRings);
  glm::dmat3 rotation(0), translation(0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    const DVec3 flux(photons.flux_lm[i]);
    const DVec3 step(photon_translation_term(photons, i, frame.z));
    const Vec3 w = photons.direction[i], across = glm::cross(frame.z, w);
    const float length = glm::length(across);
    const DVec3 turn = length > 0
                           ? DVec3(across / length) * tangent[ring_of(glm::dot(w, frame.z), kRotationRings)]
                           : DVec3(0);
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
  const Hemisphere h = bin(photons, used, area_m2, frame, rings);
  const double m = h.rings, n = h.slices, width = h.slice_angle();
  const double sinc = std::sin(kPiD / n) / (kPiD / n);
  Gradients g;
  for (int k = 0; k < h.slices; ++k) {
    const auto around = [&](double angle) {  // unit vector of the tangent plane at this azimuth
      return frame.to_world(Vec3(std::cos(angle), std::sin(angle), 0));
    };
    const Vec3 u = around((k + 0.5) * width), v = around((k + 0.5) * width + kPiD / 2);
    const Vec3 v_edge = around(k * width + kPiD / 2);
    for (int j = 0; j < h.rings; ++j) {
      const Cell& cell = h.at(j, k);
      add(g.rotation, kPiD / (m * n) * sinc * ring_tangent(j, h.rings) * cell.light, v);
      const double sin_inner = std::sqrt(j / m), sin_outer = std::sqrt((j + 1) / m), cos2_inner = 1 - j / m;
      if (j > 0) {
        const Cell& inner = h.at(j - 1, k);
        const double near = std::max(cell.nearness(), inner.nearness());
        add(g.translation, width * sin_inner * cos2_inner * near * (cell.light - inner.light), u);
      }
      const Cell& before = h.at(j, k - 1);
      const double near = std::max(cell.nearness(), before.nearness());
      add(g.translation, (sin_outer - sin_inner) * near * (cell.light - before.light), v_edge);
    }
  }
  return g;
}

}  // namespace phos
