// Adaptive footprints: their shape and weights, what they say of light nearby, and how they are fitted.
#include "record/footprint.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "estimate/hemisphere/footprint_fit.h"
#include "estimate/record_options.h"
#include "record/footprint_columns.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "support/environment.h"
#include "support/gathered.h"
#include "support/golden_table.h"
#include "support/gradient_scenes.h"
#include "support/run.h"

namespace phos {
namespace {

using test::GradientScene;
constexpr int kAxes = AdaptiveFootprint::kAxes;
constexpr Vec3 kX(1, 0, 0), kUp(0, 0, 1);

Vec3 at_angle(double degrees, double length = 1) {
  const double a = degrees * std::numbers::pi / 180;
  return Vec3(DVec3(length * std::cos(a), length * std::sin(a), 0));
}

/// Lengths all different, none more than twice its neighbours.
AdaptiveFootprint::Axes some_axes() {
  AdaptiveFootprint::Axes axes;
  const float length[kAxes] = {0.4f, 0.25f, 0.5f, 0.8f, 0.6f, 0.3f, 0.2f, 0.375f};
  for (int k = 0; k < kAxes; ++k) {
    const auto x = static_cast<float>(k);
    axes[static_cast<std::size_t>(k)] = {length[k], Rgb(1 + x, -x, 2), Rgb(0.5f * x, 1, -1), Rgb(x, 1, 2 - x),
                                         Rgb(-1, x, 0)};
  }
  return axes;
}

TEST(Footprint, BorderIsThatOfThePseudoEllipse) {
  const AdaptiveFootprint::Axes axes = some_axes();
  const AdaptiveFootprint f(kX, kUp, axes);
  EXPECT_EQ(f.longest_m(), 0.8f);
  EXPECT_EQ(f.shortest_m(), 0.2f);
  for (int k = 0; k < kAxes; ++k) {
    const double d1 = static_cast<double>(axes[static_cast<std::size_t>(k)].length_m),
                 d2 = static_cast<double>(axes[static_cast<std::size_t>((k + 1) % kAxes)].length_m);
    for (const double psi : {0.0, 5.0, 22.5, 40.0, 45.0}) {
      // (10), t from the chord between the ends of the axes.
      const double a = psi * std::numbers::pi / 180, b = std::numbers::pi / 4 - a;
      const double t = d1 * std::sin(a) / (d1 * std::sin(a) + d2 * std::sin(b));
      const double border = (1 - t) * d1 + t * d2;
      // With a radius of 2 m for the longest axis, the error at the border is 0.8 / 2.
      EXPECT_NEAR(f.error(at_angle(45 * k + psi, border), kUp, kUp, 2), 0.4, 2e-6) << k << ' ' << psi;
    }
  }
}

/// The same footprint by other axes: exact everywhere by axes that lie along its own, along the new axes by
/// any.
TEST(Footprint, IsTheSameByAxesThatStartElsewhere) {
  const AdaptiveFootprint f(kX, kUp, some_axes());
  for (const double start : {45.0, 180.0, 20.0}) {
    const AdaptiveFootprint other = f.with_axes_from(at_angle(start), kUp);
    const bool along_own = start != 20;
    for (int k = 0; k < kAxes; ++k)
      for (const double psi : {0.0, 15.0}) {
        if (psi > 0 && !along_own) continue;
        for (const double length : {0.05, 0.2, 0.9}) {
          const Vec3 p = at_angle(start + 45 * k + psi, length),
                     n = glm::normalize(at_angle(start + 45 * k + psi, 0.3) + kUp);
          EXPECT_NEAR(other.error(p, kUp, kUp, 2.5f * other.longest_m()),
                      f.error(p, kUp, kUp, 2.5f * f.longest_m()), 1e-5 * (1 + length));
          EXPECT_LT(glm::length(other.change(p, n) - f.change(p, n)), 1e-4) << start << ' ' << k;
        }
      }
  }
  EXPECT_EQ(f.with_axes_from(kX, kUp).axes()[3].bend, f.axes()[3].bend);
}

TEST(Footprint, AxisOfAnotherLengthTellsTheSameLight) {
  const AdaptiveFootprint::Axis axis = some_axes()[3];
  const auto light = [](const AdaptiveFootprint::Axis& a, float distance_m) {
    const float s = std::min(distance_m / a.length_m, 1.f);
    return a.slope * s + a.bend * (0.5f * s * s);
  };
  const AdaptiveFootprint::Axis shorter = with_length(axis, 0.3f), longer = with_length(axis, 1.2f);
  for (const float d : {0.1f, 0.2f, 0.3f})
    EXPECT_LT(glm::length(light(shorter, d) - light(axis, d)), 1e-5f) << d;
  // Beyond its end the light of the end stands: the parabola meets it halfway and at its own end.
  for (const float d : {0.6f, 1.2f}) EXPECT_LT(glm::length(light(longer, d) - light(axis, d)), 1e-5f) << d;
  EXPECT_EQ(longer.turn_slope, axis.turn_slope);
}

TEST(Footprint, IsContinuousAcrossAxesAndOverTheRecord) {
  const AdaptiveFootprint f(kX, kUp, some_axes());
  const Vec3 tilted = glm::normalize(Vec3(0.1f, -0.2f, 1));
  for (const double length : {0.01, 0.15, 0.9}) {
    for (int k = 0; k < kAxes; ++k) {
      const Vec3 before = at_angle(45 * k - 1e-4, length), after = at_angle(45 * k + 1e-4, length);
      EXPECT_NEAR(f.error(before, kUp, kUp, 1), f.error(after, kUp, kUp, 1), 1e-4 * length);
      EXPECT_LT(glm::length(f.change(before, tilted) - f.change(after, tilted)), 1e-3);
      const Vec3 n1 = glm::normalize(before + Vec3(0, 0, 3)), n2 = glm::normalize(after + Vec3(0, 0, 3));
      EXPECT_LT(glm::length(f.change(Vec3(0), n1) - f.change(Vec3(0), n2)), 1e-4);
    }
  }
  const Vec3 above(0, 0, 0.05f);
  for (int i = 0; i < 16; ++i)
    EXPECT_NEAR(f.error(above + at_angle(22.5 * i, 1e-6), kUp, kUp, 1), f.error(above, kUp, kUp, 1), 1e-5);
  EXPECT_EQ(f.change(Vec3(0), kUp), Rgb(0));
  EXPECT_EQ(f.error(Vec3(0), kUp, kUp, 1), 0);
}

/// No more weight than a disc of the longest axis, no less than one of the shortest; 1 at the record.
TEST(Footprint, WeightsAreBounded) {
  IrradianceRecord shaped, disc;
  shaped.radius_m = disc.radius_m = 2;
  shaped.footprint = std::make_shared<AdaptiveFootprint>(kX, kUp, some_axes());
  IrradianceRecord small = disc;
  small.radius_m = least_radius_m(shaped);
  EXPECT_EQ(small.radius_m, 0.5f);
  EXPECT_EQ(record_weight(record_error(shaped, shaped.position, kUp), 0.4f), 1);
  RandomStream random(3, Stage::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(2 * random.uniform() - 1, 2 * random.uniform() - 1, 0.2f * random.uniform() - 0.1f);
    const Vec3 n = glm::normalize(Vec3(random.uniform() - 0.5f, random.uniform() - 0.5f, 1));
    const float w = weight_within(*shaped.footprint, shaped, 0.4f, p, n);
    EXPECT_LE(w, record_weight(record_error(disc, p, n), 0.4f) + 1e-6f);
    EXPECT_GE(w, record_weight(record_error(small, p, n), 0.4f) - 1e-6f);
    EXPECT_LE(w, 1);
  }
}

/// A linear field is met exactly however the lengths differ; a bowl on the axes, and between equal ones
/// nearly.
TEST(Footprint, ChangeIsExactForLinearLight) {
  AdaptiveFootprint::Axes axes = some_axes();
  const Vec2 g(3, -2);
  for (int k = 0; k < kAxes; ++k) {
    AdaptiveFootprint::Axis& a = axes[static_cast<std::size_t>(k)];
    const float along = glm::dot(g, AdaptiveFootprint::direction(k));
    a.slope = Rgb(along * a.length_m), a.bend = Rgb(0);
    a.turn_slope = Rgb(along), a.turn_bend = Rgb(0);
  }
  const AdaptiveFootprint linear(kX, kUp, axes);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = at_angle(3.6 * i, 0.19);
    EXPECT_NEAR(linear.change(p, kUp).x, glm::dot(g, Vec2(p)), 2e-6);
    const Vec3 n = glm::normalize(Vec3(Vec2(p), 1));
    EXPECT_NEAR(linear.change(Vec3(0), n).y, glm::dot(g, Vec2(n)), 2e-6);
  }
  for (AdaptiveFootprint::Axis& a : axes) a = {0.5f, Rgb(0), Rgb(2 * 0.25f)};  // r^2
  const AdaptiveFootprint bowl(kX, kUp, axes);
  for (int i = 0; i < 16; ++i) {
    const double shrunk = i % 2 == 0 ? 1 : std::pow(std::cos(std::numbers::pi / 8), -2);
    EXPECT_NEAR(bowl.change(at_angle(22.5 * i, 0.3), kUp).x, 0.09, 0.09 * (shrunk - 1) + 1e-6) << i;
  }
  // Beyond its end the light of the end stands.
  EXPECT_NEAR(bowl.change(at_angle(0, 5), kUp).x, 0.25, 1e-6);
}

/// Lengths in other units change nothing: powers of two bit for bit.
TEST(Footprint, HasNoLengthOfItsOwn) {
  const AdaptiveFootprint f(kX, kUp, some_axes());
  const Vec3 step(0.11f, -0.17f, 0.01f), n = glm::normalize(Vec3(0.1f, 0.1f, 1));
  for (const double scale : {0x1p-20, 0x1p20, 1e-6, 1e6}) {
    AdaptiveFootprint::Axes axes = some_axes();
    const auto s = static_cast<float>(scale);
    for (AdaptiveFootprint::Axis& a : axes) a.length_m *= s;
    const AdaptiveFootprint scaled(kX, kUp, axes);
    const bool exact = scale == 0x1p-20 || scale == 0x1p20;
    const float error = scaled.error(s * step, n, kUp, 2 * s), change = scaled.change(s * step, n).x;
    EXPECT_NEAR(error, f.error(step, n, kUp, 2), exact ? 0 : 1e-6) << scale;
    EXPECT_NEAR(change, f.change(step, n).x, exact ? 0 : 1e-5) << scale;
  }
}

/// The penumbra of the golden tables: a lamp of 0.8 m x 0.8 m at 2.5 m, half hidden by an edge at 1.2 m, and
/// a dim ceiling that nothing hides.
double penumbra_lx(double x) {
  static const GradientScene lamp{
      "", {{2, 2.5, {-0.4, -0.4}, {0.4, 0.4}, 100}, {2, 1.2, {-3, -3}, {0, 3}, 0}}, {}, true, {}};
  static const GradientScene ceiling{"", {{2, 2.9, {-4, -4}, {4, 4}, 0.5}}, {}, false, {}};
  return lamp.irradiance_lx({x, 0, 0}) + ceiling.irradiance_lx({x, 0, 0});
}

/// Largest relative error of a fit from x0 towards `sign`, at `steps` places from s = `least` to 1.
double worst_error(const AxisFit& fit, double x0, double sign, double least, int steps) {
  double worst = 0;
  for (int i = 0; i < steps; ++i) {
    const double s = least + (1 - least) * i / (steps - 1),
                 e = penumbra_lx(x0 + sign * s * static_cast<double>(fit.length_m));
    const double told =
        penumbra_lx(x0) + s * static_cast<double>(fit.slope.x) + s * s / 2 * static_cast<double>(fit.bend.x);
    worst = std::max(worst, std::fabs(told - e) / e);
  }
  return worst;
}

AxisFit fit_penumbra(double x0, double length, double rho, double least) {
  const double sign = length < 0 ? -1 : 1;
  const auto light = [&](float d) {
    return Rgb(static_cast<float>(penumbra_lx(x0 + sign * static_cast<double>(d))));
  };
  return fit_axis(light(0), light, static_cast<float>(std::fabs(length)), static_cast<float>(least),
                  static_cast<float>(rho));
}

TEST(FootprintFit, SecondOrderTable) {
  const auto rows = test::golden("E_eq18.csv");
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& row : rows) {
    const double x0 = std::stod(row.at("x0")), d = std::stod(row.at("d"));
    const AxisFit fit = fit_penumbra(x0, d, 1e9, d);
    EXPECT_NEAR(worst_error(fit, x0, 1, 0.05, 20), std::stod(row.at("maxrelerr_corrected")), 2e-4)
        << x0 << ' ' << d;
  }
}

