#include "estimate/hemisphere/radiance_axes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "estimate/record_of.h"
#include "record/weight.h"

namespace phos::inline estimate {
namespace {

constexpr std::size_t kAxes = AdaptiveFootprint::kAxes;
constexpr float kLightsEnough = 1024;
// Hits of neighbouring rays make one light where their normals and distances differ by no more than that.
constexpr float kAlikeNormal = 0.95f, kAlike = 1.25f;
constexpr float kLeastNearness = 0.25f;      // how near hits come, of their distance
constexpr float kLeastEmitterCosine = 0.1f;  // docs/methods.md#b4
constexpr double kLeastLight = 1e-3;         // of the light at the record: less is none
constexpr float kWhere = 0.75f;              // of an axis: where light is compared
constexpr float kShorter = 0.75f;            // a step towards a place where enough is known
// A step towards a length with an error of rho, where the error goes as the square of the length.
constexpr float kMargin = 0.95f, kLeastStep = 0.5f, kMostStep = 0.9f;

Vec2 axis_of(std::size_t k) { return AdaptiveFootprint::direction(static_cast<int>(k)); }

/// Weights of the bands in sums of squared coefficients [order^2][3]. The light that a lobe reflects holds
/// each band in proportion to the lobe's energy in the band. The weights are the energies of a lobe that
/// needs this order: a hundredth of its energy lies beyond the order.
class BandShares {
 public:
  explicit BandShares(int order) {
    for (int l = 0; l < order; ++l) {
      const double part = static_cast<double>(l) / order;
      share_.insert(share_.end(), static_cast<std::size_t>(3 * (2 * l + 1)),
                    std::exp(-kSpectrum * part * part));
    }
  }
  /// Sum of the squares of number(i).
  template <class Number>
  double squares(const Number& number) const {
    double sum = 0;
    for (std::size_t i = 0; i < share_.size(); ++i) {
      const double x = number(i);
      sum += share_[i] * x * x;
    }
    return sum;
  }
  /// The root of that, of each colour.
  template <class Number>
  Rgb norm(const Number& number) const {
    DVec3 sum(0);
    for (std::size_t i = 0; i < share_.size(); ++i) {
      const double x = number(i);
      sum[static_cast<int>(i % 3)] += share_[i] * x * x;
    }
    return Rgb(glm::sqrt(sum));
  }

 private:
  static constexpr double kSpectrum = 4.605170185988091;  // log(100)
  std::vector<double> share_;
};

/// How much of radius_m the change along u leaves, as within_gradient_m() of all directions.
float within_change_m(const RadianceRecord& r, const BandShares& bands, const Vec2& u, float radius_m) {
  const Rgb slope = bands.norm(
      [&](std::size_t i) { return static_cast<double>(u.x * r.gradient_x[i] + u.y * r.gradient_y[i]); });
  const Vec3 along[3] = {Vec3(slope.x, 0, 0), Vec3(slope.y, 0, 0), Vec3(slope.z, 0, 0)};
  const Rgb light = bands.norm([&](std::size_t i) { return static_cast<double>(r.light[i]); });
  return within_gradient_m(light, along, radius_m);
}

}  // namespace

/// Neighbouring rays with hits alike: sums weighted by the share that they take.
struct RadianceNearby::Bundle {
  float distance_m;  // of the first
  Vec3 normal;       // of the first
  float seen = 0, nearness = 0;
  Vec3 direction{0}, normals{0};
  Rgb light{0};

