// Rectangles and a sphere of uniform luminance round a receiver: irradiance in closed form, gradients by
// finite differences of this irradiance, and the rays and photons from which estimators take their gradients.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/zone/gradients.h"

namespace phos::test {

using DVec2 = glm::dvec2;

/// Perpendicular to an axis; luminous on both sides.
struct Rectangle {
  int axis;
  double at;
  DVec2 lo, hi;  ///< in the other two axes, ascending
  double luminance = 1;
  double checker = 0;  ///< side of the squares of a checkerboard, every other of them dark; 0: none

  double area() const { return (hi.x - lo.x) * (hi.y - lo.y); }
  DVec3 point(const DVec2& q) const {
    return axis == 0 ? DVec3(at, q) : axis == 1 ? DVec3(q.x, at, q.y) : DVec3(q, at);
  }
  DVec2 place(const DVec3& p) const {
    return axis == 0 ? DVec2(p.y, p.z) : axis == 1 ? DVec2(p.x, p.z) : DVec2(p.x, p.y);
  }
  double luminance_at(const DVec2& q) const {
    if (checker == 0) return luminance;
    const auto square = [&](double x) { return static_cast<int>(std::floor(x / checker)); };
    return (square(q.x) + square(q.y)) % 2 != 0 ? luminance : 0;
  }
};

struct Ball {
  DVec3 centre;
  double radius, luminance;
};

/// Irradiance from a rectangle, lx: E = L/2 |sum over its edges of the angle they subtend times n.(unit
/// normal of the plane through p and the edge)| (Lambert), of the part above the horizon of n.
inline double rectangle_lx(const Rectangle& r, const DVec2& lo, const DVec2& hi, const DVec3& p,
                           const DVec3& n) {
  const DVec3 corner[] = {r.point(lo) - p, r.point({hi.x, lo.y}) - p, r.point(hi) - p,
                          r.point({lo.x, hi.y}) - p};
  std::vector<DVec3> above;
  for (int i = 0; i < 4; ++i) {
    const DVec3 &a = corner[i], &b = corner[(i + 1) % 4];
    const double da = glm::dot(a, n), db = glm::dot(b, n);
    if (da >= 0) above.push_back(a);
    if (da * db < 0) above.push_back(a + (b - a) * (da / (da - db)));
  }
  if (above.size() < 3) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const DVec3 &a = above[i], &b = above[(i + 1) % above.size()];
    const DVec3 normal = glm::cross(a, b);
    const double length = glm::length(normal);
    if (length > 0) sum += std::atan2(length, glm::dot(a, b)) * glm::dot(normal, n) / length;
  }
  return r.luminance / 2 * std::fabs(sum);
}

struct GradientScene {
  std::string name;
  std::vector<Rectangle> rectangles;
  std::optional<Ball> ball;
  bool occluded = false;  ///< the last rectangle is dark and stands before the first
  DVec3 receiver{0};      ///< normal +z

  double irradiance_lx(const DVec3& p, const DVec3& n = {0, 0, 1}) const {
    double e = 0;
    for (const Rectangle& r : rectangles) {
      if (r.checker == 0) {
        e += rectangle_lx(r, r.lo, r.hi, p, n);
        continue;
      }
      for (double y = r.lo.y; y < r.hi.y; y += r.checker)
        for (double x = r.lo.x; x < r.hi.x; x += r.checker)
          if (r.luminance_at({x + r.checker / 2, y + r.checker / 2}) > 0)
            e += rectangle_lx(r, {x, y}, {x + r.checker, y + r.checker}, p, n);
    }
    if (occluded) {  // the part of the first that the occluder's projection from p covers
      const Rectangle &lamp = rectangles.front(), &occluder = rectangles.back();
      const double grown = (lamp.at - p.z) / (occluder.at - p.z);
      const DVec2 eye(p), lo = glm::max(lamp.lo, eye + (occluder.lo - eye) * grown),
                          hi = glm::min(lamp.hi, eye + (occluder.hi - eye) * grown);
      if (lo.x < hi.x && lo.y < hi.y) e -= rectangle_lx(lamp, lo, hi, p, n);
    }
    if (ball) {  // wholly above the horizon: pi L (a/d)^2 cos
      const DVec3 to = ball->centre - p;
      const double d2 = glm::dot(to, to);
      e += std::numbers::pi * ball->luminance * ball->radius * ball->radius / d2 * glm::dot(to, n) /
           std::sqrt(d2);
    }
    return e;
  }