TEST(FootprintFit, HalvingTable) {
  const auto rows = test::golden("E_shrink.csv");
  ASSERT_EQ(rows.size(), 12u);
  for (const auto& row : rows) {
    const double x0 = std::stod(row.at("x0")), d = std::stod(row.at("d0")), rho = std::stod(row.at("rho"));
    const AxisFit fit = fit_penumbra(x0, d, rho, 1e-3 * std::fabs(d));
    EXPECT_TRUE(fit.resolved);
    EXPECT_NEAR(fit.length_m, std::stod(row.at("halving_d")), 1e-6) << x0 << ' ' << rho;
    EXPECT_EQ(fit.evaluations, std::stoi(row.at("halving_evals"))) << x0 << ' ' << rho;
    EXPECT_NEAR(worst_error(fit, x0, d < 0 ? -1 : 1, 0.02, 50), std::stod(row.at("halving_maxrelerr")), 2e-4)
        << x0 << ' ' << rho;
  }
}

TEST(FootprintFit, EndsAtTheLeastLength) {
  for (const float least : {0.001f, 0.3f, 1.f, 7.f}) {
    int calls = 0;
    const auto jumpy = [&](float) { return Rgb(++calls % 2 == 0 ? 1.f : 100.f); };
    const AxisFit fit = fit_axis(Rgb(10), jumpy, 1, least, 0.02f);
    EXPECT_FALSE(fit.resolved);
    EXPECT_GE(fit.length_m, least);
    EXPECT_LT(fit.length_m, std::max(2 * least, 1.0001f));
    EXPECT_LE(fit.evaluations, 5 + 2 * 10);
    EXPECT_EQ(fit.evaluations, calls + 1);
  }
  const AxisFit dark = fit_axis(
      Rgb(0), [](float) { return Rgb(0); }, 1, 0.001f, 0.02f);
  EXPECT_TRUE(dark.resolved);
  EXPECT_EQ(dark.length_m, 1);
}

