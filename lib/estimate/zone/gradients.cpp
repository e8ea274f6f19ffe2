#include "estimate/zone/gradients.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "estimate/hemisphere/hemisphere.h"
#include "estimate/hemisphere/ray_gradients.h"

namespace phos::inline estimate {
namespace {

constexpr int kRotationRings = 8;
constexpr double kFlat = 1e-10;  // determinant of second moments, in squares of their trace, that is no shape

int ring_of(float cos_theta, int rings) {
  return std::clamp(static_cast<int>(static_cast<float>(rings) * (1 - cos_theta * cos_theta)), 0, rings - 1);
}

/// Light and mean distance of the photons of each cell of a hemisphere (docs/methods.md#d1).
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

/// Sums of analytic terms, photon by photon.
struct AnalyticSums {
  glm::dmat3 rotation{0}, translation{0};
  void add(const Rgb& flux_lm, const Vec3& step, const Vec3& turn) {
    for (int c = 0; c < 3; ++c) {
      translation[c] += double(flux_lm[c]) * DVec3(step), rotation[c] += double(flux_lm[c]) * DVec3(turn);
    }
  }
  Gradients over(double area_m2) const {
    Gradients g;
    for (int c = 0; c < 3; ++c) {
      g.translation[c] = Vec3(translation[c] / area_m2), g.rotation[c] = Vec3(rotation[c] / area_m2);
    }
    return g;
  }
};

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

float curvature_term(const Vec3& w, const Vec3& source_normal, float inverse_distance, const Vec3& normal,
                     const Vec3& step_m) {
  constexpr float kNoSurface = 0.9999f;  // cosine, rounding of stored directions allowed for
  constexpr float kNearest = 0.25f;      // square of the distance after the step over that before
  const Vec3 to = w - inverse_distance * step_m, across = to - glm::dot(to, normal) * normal;
  const float over2 = 1 / std::max(kNearest, glm::dot(to, to)), cos_source = -glm::dot(source_normal, w);
  const float near2 = inverse_distance * inverse_distance * over2;
  const float across2 = glm::dot(across, across) * over2;
  if (cos_source > kNoSurface) return near2 * over2 * std::sqrt(over2) * (15 * across2 - 6);
  const float cos_here = std::max(0.1f, cos_source), cos_there = std::max(0.1f, -glm::dot(source_normal, to));
  return near2 * over2 * over2 * (8 * glm::dot(source_normal, across) + cos_there * (24 * across2 - 8)) /
         cos_here;
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
  AnalyticSums sums;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    sums.add(photons.flux_lm[i], photon_translation_term(photons, i, frame.z),
             rotation_term(photons.direction[i], frame.z));
  }
  return sums.over(area_m2);
}

ZoneShape disc_shape(double radius_m) {
  const double r2 = radius_m * radius_m;
  return {glm::dvec2(0), glm::dmat2(std::numbers::pi / 4 * r2 * r2)};
}

ZoneShape polygon_shape(std::span<const Vec2> points, std::span<const std::uint32_t> vertices) {
  // Triangles from the first vertex; of a triangle with corners 0, a, b and area A: integral of x = A (a +
  // b)/3, of x x^T = A/6 (a a^T + b b^T + (a b^T + b a^T)/2).
  ZoneShape shape;
  if (vertices.size() < 3) return shape;
  const glm::dvec2 origin(points[vertices[0]]);
  double area = 0;
  glm::dvec2 first(0);
  glm::dmat2 second(0);
  for (std::size_t i = 2; i < vertices.size(); ++i) {
    const glm::dvec2 a = glm::dvec2(points[vertices[i - 1]]) - origin,
                     b = glm::dvec2(points[vertices[i]]) - origin;
    const double half = (a.x * b.y - a.y * b.x) / 2;
    area += half, first += half / 3 * (a + b);
    second += half / 6 *
              (glm::outerProduct(a, a) + glm::outerProduct(b, b) +
               0.5 * (glm::outerProduct(a, b) + glm::outerProduct(b, a)));
  }
  if (area == 0) return shape;
  const glm::dvec2 centroid = first / area;
  shape.centroid_m = origin + centroid;
  shape.second_moments_m4 = (second - area * glm::outerProduct(centroid, centroid)) * (area > 0 ? 1.0 : -1.0);
  return shape;
}

ComparedGradients compare_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used,
                                    double area_m2, const Frame& frame, const ZoneShape& shape) {
  const glm::dmat2& m = shape.second_moments_m4;
  const double spread = m[0][0] + m[1][1];
  if (!(glm::determinant(m) > kFlat * spread * spread)) {
    const Gradients analytic = photon_gradients(photons, used, area_m2, frame);
    return {analytic, analytic, analytic};
  }
  const glm::dmat2 inverse = glm::inverse(m);
  AnalyticSums sums;
  glm::dmat2x3 rows(0);  // columns are axes of the frame, rows channels
  glm::dvec2 difference(0);
  double variance = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    const Vec3 step = photon_translation_term(photons, i, frame.z);
    sums.add(photons.flux_lm[i], step, rotation_term(photons.direction[i], frame.z));
    const glm::dvec2 place = inverse * (glm::dvec2(photons.offset_m[i]) - shape.centroid_m);
    const glm::dvec2 shift = glm::dvec2(glm::dot(step, frame.x), glm::dot(step, frame.y)) / area_m2;
    rows += glm::outerProduct(DVec3(photons.flux_lm[i]), place);
    const auto flux = static_cast<double>(luminance(photons.flux_lm[i]));
    difference += flux * (place - shift);
    variance += flux * flux * (glm::dot(place, place) + glm::dot(shift, shift));
  }
  ComparedGradients g;
  g.analytic = sums.over(area_m2);
  g.positional = g.blend = g.analytic;
  if (!(variance > 0)) return g;
  g.z2 = glm::dot(difference, difference) / variance;
  const auto part = static_cast<float>(std::max(0.0, 1 - 3 / g.z2));
  for (int c = 0; c < 3; ++c) {
    g.positional.translation[c] = frame.to_world(Vec3(rows[0][c], rows[1][c], 0));
    g.blend.translation[c] = glm::mix(g.analytic.translation[c], g.positional.translation[c], part);
  }
  return g;
}

Gradients hemisphere_gradients(const ZonePhotons& photons, std::span<const std::uint8_t> used, double area_m2,
                               const Frame& frame, int rings) {
  return ray_gradients(bin(photons, used, area_m2, frame, rings), GradientMode::ward_heckbert,
                       std::numeric_limits<float>::min());
}

}  // namespace phos::inline estimate
