// Luminous surfaces round a place that faces +z, as seen along each direction: the true coefficients of
// radiance and their gradients.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/random.h"
#include "estimate/radiance_record.h"
#include "hsh/projection.h"
#include "support/gradient_scenes.h"

namespace phos::test {

struct Seen {
  double distance = HUGE_VAL;
  DVec3 normal{0};
  double luminance = 0;
};

struct RadianceScene {
  std::string name;
  std::function<Seen(const DVec3& p, const DVec3& w)> look;

  /// Projected from p by quadrature, in double.
  std::vector<double> coefficients(const DVec3& p, int order, const Quadrature& q) const {
    return project(
        [&](double x, double y, double z) {
          return look(p, {x, y, z}).luminance;
        },
        BasisKind::hsh, order, q);
  }
  /// What rays along the directions of a quadrature show, from the origin.
  Hemisphere seen(const Quadrature& q) const {
    Hemisphere h;
    h.resize(q.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
      const DVec3 w(q.x[i], q.y[i], q.z[i]);
      const Seen s = look(DVec3(0), w);
      h.direction[i] = Vec3(w);
      h.hit_normal[i] = std::isinf(s.distance) ? -Vec3(w) : Vec3(s.normal);
      h.radiance[i] = Rgb(static_cast<float>(s.luminance));
      h.distance_m[i] = static_cast<float>(s.distance);
      h.projected_sr[i] = static_cast<float>(q.weight[i] * q.z[i]);
    }
    return h;
  }
};

/// A plane through `at` whose unit normal n faces the origin; luminance by the place on it.
inline RadianceScene plane(const std::string& name, const DVec3& at, const DVec3& n,
                           const std::function<double(const DVec3&)>& luminance) {
  return {name, [=](const DVec3& p, const DVec3& w) {
            const double towards = -glm::dot(n, w), t = glm::dot(n, p - at) / towards;
            if (!(towards > 0) || !(t > 0) || std::isinf(t)) return Seen{};
            return Seen{t, n, luminance(p + t * w)};
          }};
}

/// From within a sphere.
inline RadianceScene shell(const std::string& name, const DVec3& centre, double radius,
                           const std::function<double(const DVec3&)>& luminance) {
  return {name, [=](const DVec3& p, const DVec3& w) {
            const DVec3 from = p - centre;
            const double along = glm::dot(from, w);
            const double t = std::sqrt(along * along - glm::dot(from, from) + radius * radius) - along;
            const DVec3 hit = p + t * w;
            return Seen{t, (centre - hit) / radius, luminance(hit)};
          }};
}

inline std::vector<RadianceScene> radiance_scenes() {
  const auto glow = [](const DVec3& centre, double width) {
    return [=](const DVec3& q) { return std::exp(-glm::dot(q - centre, q - centre) / (2 * width * width)); };
  };
  const auto even = [](const DVec3&) { return 1.0; };
  return {plane("even ceiling", {0, 0, 1.5}, {0, 0, -1}, even),
          plane("glow on a ceiling", {0, 0, 1}, {0, 0, -1}, glow({0.3, -0.2, 1}, 0.6)),
          plane("glow on a tilted ceiling", {0, 0, 1}, glm::normalize(DVec3(0.3, -0.2, -1)),
                glow({0.2, 0.3, 1}, 0.6)),
          plane("glow on a wall", {1, 0, 0}, {-1, 0, 0}, glow({1, 0.2, 0.7}, 0.5)),
          shell("even sphere", {0.4, -0.2, 0.5}, 2, even),
          shell("sphere with a gradient", {0.4, -0.2, 0.5}, 2,
                [](const DVec3& q) { return 2 + std::sin(q.x) + 0.5 * q.y * q.z; })};
}

/// Coefficients of a scene of rectangles seen from p, by quadrature over its surfaces: the light stays where
/// it is. An occluder takes away the part of the first rectangle that its projection from p covers. With
/// `moments`, the cosine at p weighs the light.
inline std::vector<double> coefficients(const GradientScene& scene, const DVec3& p, int order,
                                        bool moments = false) {
  constexpr int kNodes = 48;
  const HarmonicBasis<double> basis(order);
  std::vector<double> sum(static_cast<std::size_t>(basis.count())), value(sum), node, weight;
  gauss_legendre(kNodes, node, weight);
  const auto add = [&](const Rectangle& r, double luminance) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      for (std::size_t j = 0; j < kNodes; ++j) {
        // Harmonics are smooth in the root of the height: walls stand on the horizon.
        const double u = 0.5 + 0.5 * node[i], t = 0.5 + 0.5 * node[j], v = r.axis == 2 ? t : t * t;
        const double area = 0.25 * weight[i] * weight[j] * r.area() * (r.axis == 2 ? 1 : 2 * t);
        const DVec3 step = r.point(r.lo + DVec2(u, v) * (r.hi - r.lo)) - p;
        const double d2 = glm::dot(step, step), d = std::sqrt(d2);
        basis.evaluate(BasisKind::hsh, step.x / d, step.y / d, step.z / d, value.data());
        const double light =
            luminance * area * std::fabs(step[r.axis]) / (d2 * d) * (moments ? step.z / d : 1);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += light * value[k];
      }
    }
  };
  for (const Rectangle& r : scene.rectangles) add(r, r.luminance);
  if (!scene.occluded) return sum;
  const Rectangle &lamp = scene.rectangles.front(), &occluder = scene.rectangles.back();
  const double grown = (lamp.at - p.z) / (occluder.at - p.z);
  const DVec2 eye(p), lo = glm::max(lamp.lo, eye + (occluder.lo - eye) * grown),
                      hi = glm::min(lamp.hi, eye + (occluder.hi - eye) * grown);
  if (lo.x < hi.x && lo.y < hi.y) add({lamp.axis, lamp.at, lo, hi}, -lamp.luminance);
  return sum;
}