Hemisphere seen(const GradientScene& scene, int rings = 16, const Frame& frame = {}) {
  RandomStream random(5, Stage::test, 7);
  return test::seen_by_rays(scene, rings, slices_for(rings), random, frame);
}

TEST(FootprintFit, AxesEndAtWhatIsNear) {
  const FootprintBounds bounds{0.01f, 4, 1, 0.05f};
  const auto radii = [&](const GradientScene& s) {
    const Hemisphere h = seen(s, 40);
    return radii_by_surroundings(std::span(&h, 1), bounds);
  };
  for (const float r : radii({"nothing", {}, {}, false, {}})) EXPECT_EQ(r, 4);
  // A wall 1 m away in the direction of axis 0. Least slant distances in the sectors: 1, 1 / cos 22.5, 1 /
  // cos 67.5.
  const auto wall = radii({"wall", {{0, 1, {-90, 0}, {90, 90}}}, {}, false, {}});
  EXPECT_NEAR(wall[0], 1, 0.03);
  for (const std::size_t k : {1u, 7u}) EXPECT_NEAR(wall[k], 1.082, 0.05);
  for (const std::size_t k : {2u, 6u})
    EXPECT_NEAR(wall[k], 2 * wall[1], 0.2);  // 2.61, but at most twice axis 1
  for (const std::size_t k : {3u, 4u, 5u}) EXPECT_GT(wall[k], 3);
  // A corridor of 2 m: short across, long along.
  const auto corridor =
      radii({"corridor", {{0, 1, {-90, 0}, {90, 90}}, {0, -1, {-90, 0}, {90, 90}}}, {}, false, {}});
  for (const std::size_t k : {0u, 4u}) EXPECT_NEAR(corridor[k], 1, 0.03);
  for (const std::size_t k : {2u, 6u}) EXPECT_NEAR(corridor[k], 2 * corridor[1], 0.2);
  // Right at a wall: no shorter than the least.
  for (const float r : radii({"at a wall", {{0, 1e-5, {-90, 0}, {90, 90}}}, {}, false, {}}))
    EXPECT_GE(r, 0.01f);
}

