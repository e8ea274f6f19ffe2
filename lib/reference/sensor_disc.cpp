#include "reference/sensor_disc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phos::inline reference {
namespace {

/// Of the distance to surfaces in the plane, so much is taken as free: a sector's sides reach it before
/// its middle.
constexpr float kFree = 0.9f;
/// Rounding of a segment's end, and of the sensor's place, in their bounds.
constexpr float kSlack = 2;
/// Below so many paths their noise is not known.
constexpr std::size_t kLeastPaths = 32;
/// Differences between radii up to so many standard deviations are noise.
constexpr double kNoise = 1.5;

}  // namespace

SensorDisc::SensorDisc(const RayScene& rays, const SurfacePoint& sensor, float most_m)
    : centre_(sensor.position),
      frame_(make_frame(sensor.geometric_normal)),
      slack_m_(kSlack * sensor.error_m),
      most_m_(most_m) {
  const auto reach_m = [&](double sectors) {
    const double angle = 2 * std::numbers::pi * sectors / kSectors;
    const Vec3 along =
        frame_.to_world({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    // Above the sensor's own surface.
    Hit hit;
    const Ray ray{centre_ + 2 * slack_m_ * frame_.z, glm::normalize(along), 0, most_m / kFree};
    return rays.intersect(ray, hit) ? std::min(most_m, kFree * hit.distance_m) : most_m;
  };
  // A sector that a wall enters from the side ends where the wall begins: no light from behind it counts.
  float before_m = reach_m(0);
  for (std::size_t k = 0; k < kSectors; ++k) {
    const float after_m = reach_m(static_cast<double>(k + 1));
    reach_m_[k] = std::min({before_m, reach_m(static_cast<double>(k) + 0.5), after_m});
    before_m = after_m;
  }
}

double SensorDisc::area_m2(double radius_m) const {
  double sum = 0;
  for (const float reach : reach_m_) {
    const double r = std::min(radius_m, static_cast<double>(reach));
    sum += r * r;
  }
  return std::numbers::pi / kSectors * sum;
}

bool SensorDisc::cross(const SharpSegment& s, Crossing& crossing) const {
  const float cosine = -glm::dot(s.direction, frame_.z);
  if (!(cosine > 0)) return false;
  const float height = glm::dot(s.start - centre_, frame_.z), slack = slack_m_ + kSlack * s.slack_m;
  if (!(height > slack) || !(height - s.length_m * cosine <= slack)) return false;
  const float along = std::min(s.length_m, height / cosine);
  const Vec3 way = s.start + along * s.direction - centre_;
  const double x = static_cast<double>(glm::dot(way, frame_.x)),
               y = static_cast<double>(glm::dot(way, frame_.y));
  crossing.aside_m = std::hypot(x, y);
  if (!(crossing.aside_m <= static_cast<double>(most_m_))) return false;
  const double turns = std::atan2(y, x) / (2 * std::numbers::pi);
  const auto k = static_cast<std::size_t>((turns < 0 ? turns + 1 : turns) * kSectors);
  crossing.reach_m = static_cast<double>(reach_m_[std::min(k, kSectors - 1)]);
  crossing.cosine = static_cast<double>(cosine);
  crossing.distance_m = static_cast<double>(s.before_m + along);
  return crossing.aside_m <= crossing.reach_m;
}

std::array<double, kDiscRadii> SensorDisc::areas_m2() const {
  std::array<double, kDiscRadii> area{};
  for (std::size_t i = 0; i < kDiscRadii; ++i) area[i] = area_m2(radius_m(i));
  return area;
}

DiscPass SensorDisc::light(const LightPaths& paths, double eta, std::int64_t bounces) const {
  DiscPass pass;
  for (const SharpSegment& s : paths.segment) {
    Crossing c;
    if (bounces >= 0 && s.scatterings + 1 > bounces) continue;
    if (!cross(s, c)) continue;
    // As instead_of_merging() of a vertex at the sensor.
    SubPathEnd end;
    const double across = s.density * c.cosine;
    if (!s.mirror) end.connect = c.distance_m * c.distance_m / across;
    end.before = s.cos_leaving / across * s.behind;
    const double weight = balance(end.instead_of_merging(eta, c.cosine / std::numbers::pi), 0);
    const DVec3 flux = weight * DVec3(s.flux_lm);
    for (std::size_t i = 0; i < kDiscRadii && c.aside_m <= radius_m(i); ++i)
      pass.lux[i] += flux, ++pass.paths[i];
  }
  for (std::size_t i = 0; i < kDiscRadii; ++i) {
    const double all_m2 = area_m2(radius_m(i)) * static_cast<double>(paths.size());
    pass.lux[i] = all_m2 > 0 ? pass.lux[i] / all_m2 : DVec3(0);
  }
  return pass;
}

double SensorDisc::balanced_radius_m(const LightPaths& paths) const {
  struct Sum {
    double flux = 0, squares = 0;
    std::size_t paths = 0;
  };
  std::array<Sum, kDiscRadii> within{};
  for (const SharpSegment& s : paths.segment) {
    Crossing c;
    if (!cross(s, c)) continue;
    const double flux = static_cast<double>(luminance(s.flux_lm));
    for (std::size_t j = 0; j < kDiscRadii && c.aside_m <= radius_m(j); ++j)
      within[j].flux += flux, within[j].squares += flux * flux, ++within[j].paths;
  }
  std::size_t last = 0;
  while (last + 1 < kDiscRadii && within[last + 1].paths >= kLeastPaths) ++last;
  const auto lux = [&](std::size_t j) { return within[j].flux / area_m2(radius_m(j)); };
  for (std::size_t j = 0; j < last; ++j) {
    bool alike = true;
    for (std::size_t k = j + 1; k <= last && alike; ++k)
      alike = std::fabs(lux(j) - lux(k)) <= kNoise * std::sqrt(within[k].squares) / area_m2(radius_m(k));
    if (alike) return radius_m(j);
  }
  return radius_m(last);
}

}  // namespace phos::inline reference
