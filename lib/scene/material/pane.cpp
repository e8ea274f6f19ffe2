#include "scene/material/pane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/error.h"

namespace phos::inline scene {
namespace {

Rgb power(const Rgb& base, float exponent) {
  Rgb out;
  for (int c = 0; c < 3; ++c) out[c] = base[c] >= 1 ? 1 : base[c] > 0 ? std::pow(base[c], exponent) : 0;
  return out;
}

}  // namespace

FaceReflectance face_reflectance(float cosine, float ior) {
  const double c = std::clamp(static_cast<double>(cosine), 0.0, 1.0), n = static_cast<double>(ior);
  const double sin2 = (1 - c * c) / (n * n);
  if (sin2 >= 1) return {};
  const double ct = std::sqrt(1 - sin2);
  const double s = (c - n * ct) / (c + n * ct), p = (n * c - ct) / (n * c + ct);
  return {static_cast<float>(s * s), static_cast<float>(p * p), static_cast<float>(ct)};
}

PaneLayer pane_layer(float cosine, float ior, const Rgb& inside) {
  const FaceReflectance face = face_reflectance(cosine, ior);
  PaneLayer layer;
  const bool dark = !(face.cos_refracted > 0);  // at grazing incidence upon glass of index 1
  const Rgb a = dark ? Rgb(0) : power(inside, 1 / face.cos_refracted);
  const float reflectance[2] = {face.s, face.p};
  for (int k = 0; k < 2; ++k) {
    const Rgb r(reflectance[k]), through = (Rgb(1) - r) * (Rgb(1) - r);
    Rgb rest = Rgb(1) - r * r * a * a;
    for (int c = 0; c < 3; ++c) rest[c] = rest[c] > 0 ? 1 / rest[c] : 0;  // R = 1: nothing passes
    layer.pass[k] = through * a * rest;
    layer.back[k] = layer.back_behind[k] = r + r * through * a * a * rest;
  }
  return layer;
}

double internal_transmittance(double normal_transmittance, double ior) {
  const double root = (ior - 1) / (ior + 1), r = root * root, t = normal_transmittance;
  const double k = (1 - r) * (1 - r);
  // The root of R^2 T a^2 + (1-R)^2 a - T = 0, without the cancellation of small R.
  return 2 * t / (k + std::sqrt(k * k + 4 * r * r * t * t));
}

PaneLayer stack(const PaneLayer& first, const PaneLayer& second) {
  PaneLayer both;
  for (int k = 0; k < 2; ++k)
    for (int c = 0; c < 3; ++c) {
      const float between = 1 - first.back_behind[k][c] * second.back[k][c];
      const float gain = between > 0 ? 1 / between : 0;  // two perfect mirrors: nothing gets between them
      const float ta = first.pass[k][c], tb = second.pass[k][c];
      both.pass[k][c] = ta * tb * gain;
      both.back[k][c] = first.back[k][c] + ta * ta * second.back[k][c] * gain;
      both.back_behind[k][c] = second.back_behind[k][c] + tb * tb * first.back_behind[k][c] * gain;
    }
  return both;
}

TransmittanceCurve::TransmittanceCurve(std::vector<Point> points) : points_(std::move(points)) {
  if (points_.empty() || points_[0].angle_deg != 0)
    throw std::runtime_error("must begin with an angle of 0 degrees");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto& [angle, t] = points_[i];
    if (!(t >= 0 && t <= 1)) throw std::runtime_error("has a transmittance that is not between 0 and 1");
    if (i > 0 && !(angle > points_[i - 1].angle_deg)) throw std::runtime_error("must have growing angles");
    if (!(angle <= 90)) throw std::runtime_error("has an angle above 90 degrees");
  }
  if (points_.back().angle_deg < 90) points_.push_back({90, 0});
  points_.back().transmittance = 0;
  const std::size_t n = points_.size();
  std::vector<double> secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i)
    secant[i] = (points_[i + 1].transmittance - points_[i].transmittance) /
                (points_[i + 1].angle_deg - points_[i].angle_deg);
  slope_.assign(n, 0);
  // At 0 degrees a curve is level. At 90 the parabola through the last three points tells, as far as it
  // falls.
  slope_[n - 1] = n > 1 ? secant[n - 2] : 0;
  if (n > 2) {
    const double last = points_[n - 1].angle_deg - points_[n - 2].angle_deg,
                 before = points_[n - 2].angle_deg - points_[n - 3].angle_deg;
    const double slope = ((2 * last + before) * secant[n - 2] - last * secant[n - 3]) / (last + before);
    slope_[n - 1] = std::clamp(slope, std::min(3 * secant[n - 2], 0.0), 0.0);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (secant[i - 1] * secant[i] <= 0) continue;
    const double before = points_[i].angle_deg - points_[i - 1].angle_deg,
                 after = points_[i + 1].angle_deg - points_[i].angle_deg;
    // The weighted harmonic mean (Fritsch and Butland 1984) keeps the cubic monotone.
    slope_[i] =
        3 * (before + after) / ((2 * after + before) / secant[i - 1] + (after + 2 * before) / secant[i]);
  }
}

float TransmittanceCurve::at(float cosine) const {
  const double angle =
      std::acos(std::clamp(static_cast<double>(cosine), 0.0, 1.0)) * (180 / std::numbers::pi);
  const auto above = std::upper_bound(points_.begin(), points_.end(), angle,
                                      [](double a, const Point& p) { return a < p.angle_deg; });
  if (above == points_.end()) return 0;
  const auto i = static_cast<std::size_t>(above - points_.begin()) - 1;
  const Point &a = points_[i], &b = points_[i + 1];
  const double h = b.angle_deg - a.angle_deg, x = (angle - a.angle_deg) / h, y = 1 - x;
  const double value = y * y * (1 + 2 * x) * a.transmittance + x * x * (1 + 2 * y) * b.transmittance +
                       h * x * y * (y * slope_[i] - x * slope_[i + 1]);
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

}  // namespace phos::inline scene
