// Lengths of the axes of radiance records, against rooms whose light is known from every place.
#include "estimate/hemisphere/radiance_axes.h"

#include <gtest/gtest.h>

#include "support/radiance_scenes.h"

namespace phos {
namespace {

constexpr int kOrder = 8;
constexpr std::size_t kAxes = AdaptiveFootprint::kAxes;

/// A room about a place on its floor, z up; its walls and its ceiling shine.
struct Room {
  DVec3 lo, hi;  ///< hi.z: height; lo.z is 0
  std::function<double(const DVec3&)> luminance;

  test::RadianceScene scene() const {
    return {"room", [*this](const DVec3& p, const DVec3& w) {
              test::Seen seen;
              for (int axis = 0; axis < 3; ++axis) {
                if (w[axis] == 0) continue;
                const double t = ((w[axis] > 0 ? hi : lo)[axis] - p[axis]) / w[axis];
                if (!(t < seen.distance)) continue;
                seen.distance = t, seen.normal = DVec3(0);
                seen.normal[axis] = w[axis] > 0 ? -1 : 1;
              }
              seen.luminance = luminance(p + seen.distance * w);
              return seen;
            }};
  }
  /// What a stratified hemisphere of rays shows at the origin, one in the middle of each cell.
  Hemisphere seen(int rings) const {
    const test::RadianceScene all = scene();
    Hemisphere h;
    h.rings = rings, h.slices = slices_for(rings), h.measure = Measure::solid;
    h.resize(static_cast<std::size_t>(h.rings * h.slices));
    for (int j = 0; j < rings; ++j)
      for (int k = 0; k < h.slices; ++k) {
        const double z = 1 - (j + 0.5) / rings, across = std::sqrt(1 - z * z),
                     phi = 2 * std::numbers::pi * (k + 0.5) / h.slices;
        const DVec3 w(across * std::cos(phi), across * std::sin(phi), z);
        const test::Seen s = all.look(DVec3(0), w);
        const std::size_t i = h.at(j, k);
        h.direction[i] = Vec3(w), h.hit_normal[i] = Vec3(s.normal);
        h.distance_m[i] = static_cast<float>(s.distance),
        h.radiance[i] = Rgb(static_cast<float>(s.luminance));
        h.projected_sr[i] = h.solid_sr(i) * static_cast<float>(z);
      }
    return h;
  }
};

FootprintBounds bounds_to(float most_m, float rho) {
  return {.least_m = 0.02f, .most_m = most_m, .accuracy = 0.6f, .rho = rho};
}

FittedAxes fitted(const Hemisphere& h, const FootprintBounds& bounds) {
  RadianceProjector projector(kOrder);
  return fit_axes(h, projector.project(h, RadianceGradient::hybrid, 0.02f), true, 0.02f, bounds);
}

std::vector<double> green(const std::vector<double>& rgb) {
  std::vector<double> out;
  for (std::size_t i = 1; i < rgb.size(); i += 3) out.push_back(rgb[i]);
  return out;
}

/// Light goes slowly over walls and ceiling.
double waves(const DVec3& q) { return 2 + std::sin(1.1 * q.x) + 0.7 * std::cos(1.3 * q.y) + 0.3 * q.z; }
const Room kHall{{-0.8, -2, 0}, {2.2, 2, 2.4}, waves};

/// The light of the hits, moved, is the light that shines there.
TEST(RadianceAxes, LightNearbyIsWhatAMovedHemisphereSees) {
  const Quadrature fine = hemisphere_quadrature(80, 160);
  RadianceNearby nearby(kHall.seen(64), kOrder, 0.02f);
  const std::vector<double> truth_here = kHall.scene().coefficients(DVec3(0), kOrder, fine);
  const std::vector<double> here = green(nearby.at(Vec2(0)).coefficients);
  EXPECT_LT(test::distance(here, truth_here), 0.05 * test::norm(truth_here)) << "light of bundles of rays";
  for (const Vec2& step : {Vec2(0.2f, 0), Vec2(-0.2f, 0.1f), Vec2(0, 0.3f)}) {
    const RadianceNearby::Light light = nearby.at(step);
    std::vector<double> change = green(light.coefficients),
                        truth = kHall.scene().coefficients(DVec3(step.x, step.y, 0), kOrder, fine);
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= here[i], truth[i] -= truth_here[i];
    EXPECT_NEAR(light.seen, 1, 0.02) << step.x << ' ' << step.y;
    EXPECT_LT(test::distance(change, truth), 0.035 * test::norm(truth_here)) << step.x << ' ' << step.y;
    EXPECT_GT(test::norm(truth), 0.04 * test::norm(truth_here)) << "there is a change to find";
  }
}

/// Nothing changes where all shines alike: surroundings alone set the lengths.
TEST(RadianceAxes, AreAsLongAsSurroundingsAllowInEvenLight) {
  const Room even{{-0.8, -2, 0}, {2.2, 2, 2.4}, [](const DVec3&) { return 3.0; }};
  const Hemisphere h = even.seen(40);
  const FootprintBounds bounds = bounds_to(5, 0.1f);
  const FittedAxes axes = fitted(h, bounds);
  const auto around = radii_by_surroundings({&h, 1}, bounds);
  EXPECT_EQ(axes.unresolved, 0);
  for (std::size_t k = 0; k < kAxes; ++k)
    EXPECT_NEAR(axes.length_m[k], bounds.accuracy * around[k], 1e-5) << k;
  EXPECT_NEAR(axes.length_m[4], 0.6 * 0.8, 0.02) << "towards the near wall";
  EXPECT_FLOAT_EQ(axes.radius_m, *std::max_element(around.begin(), around.end()));
  // Bounds are met too.
  const FittedAxes small = fitted(h, bounds_to(0.5f, 0.1f));
  for (const float length_m : small.length_m) EXPECT_FLOAT_EQ(length_m, 0.6f * 0.5f);
}

/// Beside a wall that is bright at its foot, light changes along the way to it, and not along it.
TEST(RadianceAxes, AreShortWhereLightChanges) {
  const Room beside{{-0.6, -20, 0}, {20, 20, 20}, [](const DVec3& q) {
                      return q.x < -0.599 ? 20 * std::exp(-2 * q.z) : 0.1;
                    }};
  const FittedAxes axes = fitted(beside.seen(48), bounds_to(4, 0.2f));
  for (const std::size_t along : {2u, 6u}) {
    EXPECT_GT(axes.length_m[along], 1.3f * axes.length_m[4]) << along;
    EXPECT_GT(axes.length_m[along], 1.1f * axes.length_m[0]) << along;
  }
  EXPECT_NEAR(axes.length_m[2], axes.length_m[6], 0.05f * axes.length_m[2]);
}

/// One colour, in which bands count as the energy of a lobe of this order does.
std::vector<double> by_lobe(std::vector<double> v) {
  for (int l = 0, i = 0; l < kOrder; ++l)
    for (int m = -l; m <= l; ++m, ++i)
      v[static_cast<std::size_t>(i)] *= std::pow(10.0, -static_cast<double>(l * l) / (kOrder * kOrder));
  return v;
}

/// At three quarters of each axis, a reader that follows the record is off by about rho, and no more.
TEST(RadianceAxes, MeetTheErrorThatIsAskedFor) {
  const Quadrature fine = hemisphere_quadrature(60, 120);
  const Hemisphere h = kHall.seen(64);
  RadianceProjector projector(kOrder);
  RadianceRecord record = projector.project(h, RadianceGradient::hybrid, 0.02f);
  double longest[2] = {};
  for (const bool more : {false, true}) {
    const FootprintBounds bounds = bounds_to(5, more ? 0.1f : 0.04f);
    const FittedAxes axes = fit_axes(h, record, true, 0.02f, bounds);
    EXPECT_EQ(axes.unresolved, 0);
    RadianceRecord read = record;
    read.footprint_m = axes.length_m, read.radius_m = axes.radius_m;
    settle_slopes(read, static_cast<double>(bounds.accuracy));
    const float steepness = steepness_per_m(read);
    for (std::size_t k = 0; k < kAxes; ++k) {
      const Vec2 step = 0.75f * axes.length_m[k] * AdaptiveFootprint::direction(static_cast<int>(k));
      const float share = step_share(Vec3(step, 0), steepness);
      std::vector<double> told;
      for (std::size_t i = 1; i < read.light.size(); i += 3)
        told.push_back(static_cast<double>(
            read.light[i] + share * (step.x * read.gradient_x[i] + step.y * read.gradient_y[i])));
      const std::vector<double> truth = kHall.scene().coefficients(DVec3(step.x, step.y, 0), kOrder, fine);
      EXPECT_LT(test::distance(by_lobe(told), by_lobe(truth)),
                (static_cast<double>(bounds.rho) + 0.02) * test::norm(by_lobe(truth)))
          << k;
      longest[more] += static_cast<double>(axes.length_m[k]);
    }
  }
  EXPECT_GT(longest[1], 1.2 * longest[0]) << "where more error is allowed, axes are longer";
}

/// Axes that follow the light of a scene of another size are as many times as long.
TEST(RadianceAxes, ScaleWithTheScene) {
  const Hemisphere h = kHall.seen(32);
  const FittedAxes axes = fitted(h, bounds_to(5, 0.1f));
  for (const float scale : {1e-4f, 1e4f}) {
    Hemisphere other = h;
    for (float& d : other.distance_m) d *= scale;
    RadianceProjector projector(kOrder);
    FootprintBounds bounds = bounds_to(5 * scale, 0.1f);
    bounds.least_m *= scale;
    const FittedAxes scaled =
        fit_axes(other, projector.project(other, RadianceGradient::hybrid, 0.02f * scale), true,
                 0.02f * scale, bounds);
    for (std::size_t k = 0; k < kAxes; ++k)
      EXPECT_NEAR(scaled.length_m[k] / scale, axes.length_m[k], 1e-3 * axes.length_m[k]) << scale << ' ' << k;
  }
}

/// No light is known as well everywhere.
TEST(RadianceAxes, InTheDark) {
  const Room dark{{-0.8, -2, 0}, {2.2, 2, 2.4}, [](const DVec3&) { return 0.0; }};
  const Hemisphere h = dark.seen(20);
  const FittedAxes axes = fitted(h, bounds_to(5, 0.1f));
  EXPECT_EQ(axes.unresolved, 0);
  EXPECT_TRUE(are_lengths(axes.length_m));
  EXPECT_GT(axes.radius_m, 1);
}

/// The irradiance that a radiance record holds, along its axes and between: its zone, and its gradient.
TEST(RadianceAxes, OfItsIrradianceAreTheSame) {
  const Hemisphere h = kHall.seen(32);
  RadianceProjector projector(kOrder);
  RadianceRecord record = projector.project(h, RadianceGradient::hybrid, 0.02f);
  const FittedAxes axes = fitted(h, bounds_to(5, 0.1f));
  record.footprint_m = axes.length_m, record.radius_m = axes.radius_m;
  const IrradianceRecord e = irradiance_of(record);
  ASSERT_TRUE(e.footprint);
  EXPECT_EQ(what_is_wrong(*e.footprint, e.normal), nullptr);
  for (std::size_t k = 0; k < kAxes; ++k) {
    const Vec2 u = AdaptiveFootprint::direction(static_cast<int>(k));
    const Vec3 to = u.x * record.frame.x + u.y * record.frame.y;
    EXPECT_NEAR(record_error(e, axes.length_m[k] * to, e.normal), 0.6, 1e-4) << k;
    const Vec3 step = 0.3f * axes.length_m[k] * to;
    const float linear = e.irradiance.y + glm::dot(step, e.translation_gradient[1]);
    EXPECT_NEAR(extrapolate(e, step, e.normal).y, linear, 1e-4 * e.irradiance.y) << k;
  }
}

}  // namespace
}  // namespace phos
