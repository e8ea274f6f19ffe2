#include "estimate/radiance_record.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/origin.h"
#include "core/sampling.h"
#include "estimate/harmonics/light_sums.h"
#include "estimate/hemisphere/ray_gradients.h"
#include "estimate/radiance_error.h"
#include "estimate/record_of.h"
#include "hsh/rotation.h"

namespace phos::inline estimate {
namespace {

/// Least cosine of an emitter in a gradient, which it divides.
constexpr float kLeastCosine = 0.05f;

/// A ray, in the frame of the hemisphere.
DirectedLight light_along(const Hemisphere& h, std::size_t i, float least_m) {
  const Vec3 w = h.frame.to_local(h.direction[i]), n = h.frame.to_local(h.hit_normal[i]);
  const Rgb light = h.solid_sr(i) * h.radiance[i];
  const float cosine = std::max(kLeastCosine, -glm::dot(n, w));
  return {w, light, light / std::max(h.distance_m[i], least_m), Vec2(n) / cosine};
}

std::vector<float> narrowed(const std::vector<double>& v) { return {v.begin(), v.end()}; }

float harmonic_mean_m(const Hemisphere& h) {
  double weights = 0, nearness = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const auto weight = static_cast<double>(h.solid_sr(i));
    const auto distance_m = static_cast<double>(h.distance_m[i]);
    weights += weight, nearness += distance_m != 0 ? weight / distance_m : HUGE_VAL;
  }
  return nearness > 0 ? static_cast<float>(weights / nearness) : kInfinity;
}

}  // namespace

struct RadianceProjector::Impl {
  explicit Impl(int order) : sums(order), error(order) {}
  LightSums sums;
  RadianceError error;

  /// The edge between a near and a far surface moves with the near one. The analytic gradient moves it with
  /// the far one, and is short of the difference, as solid angle: length of the edge across the movement x
  /// difference of 1/r.
  void edge(const Hemisphere& seen, std::size_t before, std::size_t cell, float least_m, const Vec3& w,
            float length, const Vec2& across) {
    if (!one_hides_other(seen, before, cell, least_m)) return;
    const float a = 1 / std::max(seen.distance_m[before], least_m),
                b = 1 / std::max(seen.distance_m[cell], least_m);
    const Rgb far = a >= b ? seen.radiance[cell] : -seen.radiance[before];
    const Rgb shown = length * std::fabs(a - b) * far;
    sums.add_edge(w, across.x * shown, across.y * shown);
  }

  /// Of the cells of a hemisphere stratified by solid angle.
  void occlusion(const Hemisphere& seen, float least_m) {
    const auto slice_count = static_cast<float>(seen.slices);
    const auto cosine = [&](float ring) { return 1 - ring / static_cast<float>(seen.rings); };
    const auto sine = [&](float c) { return std::sqrt(std::max(0.f, (1 - c) * (1 + c))); };
    for (int j = 0; j < seen.rings; ++j) {
      const auto ring = static_cast<float>(j);
      const float upper = cosine(ring), middle = cosine(ring + 0.5f), lower = cosine(ring + 1);
      // Of the arc from the upper to the lower edge.
      const float arc = std::atan2(sine(lower), lower) - std::atan2(sine(upper), upper);
      for (int k = 0; k < seen.slices; ++k) {
        const Vec2 centre = cos_sin((static_cast<float>(k) + 0.5f) / slice_count),
                   side = cos_sin(static_cast<float>(k) / slice_count);
        if (j > 0) {
          edge(seen, seen.at(j - 1, k), seen.at(j, k), least_m, Vec3(sine(upper) * centre, upper),
               2 * kPi / slice_count * sine(upper) * upper, centre);
        }
        edge(seen, seen.at(j, k - 1), seen.at(j, k), least_m, Vec3(sine(middle) * side, middle), arc,
             {-side.y, side.x});
      }
    }
  }
};

RadianceProjector::RadianceProjector(int order) {
  impl_ = std::make_unique<Impl>(require_radiance_order(order));
}
RadianceProjector::~RadianceProjector() = default;

SlopesBy slopes_by(RadianceGradient gradient) {
  return gradient == RadianceGradient::none      ? SlopesBy::none
         : gradient == RadianceGradient::numeric ? SlopesBy::differences
                                                 : SlopesBy::terms;
}

RadianceRecord RadianceProjector::project(const Hemisphere& h, RadianceGradient mode, float least_m,
                                          std::span<const RayBorder> borders) {
  least_m = std::max(least_m, std::numeric_limits<float>::min());
  LightSums& sums = impl_->sums;
  sums.start(slopes_by(mode), Falloff::solid);
  for (std::size_t i = 0; i < h.size(); ++i)
    if (h.radiance[i] != Rgb(0)) sums.add(light_along(h, i, least_m));
  if (mode == RadianceGradient::hybrid && h.stratified() && h.measure == Measure::solid)
    impl_->occlusion(h, least_m);
  if (mode == RadianceGradient::hybrid)
    for (const RayBorder& b : borders) impl_->edge(h, b.before, b.after, least_m, b.direction, 1, b.across);
  sums.finish();
  RadianceRecord record;
  record.frame = h.frame;
  record.distance_m = harmonic_mean_m(h);
  record.light = narrowed(sums.light);
  if (mode != RadianceGradient::none)
    record.gradient_x = narrowed(sums.slope[0]), record.gradient_y = narrowed(sums.slope[1]);
  record.stderr_light = impl_->error.of(h);
  record.shared = shared_part(h, irradiance_of(record).stderr_lx);
  return record;
}

float shared_part(const Hemisphere& h, const Rgb& stderr_lx) {
  const double all = static_cast<double>(luminance(stderr_lx)),
               shared = static_cast<double>(luminance(Rgb(glm::sqrt(h.source.total()))));
  return all > 0 ? static_cast<float>(std::min(1.0, shared * shared / (all * all))) : 0;
}

void require_finite(const DVec3& origin_m, const RadianceRecord& r) {
  if (is_finite(r)) return;
  throw Error(ExitCode::numerical, "",
              "radiance at " + place_text(origin_m, r.position) +
                  " exceeds the range of numbers; give the lights or the scene other units");
}

float within_gradient_m(const RadianceRecord& record, float radius_m) {
  // Norms over the coefficients, by colour.
  const auto norm = [](const std::vector<float>& v) {
    DVec3 squares(0);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto x = static_cast<double>(v[i]);
      squares[static_cast<int>(i % 3)] += x * x;
    }
    return glm::sqrt(squares);
  };
  const DVec3 light = norm(record.light), x = norm(record.gradient_x), y = norm(record.gradient_y);
  const Vec3 slope[3] = {Vec3(x[0], y[0], 0), Vec3(x[1], y[1], 0), Vec3(x[2], y[2], 0)};
  return within_gradient_m(Rgb(light), slope, radius_m);
}

float reach_m(const RadianceRecord& record, const Hemisphere& h, const RecordOptions& resolved) {
  const float around_m = resolved.radius == RadiusRule::least ? least_distance_m(h) : record.distance_m;
  const float most_m = std::min(around_m, static_cast<float>(*resolved.max_radius_m));
  return std::max(within_gradient_m(record, most_m), std::numeric_limits<float>::min());
}

}  // namespace phos::inline estimate