/// All walls alike: exactly even, as their hits always fill the hemisphere.
TEST(FootprintFit, FurnaceIsEven) {
  const Hemisphere h = seen(test::gradient_scene("white_furnace"));
  const LightNearby nearby(std::span(&h, 1), GradientMode::hybrid, 1e-3f);
  const FittedFootprint f =
      fit_footprint(std::span(&h, 1), nearby, {}, {}, Gradients().rotation, {0.01f, 2, 0.5f, 0.05f});
  EXPECT_EQ(f.unresolved, 0);
  for (const AdaptiveFootprint::Axis& a : f.footprint->axes()) {
    EXPECT_NEAR(a.slope.x, 0, 1e-4);
    EXPECT_NEAR(a.bend.x, 0, 1e-4);
    EXPECT_GT(a.length_m, 0.2f);
  }
}

TEST(FootprintFit, EquivalentLightsFollowTheClosedForm) {
  for (const char* name : {"rect_ceiling", "closed_box_5L", "rect_wall_x1"}) {
    const GradientScene scene = test::gradient_scene(name);
    const Hemisphere h = seen(scene, 32);
    const LightNearby nearby(std::span(&h, 1), GradientMode::hybrid, 1e-3f);
    const double here = scene.irradiance_lx(DVec3(0));
    EXPECT_NEAR(nearby.at(Vec2(0)).irradiance.x, irradiance_of(h).x, 1e-4);
    for (int k = 0; k < kAxes; ++k)
      for (const float d : {0.1f, 0.3f}) {
        const Vec2 step = d * AdaptiveFootprint::direction(k);
        const double truth = scene.irradiance_lx(DVec3(Vec3(step, 0)));
        EXPECT_NEAR(nearby.at(step).irradiance.x, truth, 0.05 * std::max(truth, here))
            << name << ' ' << k << ' ' << d;
      }
  }
}