/// Derivative of coefficients along an axis, to fourth order.
template <class Coefficients>
std::vector<double> slope_along(int axis, double step, const Coefficients& at) {
  DVec3 h(0);
  h[axis] = step;
  const std::vector<double> a = at(h), b = at(-h), c = at(2. * h), d = at(-2. * h);
  std::vector<double> slope(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) slope[i] = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * step);
  return slope;
}

/// A hemisphere stratified by solid angle, as GatherEstimator sends it, at the scene's receiver.
inline Hemisphere seen_over_solid_angle(const GradientScene& scene, int rings, RandomStream& random) {
  Hemisphere h;
  h.rings = rings, h.slices = slices_for(rings), h.measure = Measure::solid;
  h.resize(static_cast<std::size_t>(h.rings * h.slices));
  for (int j = 0; j < rings; ++j) {
    random.start_bounce(static_cast<std::uint32_t>(j));
    for (int k = 0; k < h.slices; ++k) {
      const double z = 1 - (j + random.uniform_double()) / rings, across = std::sqrt(1 - z * z),
                   phi = 2 * std::numbers::pi * (k + random.uniform_double()) / h.slices;
      const DVec3 w(across * std::cos(phi), across * std::sin(phi), z);
      double distance, luminance;
      DVec3 normal;
      scene.trace(w, distance, luminance, normal);
      const std::size_t i = h.at(j, k);
      h.direction[i] = Vec3(w), h.hit_normal[i] = Vec3(normal);
      h.distance_m[i] = static_cast<float>(distance), h.radiance[i] = Rgb(static_cast<float>(luminance));
      h.projected_sr[i] = h.solid_sr(i) * static_cast<float>(z);
    }
  }
  return h;
}

/// One channel of numbers of RGB side by side, in double.
inline std::vector<double> channel(const std::vector<float>& numbers, std::size_t c = 1) {
  std::vector<double> out;
  for (std::size_t i = c; i < numbers.size(); i += 3) out.push_back(static_cast<double>(numbers[i]));
  return out;
}

inline double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}
inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return norm(d);
}

/// Mean and variance of each of a set of numbers.
struct Spreads {
  std::vector<double> sum, squares;
  double n = 0;
  void add(const std::vector<double>& v) {
    sum.resize(v.size()), squares.resize(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) sum[i] += v[i], squares[i] += v[i] * v[i];
    n += 1;
  }
  double mean(std::size_t i) const { return sum[i] / n; }
  double variance(std::size_t i) const { return (squares[i] / n - mean(i) * mean(i)) * n / (n - 1); }
  /// The largest |mean - truth| in standard errors of the mean; `bias` is granted.
  double worst_z(const std::vector<double>& truth, double bias) const {
    double worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      worst =
          std::max(worst, std::max(0., std::fabs(mean(i) - truth[i]) - bias) / std::sqrt(variance(i) / n));
    return worst;
  }
};

}  // namespace phos::test
