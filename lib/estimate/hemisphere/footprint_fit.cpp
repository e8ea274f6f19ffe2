#include "estimate/hemisphere/footprint_fit.h"

#include <algorithm>
#include <cmath>

#include "estimate/hemisphere/ray_gradients.h"
#include "record/weight.h"

namespace phos::inline estimate {
namespace {

constexpr int kAxes = AdaptiveFootprint::kAxes;
constexpr float kOverhead = 0.8660254f;      // cosine: nearer to the normal than 30 degrees has no direction
constexpr float kLeastLight = 1e-3f;         // of the light at the record: less is none (docs/methods.md#e6)
constexpr float kLeastNearness2 = 1.f / 16;  // squared: how near equivalent lights come, of their distance
constexpr float kLeastEmitterCosine = 0.1f;  // docs/methods.md#b4
constexpr float kLeastCosine = 0.05f;        // docs/methods.md#d2: grazing rays
constexpr float kSlope = 2;                  // docs/methods.md#e7
constexpr float kShorter = 0.75f;
constexpr std::size_t kLanes = 8;
constexpr float kLightsEnough = 256;  // equivalent lights that tell how light changes about a place
// Hits of neighbouring rays make one light where their normals and distances differ by no more than that.
constexpr float kAlikeNormal = 0.95f, kAlike = 1.25f;

Vec2 axis_of(int k) { return AdaptiveFootprint::direction(k); }

int nearest_axis(const Vec2& v) {
  constexpr float kTangent = 0.41421356f;  // of 22.5 degrees
  const float x = std::fabs(v.x), y = std::fabs(v.y);
  if (y <= kTangent * x) return v.x >= 0 ? 0 : 4;
  if (x <= kTangent * y) return v.y >= 0 ? 2 : 6;
  return v.x >= 0 ? (v.y >= 0 ? 1 : 7) : (v.y >= 0 ? 3 : 5);
}

/// What a record with this parabola says of its axis.
Rgb told(const Rgb& at_place, const Rgb& slope, const Rgb& bend, float s) {
  return glm::max(at_place + slope * s + bend * (0.5f * s * s), Rgb(0));
}

}  // namespace

void limit_slopes(AdaptiveFootprint::Lengths& lengths_m) {
  for (int round = 0; round < kAxes; ++round)
    for (std::size_t k = 0; k < lengths_m.size(); ++k)
      lengths_m[k] = std::min(
          lengths_m[k], kSlope * std::min(lengths_m[(k + 1) % kAxes], lengths_m[(k + kAxes - 1) % kAxes]));
}

AxisFit fit_axis(const Rgb& at_place, const std::function<Rgb(float)>& light, float length_m, float least_m,
                 float rho) {
  AxisFit fit;
  fit.length_m = std::max(length_m, least_m);
  Rgb quarter = light(fit.length_m * 0.25f), half = light(fit.length_m * 0.5f),
      most = light(fit.length_m * 0.75f), all = light(fit.length_m);
  fit.evaluations = 5;
  const float floor = kLeastLight * max_component(at_place);
  const auto good = [&](const Rgb& truth, float s) {
    const Rgb off = glm::abs(told(at_place, fit.slope, fit.bend, s) - truth);
    return max_component(off) <= rho * std::max(max_component(truth), floor);
  };
  for (;;) {
    fit.slope = 4.f * half - all - 3.f * at_place;
    fit.bend = 4.f * (all - 2.f * half + at_place);
    fit.resolved = good(quarter, 0.25f) && good(most, 0.75f);
    if (fit.resolved || !(fit.length_m * 0.5f >= least_m)) return fit;
    fit.length_m *= 0.5f;
    all = half, half = quarter;
    quarter = light(fit.length_m * 0.25f), most = light(fit.length_m * 0.75f);
    fit.evaluations += 2;
  }
}

/// Neighbouring rays with hits alike, as one: sums, and means weighted by the share that they take.
struct LightNearby::Bundle {
  float distance_m;  // of the first
  Vec3 normal;       // of the first
  Rgb light{0};
  float seen = 0;
  Vec2 towards{0}, facing{0};
  float inverse_d2 = 0;