/// Under a plate nearer than the least axis is long, which thereby leads out from under it, where nothing is
/// known: no more light than if all that is about shone like its brightest.
TEST(FootprintFit, SaysNothingOfTheLightBeyondWhatIsNearerThanTheLeastAxis) {
  for (const double near : {0.003, 0.01, 0.03}) {
    for (const double side : {1.0, 3.0, 10.0}) {
      for (const double aside : {-0.8, 0.0, 0.8, 1.2}) {
        const double half = side * near, x = aside * half;
        const Hemisphere h =
            seen({"plate",
                  {{2, near, {x - half, -half}, {x + half, half}, 0.01}, {2, 3, {-90, -90}, {90, 90}, 1}},
                  {},
                  false,
                  {}});
        const LightNearby nearby(std::span(&h, 1), GradientMode::hybrid, 1e-3f);
        const FittedFootprint f =
            fit_footprint(std::span(&h, 1), nearby, {}, {}, Gradients().rotation, {0.1f, 2, 1, 0.05f});
        for (const AdaptiveFootprint::Axis& a : f.footprint->axes())
          EXPECT_LT(irradiance_of(h).x + a.slope.x + a.bend.x / 2, 1.1f * kPi)
              << near << ' ' << side << ' ' << aside;
      }
    }
  }
}