  bool takes(float d, const Vec3& n) const {
    if (!std::isfinite(d) || !std::isfinite(distance_m)) return d == distance_m;
    return glm::dot(n, normal) > kAlikeNormal && std::max(d, distance_m) <= kAlike * std::min(d, distance_m);
  }
};

RadianceNearby::RadianceNearby(const Hemisphere& h, int order, float least_m) : sums_(order) {
  PHOS_CHECK(h.stratified(), "rays without cells");
  const auto merged = std::lround(std::sqrt(static_cast<float>(h.size()) / kLightsEnough));
  const int side = std::max(1, static_cast<int>(merged));
  std::vector<Bundle> bundles;
  const auto add_ray = [&](std::size_t i) {
    const Vec3 w = h.frame.to_local(h.direction[i]), n = h.frame.to_local(h.hit_normal[i]);
    const float d = std::max(h.distance_m[i], least_m);
    auto bundle =
        std::find_if(bundles.begin(), bundles.end(), [&](const Bundle& b) { return b.takes(d, n); });
    if (bundle == bundles.end()) bundle = bundles.insert(bundle, Bundle{.distance_m = d, .normal = n});
    const float sr = h.solid_sr(i), seen = sr / (2 * kPi);
    bundle->seen += seen, bundle->direction += seen * w, bundle->normals += seen * n;
    bundle->nearness += seen / d;
    bundle->light += sr * h.radiance[i];
  };
  for (int ring = 0; ring < h.rings; ring += side)
    for (int slice = 0; slice < h.slices; slice += side) {
      bundles.clear();
      for (int j = ring; j < std::min(ring + side, h.rings); ++j)
        for (int k = slice; k < std::min(slice + side, h.slices); ++k) add_ray(h.at(j, k));
      for (const Bundle& bundle : bundles) hits_.push_back(hit_of(bundle));
    }
}

RadianceNearby::Hit RadianceNearby::hit_of(const Bundle& b) {
  Hit hit{glm::normalize(b.direction), b.nearness / b.seen, Vec2(0), b.seen, b.light};
  const float cosine = -glm::dot(glm::normalize(b.normals), hit.direction);
  hit.normal = cosine < kLeastEmitterCosine ? -Vec2(hit.direction) : Vec2(glm::normalize(b.normals)) / cosine;
  return hit;
}

RadianceNearby::Light RadianceNearby::at(const Vec2& step) {
  sums_.start(SlopesBy::none, Falloff::solid);
  double seen = 0;
  for (const Hit& hit : hits_) {
    const Vec2 moved = hit.inverse_m * step;
    const Vec3 to = hit.direction - Vec3(moved, 0);
    const float far = glm::length(to), near = std::max(far, kLeastNearness);
    const float share = std::max(0.f, 1 + glm::dot(hit.normal, moved)) / (near * near * near);
    seen += static_cast<double>(share * hit.seen);
    if (hit.light != Rgb(0)) sums_.add({.direction = to / far, .value = share * hit.light});
  }
  sums_.finish();
  return {sums_.light, static_cast<float>(seen)};
}

void RadianceNearby::at_place(RadianceRecord& record) {
  sums_.start(SlopesBy::terms, Falloff::solid);
  for (const Hit& hit : hits_)
    if (hit.light != Rgb(0)) sums_.add({hit.direction, hit.light, hit.inverse_m * hit.light, hit.normal});
  sums_.finish();
  record.light.assign(sums_.light.begin(), sums_.light.end());
  record.gradient_x.assign(sums_.slope[0].begin(), sums_.slope[0].end());
  record.gradient_y.assign(sums_.slope[1].begin(), sums_.slope[1].end());
}

FittedAxes fit_axes(const Hemisphere& h, const RadianceRecord& record, bool with_gradients, float least_m,
                    const FootprintBounds& bounds) {
  RadianceNearby nearby(h, record.order(), std::max(least_m, std::numeric_limits<float>::min()));
  RadianceRecord told;  // as it is read
  told.stderr_light = record.stderr_light, told.footprint_m.emplace();
  nearby.at_place(told);
  const std::vector<double> here(told.light.begin(), told.light.end());
  if (with_gradients)
    settle_slopes(told, static_cast<double>(bounds.accuracy));
  else
    told.gradient_x.clear(), told.gradient_y.clear();
  const float steepness = steepness_per_m(told);
  const BandShares bands(record.order());
  const double least = kLeastLight * kLeastLight * bands.squares([&](std::size_t i) { return here[i]; });

  const auto known = [&](float seen) { return std::fabs(seen - 1) <= bounds.unseen; };
  /// Of the light at a step, relative.
  const auto error_at = [&](const Vec2& step, const std::vector<double>& light) {
    const Vec2 followed = steepness > 0 ? step_share(Vec3(step, 0), steepness) * step : Vec2(0);
    const double off = bands.squares([&](std::size_t i) {
      if (followed == Vec2(0)) return light[i] - here[i];
      return light[i] - here[i] -
             static_cast<double>(followed.x * told.gradient_x[i] + followed.y * told.gradient_y[i]);
    });
    const double there = bands.squares([&](std::size_t i) { return light[i]; });
    return off > 0 ? static_cast<float>(std::sqrt(off / std::max(there, least))) : 0;
  };

  const std::array<float, kAxes> around = radii_by_surroundings({&h, 1}, bounds);
  FittedAxes fitted;
  std::array<float, kAxes> radius_m;
  for (std::size_t k = 0; k < kAxes; ++k) {
    const Vec2 u = axis_of(k);
    float r = std::max(bounds.least_m, within_change_m(record, bands, u, around[k]));
    for (;;) {
      const Vec2 step = kWhere * bounds.accuracy * r * u;
      const RadianceNearby::Light light = nearby.at(step);
      const float error = error_at(step, light.coefficients);
      const bool good = known(light.seen) && error <= bounds.rho;
      if (good || !(r > bounds.least_m)) {
        fitted.unresolved += !good;
        break;
      }
      const float shorter = known(light.seen)
                                ? std::clamp(kMargin * std::sqrt(bounds.rho / error), kLeastStep, kMostStep)
                                : kShorter;
      r = std::max(bounds.least_m, shorter * r);
    }
    radius_m[k] = r;
  }
  limit_slopes(radius_m);
  for (std::size_t k = 0; k < kAxes; ++k) {
    fitted.length_m[k] = bounds.accuracy * radius_m[k];
    fitted.radius_m = std::max(fitted.radius_m, radius_m[k]);
  }
  return fitted;
}

}  // namespace phos::inline estimate