  /// Of a function of a shift, at 0, to fourth order.
  static double slope(const std::function<double(double)>& f) {
    const double h = 1e-3;
    return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
  }
  DVec2 translation() const {  ///< lx/m
    return {slope([&](double s) { return irradiance_lx(receiver + DVec3(s, 0, 0)); }),
            slope([&](double s) { return irradiance_lx(receiver + DVec3(0, s, 0)); })};
  }
  DVec2 rotation() const {  ///< lx/rad, for use with n x n'
    const auto towards = [&](const DVec3& axis) {
      return slope(
          [&](double s) { return irradiance_lx(receiver, DVec3(0, 0, std::cos(s)) + std::sin(s) * axis); });
    };
    return {-towards({0, 1, 0}), towards({1, 0, 0})};
  }

  /// The first surface along unit w from the receiver.
  void trace(const DVec3& w, double& distance, double& luminance, DVec3& normal) const {
    distance = HUGE_VAL, luminance = 0, normal = -w;
    for (const Rectangle& r : rectangles) {
      const double t = (r.at - receiver[r.axis]) / w[r.axis];
      if (!(t > 1e-9) || !(t < distance)) continue;
      const DVec2 q = r.place(receiver + t * w);
      if (q.x < r.lo.x || q.y < r.lo.y || q.x > r.hi.x || q.y > r.hi.y) continue;
      distance = t, luminance = r.luminance_at(q), normal = DVec3(0);
      normal[r.axis] = w[r.axis] > 0 ? -1 : 1;
    }
    if (!ball) return;
    const DVec3 to = ball->centre - receiver;
    const double along = glm::dot(to, w),
                 under_root = along * along - (glm::dot(to, to) - ball->radius * ball->radius);
    if (!(under_root > 0) || !(along > 0)) return;
    const double t = along - std::sqrt(under_root);
    if (!(t < distance)) return;
    distance = t, luminance = ball->luminance, normal = (t * w - to) / ball->radius;
  }
};

inline std::vector<Rectangle> box(double ceiling, double x_lo, double x_hi, double y_lo, double y_hi) {
  return {{2, 2, {-1.2, -1}, {0.8, 1}, ceiling},
          {0, -1.2, {-1, 0}, {1, 2}, x_lo},
          {0, 0.8, {-1, 0}, {1, 2}, x_hi},
          {1, -1, {-1.2, 0}, {0.8, 2}, y_lo},
          {1, 1, {-1.2, 0}, {0.8, 2}, y_hi}};
}

/// The scenes of the golden tables of gradients, by their names there.
inline std::vector<GradientScene> gradient_scenes() {
  return {
      {"rect_ceiling", {{2, 2, {-0.5, -1}, {1.5, 1}}}, {}, false, {}},
      {"rect_wall_x1", {{0, 1, {-1, 0}, {2, 2}}}, {}, false, {}},
      {"rect_wall_x0.25", {{0, 0.25, {-1, 0}, {2, 2}}}, {}, false, {}},
      {"checker_ceiling", {{2, 1.5, {-3, -3}, {3, 3}, 1, 1}}, {}, false, {0.13, -0.07, 0}},
      {"rect_occluded", {{2, 2, {-1, -1}, {1, 1}}, {2, 1, {0.2, -0.6}, {1.2, 0.3}, 0}}, {}, true, {}},
      {"sphere", {}, Ball{{0.8, 0.3, 1.5}, 0.4, 1}, false, {}},
      {"closed_box_5L", box(1, 0.5, 0.2, 0.8, 0.1), {}, false, {}},
      {"white_furnace", box(1, 1, 1, 1, 1), {}, false, {}},
  };
}

inline GradientScene gradient_scene(const std::string& name) {
  for (GradientScene& s : gradient_scenes())
    if (s.name == name) return s;
  throw std::invalid_argument(name);
}

/// A stratified hemisphere at the scene's receiver, jittered by `random`.
inline Hemisphere seen_by_rays(const GradientScene& scene, int rings, int slices, RandomStream& random,
                               const Frame& frame = {}) {
  Hemisphere h;
  h.frame = frame, h.rings = rings, h.slices = slices;
  h.resize(static_cast<std::size_t>(rings * slices));
  for (int j = 0; j < rings; ++j) {
    random.start_bounce(static_cast<std::uint32_t>(j));
    for (int k = 0; k < slices; ++k) {
      const double sin2 = (j + random.uniform_double()) / rings,
                   phi = 2 * std::numbers::pi * (k + random.uniform_double()) / slices;
      const DVec3 local(std::sqrt(sin2) * std::cos(phi), std::sqrt(sin2) * std::sin(phi),
                        std::sqrt(1 - sin2));
      const DVec3 w = local.x * DVec3(frame.x) + local.y * DVec3(frame.y) + local.z * DVec3(frame.z);
      double distance, luminance;
      DVec3 normal;
      scene.trace(w, distance, luminance, normal);
      const std::size_t i = h.at(j, k);
      h.direction[i] = Vec3(w), h.hit_normal[i] = Vec3(normal);
      h.distance_m[i] = static_cast<float>(distance), h.radiance[i] = Rgb(static_cast<float>(luminance));
      h.projected_sr[i] = static_cast<float>(std::numbers::pi / (rings * slices));
    }
  }
  return h;
}