/// docs/methods.md#e5: of a uniform field only what lies above the record's horizon is known, pi (1 + cos)
/// / 2.
TEST(FootprintFit, TurnsLikeTheSeenHalf) {
  Hemisphere h = seen({"sky", {}, {}, false, {}}, 32);
  std::fill(h.radiance.begin(), h.radiance.end(), Rgb(1));
  const LightNearby nearby(std::span(&h, 1), GradientMode::hybrid, 1e-3f);
  for (const double degrees : {5., 20., 40.}) {
    const double a = degrees * std::numbers::pi / 180;
    const Rgb bend = nearby.bend_by_turn({1, 0}, static_cast<float>(std::sin(a)), {});
    EXPECT_NEAR(bend.x, std::numbers::pi * (std::cos(a) - 1) / 2, 0.03) << degrees;
  }
}

/// The scene turned, and the frame with it: the same.
TEST(FootprintFit, TurnsWithTheScene) {
  const GradientScene scene = test::gradient_scene("rect_occluded");
  const Hemisphere h = seen(scene);
  Hemisphere turned = h;
  const Mat3 turn(Vec3(0, 0.6f, 0.8f), Vec3(1, 0, 0), Vec3(0, 0.8f, -0.6f));
  turned.frame = {turn * h.frame.x, turn * h.frame.y, turn * h.frame.z};
  for (std::size_t i = 0; i < h.size(); ++i)
    turned.direction[i] = turn * h.direction[i], turned.hit_normal[i] = turn * h.hit_normal[i];
  const FootprintBounds bounds{0.01f, 2, 0.5f, 0.05f};
  const LightNearby a(std::span(&h, 1), GradientMode::hybrid, 1e-3f),
      b(std::span(&turned, 1), GradientMode::hybrid, 1e-3f);
  const FittedFootprint f = fit_footprint(std::span(&h, 1), a, {}, {}, Gradients().rotation, bounds),
                        g = fit_footprint(std::span(&turned, 1), b, {}, {}, Gradients().rotation, bounds);
  for (std::size_t k = 0; k < kAxes; ++k) {
    EXPECT_NEAR(f.footprint->axes()[k].length_m, g.footprint->axes()[k].length_m, 1e-4);
    EXPECT_NEAR(f.footprint->axes()[k].slope.x, g.footprint->axes()[k].slope.x, 1e-3);
  }
}

/// A lamp of 1 m x 1 m over a floor, half hidden by an edge: a penumbra. No other light.
struct Penumbra {
  Scene scene;
  explicit Penumbra(float scale = 1) {
    test::begin_instance(scene, "floor", test::add_lambert(scene, "floor", 0.5f));
    test::add_quad(scene, scale * Vec3(-3, 0, 3), scale * Vec3(6, 0, 0), scale * Vec3(0, 0, -6));
    test::begin_instance(scene, "edge", test::add_lambert(scene, "edge", 0));
    test::add_quad(scene, scale * Vec3(-3, 1, -3), scale * Vec3(3, 0, 0), scale * Vec3(0, 0, 6));
    test::begin_instance(scene, "lamp", test::add_lambert(scene, "lamp", 0, 100));
    test::add_quad(scene, scale * Vec3(-0.5f, 2, -0.5f), scale * Vec3(1, 0, 0),
                   scale * Vec3(0, 0, 1));  // shines down
    finalize(scene);
  }
  double truth_lx(double x, double z = 0) const {
    // The rectangles of the table lie across z; here up is y.
    static const GradientScene s{
        "", {{2, 2, {-0.5, -0.5}, {0.5, 0.5}, 100}, {2, 1, {-3, -3}, {0, 3}, 0}}, {}, true, {}};
    return s.irradiance_lx({x, z, 0});
  }
};