  bool takes(float d, const Vec3& n) const {
    if (!std::isfinite(d) || !std::isfinite(distance_m)) return d == distance_m;
    return glm::dot(n, normal) > kAlikeNormal && std::max(d, distance_m) <= kAlike * std::min(d, distance_m);
  }
};

LightNearby::LightNearby(std::span<const Hemisphere> passes, GradientMode mode, float least_m)
    : frame_(passes.front().frame) {
  double rays = 0;
  for (const Hemisphere& h : passes) rays += static_cast<double>(h.size());
  for (const Hemisphere& h : passes) {
    const auto weight = static_cast<float>(static_cast<double>(h.size()) / rays);
    add(h, weight, least_m);
    if (mode != GradientMode::hybrid) continue;
    const OcclusionGradient edges = occlusion_gradient(h, least_m);
    for (int c = 0; c < 3; ++c) {
      occlusion_[0][c] += weight * glm::dot(edges.light[c], frame_.x);
      occlusion_[1][c] += weight * glm::dot(edges.light[c], frame_.y);
    }
    occlusion_seen_[0] += weight * glm::dot(edges.even, frame_.x);
    occlusion_seen_[1] += weight * glm::dot(edges.even, frame_.y);
  }
  share_.resize(red_.size());
}

void LightNearby::add(const Hemisphere& h, float weight, float least_m) {
  const bool cells = h.stratified();
  const int rings = cells ? h.rings : 1, slices = cells ? h.slices : static_cast<int>(h.size());
  const auto merged = std::lround(std::sqrt(static_cast<float>(h.size()) / kLightsEnough));
  const int side = cells ? std::max(1, static_cast<int>(merged)) : 1;
  std::vector<Bundle> bundles;
  for (int ring = 0; ring < rings; ring += side)
    for (int slice = 0; slice < slices; slice += side) {
      bundles.clear();
      for (int j = ring; j < std::min(ring + side, rings); ++j)
        for (int k = slice; k < std::min(slice + side, slices); ++k)
          add_ray(h, static_cast<std::size_t>(j * slices + k), weight, least_m, bundles);
      for (const Bundle& bundle : bundles) keep(bundle);
    }
}

void LightNearby::add_ray(const Hemisphere& h, std::size_t i, float weight, float least_m,
                          std::vector<Bundle>& bundles) {
  const Vec3 w = frame_.to_local(h.direction[i]), n = frame_.to_local(h.hit_normal[i]);
  const float d = std::max(h.distance_m[i], least_m);
  auto bundle = std::find_if(bundles.begin(), bundles.end(), [&](const Bundle& b) { return b.takes(d, n); });
  if (bundle == bundles.end()) bundle = bundles.insert(bundle, Bundle{.distance_m = d, .normal = n});
  const float seen = weight * h.projected_sr[i] * (1 / kPi);
  const Rgb light = weight * h.projected_sr[i] * h.radiance[i];
  direction_.push_back(w), light_.push_back(light);
  bundle->light += light;
  bundle->seen += seen;
  if (!std::isfinite(d)) return;
  const float cosine = -glm::dot(n, w);
  const bool grazing = cosine < kLeastEmitterCosine;
  bundle->towards += 2 * seen / d * Vec2(w);
  bundle->facing += grazing ? -seen / d * Vec2(w) : seen / (cosine * d) * Vec2(n);
  bundle->inverse_d2 += seen / d / d;
}

void LightNearby::keep(const Bundle& b) {
  if (!(b.seen > 0)) return;
  if (!std::isfinite(b.distance_m)) {
    constant_ += b.light, constant_seen_ += b.seen;
    return;
  }
  red_.push_back(b.light.x), green_.push_back(b.light.y), blue_.push_back(b.light.z), seen_.push_back(b.seen);
  towards_x_.push_back(b.towards.x / b.seen), towards_y_.push_back(b.towards.y / b.seen);
  facing_x_.push_back(b.facing.x / b.seen), facing_y_.push_back(b.facing.y / b.seen);
  inverse_d2_.push_back(b.inverse_d2 / b.seen);
}

LightNearby::Light LightNearby::at(const Vec2& step, float of_occlusion) const {
  const std::size_t n = red_.size();
  const float x = step.x, y = step.y, s2 = glm::dot(step, step);
  for (std::size_t i = 0; i < n; ++i) {
    const float near2 = 1 - (towards_x_[i] * x + towards_y_[i] * y) + s2 * inverse_d2_[i];
    const float bounded = near2 > kLeastNearness2 ? near2 : kLeastNearness2;
    const float facing = 1 + facing_x_[i] * x + facing_y_[i] * y;
    share_[i] = (facing > 0 ? facing : 0) / (bounded * bounded);
  }
  float sum[4][kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      sum[0][lane] += share_[i + lane] * red_[i + lane];
      sum[1][lane] += share_[i + lane] * green_[i + lane];
      sum[2][lane] += share_[i + lane] * blue_[i + lane];
      sum[3][lane] += share_[i + lane] * seen_[i + lane];
    }
  for (; i < n; ++i) {
    sum[0][0] += share_[i] * red_[i], sum[1][0] += share_[i] * green_[i];
    sum[2][0] += share_[i] * blue_[i], sum[3][0] += share_[i] * seen_[i];
  }
  const Vec2 known = of_occlusion * step;
  Light light{constant_ + known.x * occlusion_[0] + known.y * occlusion_[1],
              constant_seen_ + known.x * occlusion_seen_[0] + known.y * occlusion_seen_[1]};
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    light.irradiance += Rgb(sum[0][lane], sum[1][lane], sum[2][lane]), light.seen += sum[3][lane];
  if (light.seen > 0) light.irradiance /= light.seen;
  return light;
}

Rgb LightNearby::bend_by_turn(const Vec2& axis, float sine, std::span<const LampSample> lamps) const {
  const float less = std::sqrt(1 - sine * sine) - 1;
  Rgb sum(0);
  const auto add = [&](const Vec3& w, const Rgb& light) {
    const float below = -((1 + less) * w.z + sine * glm::dot(Vec2(w), axis));
    sum += (less + std::max(below, 0.f) / std::max(w.z, kLeastCosine)) * light;
  };
  for (std::size_t i = 0; i < light_.size(); ++i) add(direction_[i], light_[i]);
  for (const LampSample& lamp : lamps) add(frame_.to_local(lamp.direction), lamp.irradiance);
  return sum;
}

std::array<float, kAxes> radii_by_surroundings(std::span<const Hemisphere> passes,
                                               const FootprintBounds& bounds) {
  std::array<float, kAxes> nearest, radius;
  nearest.fill(kInfinity);
  const Frame& frame = passes.front().frame;
  for (const Hemisphere& h : passes)
    for (std::size_t i = 0; i < h.size(); ++i) {
      const Vec3 w = frame.to_local(h.direction[i]);
      if (w.z >= kOverhead) continue;
      float& d = nearest[static_cast<std::size_t>(nearest_axis(Vec2(w)))];
      d = std::min(d, h.distance_m[i]);
    }
  for (std::size_t k = 0; k < kAxes; ++k) {
    radius[k] = nearest[k];
    if (std::isfinite(nearest[k])) continue;
    const float before = nearest[(k + kAxes - 1) % kAxes], after = nearest[(k + 1) % kAxes];
    radius[k] = 0.5f * std::min(before, bounds.most_m) + 0.5f * std::min(after, bounds.most_m);
  }
  for (float& r : radius) r = std::clamp(r, bounds.least_m, bounds.most_m);
  limit_slopes(radius);
  return radius;
}

FittedFootprint fit_footprint(std::span<const Hemisphere> passes, const LightNearby& nearby,
                              const std::function<Rgb(const Vec2&)>& direct,
                              std::span<const LampSample> lamps, const Vec3 (&rotation)[3],
                              const FootprintBounds& bounds) {
  const Frame& frame = nearby.frame();
  const Rgb around_here = glm::max(nearby.at(Vec2(0)).irradiance, Rgb(0));
  const auto known = [&](const LightNearby::Light& light) {
    return std::fabs(light.seen - 1) <= bounds.unseen;
  };
  const auto light_at = [&](const Vec2& step, float of_occlusion) {
    const LightNearby::Light around = nearby.at(step, of_occlusion);
    Rgb light = known(around) ? glm::max(around.irradiance, Rgb(0)) : around_here;
    if (direct) light += direct(step);
    return light;
  };
  const Rgb here = light_at(Vec2(0), 1);
  const std::array<float, kAxes> around = radii_by_surroundings(passes, bounds);
  FittedFootprint fitted;
  std::array<float, kAxes> length;
  AdaptiveFootprint::Axes axes;
  for (int k = 0; k < kAxes; ++k) {
    const Vec2 u = axis_of(k);
    // Longer than this its neighbours would not let it be (docs/methods.md#e7).
    float radius = around[static_cast<std::size_t>(k)];
    if (k > 0) radius = std::min(radius, kSlope * length[static_cast<std::size_t>(k - 1)] / bounds.accuracy);
    if (k == kAxes - 1) radius = std::min(radius, kSlope * length[0] / bounds.accuracy);
    // docs/methods.md#a7: occlusion is known to first order only.
    const float change = max_component(glm::abs(u.x * nearby.occlusion(0) + u.y * nearby.occlusion(1)));
    float of_occlusion = 1;
    if (change * radius > max_component(here)) {
      radius = std::max(bounds.least_m, max_component(here) / change);
      of_occlusion = std::min(1.f, max_component(here) / (change * radius));
    }
    while (!known(nearby.at(bounds.accuracy * radius * u, of_occlusion)) &&
           radius * kShorter >= bounds.least_m)
      radius *= kShorter;
    const AxisFit fit = fit_axis(
        here, [&](float d) { return light_at(d * u, of_occlusion); }, bounds.accuracy * radius,
        bounds.accuracy * bounds.least_m, bounds.rho);
    fitted.unresolved += !fit.resolved;
    length[static_cast<std::size_t>(k)] = fit.length_m;
    AdaptiveFootprint::Axis& axis = axes[static_cast<std::size_t>(k)];
    axis = {fit.length_m, fit.slope, fit.bend};
    const Vec3 around_which = glm::cross(frame.z, u.x * frame.x + u.y * frame.y);
    for (int c = 0; c < 3; ++c) axis.turn_slope[c] = glm::dot(around_which, rotation[c]);
    constexpr float kSine = kMostTurnSine;
    axis.turn_bend = 2 / (kSine * kSine) * nearby.bend_by_turn(u, kSine, lamps);
  }
  limit_slopes(length);
  for (std::size_t k = 0; k < kAxes; ++k) {
    const float shorter = length[k] / axes[k].length_m;
    axes[k].length_m = length[k], axes[k].slope *= shorter, axes[k].bend *= shorter * shorter;
  }
  fitted.footprint = std::make_shared<AdaptiveFootprint>(frame.x, frame.z, axes);
  fitted.radius_m = fitted.footprint->longest_m() / bounds.accuracy;
  return fitted;
}

}  // namespace phos::inline estimate