/// Draws photons that land on a disc about the origin, of scenes of rectangles.
class PhotonSource {
 public:
  PhotonSource(const GradientScene& scene, double radius_m) : scene_(scene), radius_m_(radius_m) {
    for (const Rectangle& r : scene.rectangles) {
      // cos cos / d2 is at most 1 / d2 from a ceiling, and 1 / (2 d2) from a wall.
      const double d = r.axis == 2 ? r.at : glm::length(r.point(glm::clamp(DVec2(0), r.lo, r.hi))) - radius_m;
      most_.push_back((r.axis == 2 ? 1 : 0.5) / (d * d));
      cdf_.push_back((cdf_.empty() ? 0 : cdf_.back()) + r.luminance * r.area() * most_.back());
    }
    const int rings = 40, slices = 80;
    for (int j = 0; j < rings; ++j)
      for (int k = 0; k < slices; ++k) {
        const double r = radius_m * std::sqrt((j + 0.5) / rings),
                     phi = 2 * std::numbers::pi * (k + 0.5) / slices;
        mean_lx_ += scene.irradiance_lx({r * std::cos(phi), r * std::sin(phi), 0}) / (rings * slices);
      }
  }
  double area_m2() const { return std::numbers::pi * radius_m_ * radius_m_; }
  double mean_lx() const { return mean_lx_; }  ///< irradiance, over the disc

  /// Exactly `count` photons that share out the flux of `expected`.
  void draw(std::size_t count, double expected, RandomStream& random, ZonePhotons& zone) const {
    zone.clear();
    const auto flux = static_cast<float>(mean_lx_ * area_m2() / expected);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 16 == 0) random.start_bounce(static_cast<std::uint32_t>(1 + i / 16));
      draw_one(flux, random, zone);
    }
  }
  /// Poisson photons, `expected` on the mean.
  void draw_poisson(double expected, RandomStream& random, ZonePhotons& zone) const {
    random.start_bounce(0);
    std::size_t count = 0;
    for (double sum = -std::log1p(-random.uniform_double()); sum < expected; ++count)
      sum -= std::log1p(-random.uniform_double());
    draw(count, expected, random, zone);
  }

 private:
  void draw_one(float flux, RandomStream& random, ZonePhotons& zone) const {
    for (;;) {
      const double u = random.uniform_double() * cdf_.back();
      std::size_t i = 0;
      while (i + 1 < cdf_.size() && cdf_[i] <= u) ++i;
      const Rectangle& r = scene_.rectangles[i];
      const double away = radius_m_ * std::sqrt(random.uniform_double()),
                   phi = 2 * std::numbers::pi * random.uniform_double();
      const DVec3 x(away * std::cos(phi), away * std::sin(phi), 0);
      const double a = random.uniform_double(), b = random.uniform_double();
      const DVec3 step = r.point(r.lo + DVec2(a, b) * (r.hi - r.lo)) - x;
      const double d2 = glm::dot(step, step), d = std::sqrt(d2);
      const double kept = std::fabs(step[r.axis]) / d * step.z / d / d2;
      if (random.uniform_double() * most_[i] >= kept || hidden(x, step)) continue;
      zone.offset_m.emplace_back(Vec2(DVec2(x))), zone.flux_lm.emplace_back(flux);
      zone.direction.emplace_back(Vec3(step / d)), zone.inverse_distance.push_back(static_cast<float>(1 / d));
      Vec3 normal(0);
      normal[r.axis] = step[r.axis] > 0 ? -1 : 1;
      zone.source_normal.push_back(normal);
      return;
    }
  }
  bool hidden(const DVec3& x, const DVec3& step) const {
    if (!scene_.occluded) return false;
    const Rectangle& o = scene_.rectangles.back();
    const DVec2 q(x + step * (o.at / step.z));
    return q.x >= o.lo.x && q.y >= o.lo.y && q.x <= o.hi.x && q.y <= o.hi.y;
  }
  GradientScene scene_;
  double radius_m_, mean_lx_ = 0;
  std::vector<double> most_, cdf_;
};

/// Mean and spread of a vector over repetitions.
struct Spread {
  DVec2 sum{0}, squares{0};
  double n = 0;
  void add(const DVec2& v) { sum += v, squares += v * v, n += 1; }
  DVec2 mean() const { return sum / n; }
  /// Root of the summed variances of both components.
  double sd() const {
    const DVec2 v = glm::max(squares / n - mean() * mean(), DVec2(0));
    return std::sqrt(v.x + v.y);
  }
};

}  // namespace phos::test