IrradianceRecord made_at(const Scene& scene, const Vec3& p, double rho = 0.05) {
  RecordOptions options = test::gather_options(scene, Quantity::all, 1, 512);
  options.footprint = Footprint::adaptive, options.rho = rho, options.light_samples = 1024;
  test::Gathered gathered(scene);
  return gathered.records(p, {0, 1, 0}, options, {}, 1)[0];
}

TEST(FootprintRecords, FollowPenumbrasWithinTheirZones) {
  const Penumbra scene;
  for (const double x : {-0.3, 0.1, 0.45, 0.8}) {
    const IrradianceRecord r = made_at(scene.scene, Vec3(static_cast<float>(x), 0, 0.05f));
    ASSERT_TRUE(r.footprint);
    EXPECT_NEAR(r.irradiance.y, scene.truth_lx(x, 0.05), 0.02 * 100) << x;
    for (int i = 0; i < 16; ++i) {
      // Half and nearly all of the way to the border of the zone, as read with the default accuracy.
      const Vec3 way(Vec2(at_angle(22.5 * i)).x, 0, Vec2(at_angle(22.5 * i)).y);
      const float border = 0.5f / record_error(r, r.position + 0.001f * way, r.normal) * 0.001f;
      for (const float s : {0.5f, 0.95f}) {
        const Vec3 p = r.position + s * border * way;
        const double truth = scene.truth_lx(static_cast<double>(p.x), static_cast<double>(p.z));
        EXPECT_NEAR(extrapolate(r, p, r.normal).y, truth, (s < 0.9f ? 0.12 : 0.2) * std::max(truth, 5.))
            << x << ' ' << i << ' ' << s;
      }
    }
  }
  // Towards an edge of shadow axes are short, along it long.
  const IrradianceRecord edge = made_at(scene.scene, {-0.3f, 0, 0}, 0.02);
  EXPECT_LT(1.5f * edge.footprint->shortest_m(), edge.footprint->longest_m());
}

/// Axes that are as short as they may be reach through walls; the light behind those is not the record's.
TEST(FootprintRecords, KnowNothingOfTheLightBehindWalls) {
  Scene room;
  test::begin_instance(room, "walls", test::add_lambert(room, "grey", 0.5f));
  test::add_room(room, Vec3(0), Vec3(2, 1, 1.5f));
  test::surround(room, test::constant_map(8, Rgb(1e5f)));
  RecordOptions options = test::gather_options(room, Quantity::all, 1, 256);
  options.footprint = Footprint::adaptive, options.min_radius_m = 0.3;
  test::Gathered gathered(room);
  const IrradianceRecord r = gathered.records({0.01f, 0, 0.02f}, {0, 1, 0}, options, {}, 1)[0];
  ASSERT_TRUE(r.footprint);
  EXPECT_GT(r.footprint->shortest_m(), 0.05f);
  EXPECT_EQ(r.irradiance, Rgb(0));
  for (const AdaptiveFootprint::Axis& a : r.footprint->axes())
    EXPECT_EQ(glm::abs(a.slope) + glm::abs(a.bend), Rgb(0));
}

/// The scene in other units: as many lux, lengths in proportion.
TEST(FootprintRecords, KeepTheirShapeAtEverySize) {
  const Penumbra one;
  const IrradianceRecord r = made_at(one.scene, {0.1f, 0, 0});
  for (const double scale : {0x1p-20, 0x1p20, 1e-6, 1e6}) {
    const auto s = static_cast<float>(scale);
    const Penumbra other(s);
    const IrradianceRecord o = made_at(other.scene, s * Vec3(0.1f, 0, 0));
    const bool exact = scale == 0x1p-20 || scale == 0x1p20;
    EXPECT_NEAR(o.irradiance.x / r.irradiance.x, 1, exact ? 0 : 0.02);
    for (std::size_t k = 0; k < kAxes; ++k) {
      const AdaptiveFootprint::Axis &a = r.footprint->axes()[k], &b = o.footprint->axes()[k];
      if (exact) {
        EXPECT_EQ(b.length_m, a.length_m * s);
        EXPECT_EQ(b.slope.x, a.slope.x);
        EXPECT_EQ(b.bend.x, a.bend.x);
      } else {
        EXPECT_NEAR(b.slope.x / b.length_m * s, a.slope.x / a.length_m,
                    0.15 * std::fabs(a.slope.x / a.length_m) + 2);
      }
    }
  }
}

/// What a tree finds is the sum over all records; a file gives back the same bits.
TEST(FootprintRecords, AreLookedUpAndReadAsTheyAre) {
  const Penumbra scene;
  IrradianceCache cache;
  cache.accuracy = 0.2, cache.quantity = Quantity::all;
  for (int i = 0; i < 12; ++i)
    cache.records.push_back(
        made_at(scene.scene, {-0.6f + 0.12f * static_cast<float>(i), 0, 0.01f * static_cast<float>(i)}));
  const std::string path = test::scratch("footprints") + "/f.irradiance";
  write_irradiance(path, cache, Provenance());
  const IrradianceCache read = read_irradiance(Container::open(path));
  RecordTree tree(scene.scene.bounds, 0.5), again(scene.scene.bounds, 0.5);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  for (const IrradianceRecord& r : read.records) again.insert(r);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(-0.8f + 0.008f * static_cast<float>(i), 0, 0.07f), n(0, 1, 0);
    Interpolated sum;
    for (const IrradianceRecord& r : cache.records)
      if (const float w = record_weight(record_error(r, p, n), 0.5f); w > kLeastWeight) sum.add(r, w, p, n);
    sum.finish();
    const Interpolated t = tree.interpolate(p, n);
    EXPECT_FLOAT_EQ(t.weight, sum.weight);
    EXPECT_NEAR(t.irradiance.x, sum.irradiance.x, 1e-6f * sum.irradiance.x);  // in another order
    EXPECT_EQ(t.irradiance, again.interpolate(p, n).irradiance);
    found += t.weight > 0;
  }
  EXPECT_GT(found, 60);
}

TEST(FootprintRecords, DamagedOnesAreRefused) {
  const Penumbra scene;
  const IrradianceRecord good = made_at(scene.scene, {0.1f, 0, 0});
  const std::string path = test::scratch("footprints") + "/bad.irradiance";
  const auto refused = [&](const Vec3& x, const std::function<void(AdaptiveFootprint::Axes&)>& damage,
                           const std::string& says) {
    IrradianceCache cache;
    cache.records = {good, good};
    AdaptiveFootprint::Axes axes = good.footprint->axes();
    damage(axes);
    cache.records[1].footprint = std::make_shared<AdaptiveFootprint>(x, good.normal, axes);
    write_irradiance(path, cache, Provenance());
    try {
      read_irradiance(Container::open(path));
      ADD_FAILURE() << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  };
  const Vec3 x = good.footprint->x();
  const std::string length = "row 1 of tensor \"footprint_length\" is not finite and above 0";
  refused(
      x, [](auto& a) { a[3].length_m = 0; }, length);
  refused(
      x, [](auto& a) { a[7].length_m = -1; }, length);
  refused(
      x, [](auto& a) { a[0].slope.y = kInfinity; }, "row 1 of tensor \"footprint_slope\" is not finite");
  refused(
      x, [](auto& a) { a[5].turn_bend.z = std::nanf(""); },
      "row 1 of tensor \"footprint_turn_bend\" is not finite");
  refused(
      2.f * x, [](auto&) {}, "row 1 of tensor \"footprint_axis\" is not a vector of unit length");
  refused(
      good.normal, [](auto&) {}, "record 1 has a footprint that is not on its tangent plane");
}

}  // namespace
}  // namespace phos
