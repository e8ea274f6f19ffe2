// Irradiance by gathered rays against every scene whose light is known in closed form (derivations:
// tests/support/scenes.h): no bias over many random numbers, and an honest standard error. What is stated may
// exceed the true error, or fall short by a sixth: lamps are sampled by low-discrepancy points, whose gain it
// knows in the mean over places only.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/sampling.h"
#include "support/gathered.h"
#include "support/mirrors.h"
#include "support/one_material.h"
#include "support/records.h"

namespace phos {
namespace {

/// Of true / stated error: at one place, where more would leave fewer than 90 % of values within two errors,
/// and the root mean square over places.
constexpr double kNotBelow = 0.5, kNotAbove = 1.2, kNotAboveInAll = 1.1;

/// The mean is the truth to within 3.5 of its standard errors and the rounding of sums.
void expect_unbiased(const test::Trial& t, double truth, const std::string& what) {
  EXPECT_NEAR(t.mean, truth, 3.5 * t.stderr_of_mean + 2e-6 * truth) << what;
  EXPECT_LE(t.stderr_of_mean, 0.02 * truth) << what;
}

/// One reflection in a furnace: every wall sends back rho / pi of the M = 1 that falls on it, so that rho
/// arrives.
TEST(Furnace, OneBounce) {
  for (const float albedo : {0.1f, 0.5f, 0.9f, 0.99f}) {
    const test::AnalyticScene s = test::furnace(albedo);
    test::Gathered g(s.scene);
    const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 256);
    const double truth = test::furnace_lx(1, double(albedo), 1) - 1;
    double squares = 0;
    for (const test::Check& check : s.checks) {
      const test::Trial t = g.trial(check.position, check.normal, options, {}, truth, 1000);  // to 2 %
      expect_unbiased(t, truth, s.name);
      EXPECT_GT(t.stated, kNotBelow) << albedo;
      EXPECT_LT(t.stated, kNotAbove) << albedo;
      squares += t.stated * t.stated;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(s.checks.size())), kNotAboveInAll) << albedo;
  }
}

/// With direct light added, 1 + rho.
TEST(Furnace, OneBounceAndDirect) {
  const test::AnalyticScene s = test::furnace(0.5f);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 256);
  const double truth = test::furnace_lx(1, 0.5, 1);
  const test::Check& check = s.checks[0];
  expect_unbiased(g.trial(check.position, check.normal, options, {}, truth), truth, s.name);
}

/// Zones of the source that are wider than the room: rays are followed to nine places, each lit by the lamps
/// (M = 1) and reflecting rho of that, and what the source says there, three times the truth, is seen through
/// the nine: sum of rho^k, k = 1 to 9, + 3 rho^10 / (1 - rho). Zones without photons: it is read at once.
TEST(Furnace, PlacesWithinAZoneOfTheSourceAreFollowed) {
  for (const float albedo : {0.5f, 0.9f}) {
    const test::AnalyticScene s = test::furnace(albedo);
    test::Gathered g(s.scene);
    const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, -1, 256);
    const double rho = static_cast<double>(albedo), after = rho / (1 - rho);
    const RecordTree indirect = test::uniform_tree(Vec3(0), {2, 1, 1.5f}, static_cast<float>(3 * after));
    GatherSource source;
    source.indirect = &indirect;
    const test::Check& check = s.checks[0];
    const test::Trial read =
        g.trial(check.position, check.normal, options, source, rho + 3 * rho * after, 400);
    EXPECT_NEAR(read.mean, rho + 3 * rho * after, 3.5 * read.stderr_of_mean) << s.name;
    source.photon_lm = 1, source.zone_photons = 1e6;
    double truth = 3 * std::pow(rho, 9) * after;
    for (int k = 1; k <= 9; ++k) truth += std::pow(rho, k);
    expect_unbiased(g.trial(check.position, check.normal, options, source, truth, 400), truth, s.name);
    source.holds_direct = true;  // which would be lost
    const test::Trial all = g.trial(check.position, check.normal, options, source, 3 * rho * after, 4);
    EXPECT_NEAR(all.mean, 3 * rho * after, 2e-6 * all.mean) << s.name;
  }
}

/// Where a mirror could send on light of a lamp that no ray finds, places are read, however wide zones are.
TEST(Gather, LightOfPointsByWayOfMirrorsIsNotLost) {
  Scene scene;
  test::begin_instance(scene, "room", test::add_lambert(scene, "grey", 0.5f));
  test::add_room(scene, Vec3(0), {2, 1, 1.5f});
  test::add_point_light(scene, {1.2f, 0.8f, 0.5f}, 10);
  finalize(scene);
  const RecordTree indirect = test::uniform_tree(Vec3(0), {2, 1, 1.5f}, 7);
  const auto found = [&](const Scene& room, double zone_photons) {
    test::Gathered g(room);
    GatherSource source;
    source.indirect = &indirect, source.photon_lm = 1, source.zone_photons = zone_photons;
    const RecordOptions options = test::gather_options(room, Quantity::indirect, -1, 256);
    return g.records({1, 0, 0.7f}, {0, 1, 0}, options, source, 1)[0].irradiance;
  };
  EXPECT_NE(found(scene, 0), found(scene, 1e6));
  scene.material.push_back(test::make_material(Model::mirror, Rgb(0), Rgb(1)));
  EXPECT_EQ(found(scene, 0), found(scene, 1e6));
}

/// All bounces, of which the exact cache knows all but the last: rho (1 + rho / (1 - rho)) = rho / (1 - rho).
/// One that holds direct light says 1 / (1 - rho), and leaves no noise at all.
TEST(Furnace, AllBouncesFromAnExactCache) {
  for (const float albedo : {0.1f, 0.5f, 0.9f, 0.99f}) {
    const test::AnalyticScene s = test::furnace(albedo);
    test::Gathered g(s.scene);
    const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, -1, 256);
    const float truth = albedo / (1 - albedo);
    const RecordTree indirect = test::uniform_tree(Vec3(0), {2, 1, 1.5f}, truth);
    const RecordTree all = test::uniform_tree(Vec3(0), {2, 1, 1.5f}, 1 / (1 - albedo));
    for (const test::Check& check : s.checks) {
      const test::Trial t =
          g.trial(check.position, check.normal, options, {.indirect = &indirect}, double(truth), 50);
      expect_unbiased(t, double(truth), s.name);
      const auto exact =
          g.records(check.position, check.normal, options, {.indirect = &all, .holds_direct = true}, 2);
      for (const IrradianceRecord& r : exact) {
        EXPECT_NEAR(r.irradiance.y, truth, 3e-6f * truth);
        EXPECT_LT(r.stderr_lx.y, 1e-5f * truth);
      }
    }
    EXPECT_EQ(g.counters["gathered places without a record"], 0u);
  }
}

/// The cache that is used in practice, from photons: its own error is all that may be left.
TEST(Furnace, AllBouncesFromPhotons) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const test::Lit lit = test::light_up(s.scene, 100000);
  RecordOptions coarse;
  coarse.resolve(s.scene.bounds.diagonal_m() / 4);
  const DensityEstimator photons(lit.photons, *lit.rays, coarse, 1);
  IrradianceCache cache;
  cache.accuracy = coarse.accuracy;
  Counters counters;
  test::place_at_photons(cache, lit.photons, *lit.rays, coarse, {.max_candidates = 5000}, 1, counters);
  RecordTree tree(s.scene.bounds, cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, -1, 256);
  for (const test::Check& check : s.checks) {
    const test::Trial t =
        g.trial(check.position, check.normal, options, {.indirect = &tree, .fallback = &photons}, 1, 20);
    EXPECT_NEAR(t.mean, 1, 3.5 * t.stderr_of_mean + 0.01);
  }
  // Without the cache, photons are asked at every hit.
  const RecordOptions few = test::gather_options(s.scene, Quantity::indirect, -1, 16);
  const test::Check& check = s.checks[0];
  const test::Trial t = g.trial(check.position, check.normal, few, {.fallback = &photons}, 1, 20);
  EXPECT_NEAR(t.mean, 1, 3.5 * t.stderr_of_mean + 0.02);
  // A cache without records sends every ray there, and says so; and is dark if there are no photons either.
  const RecordTree none(s.scene.bounds, 0.2);
  const std::uint64_t before = g.counters["gathered places without a record"];
  g.records(check.position, check.normal, few, {.indirect = &none, .fallback = &photons}, 1);
  const std::uint64_t missed = g.counters["gathered places without a record"] - before;
  EXPECT_GE(missed, 10u);
  EXPECT_LE(missed, 16u);
  expect_unbiased(g.trial(check.position, check.normal, options, {.indirect = &none}, 0.5), 0.5,
                  "empty cache");
}

/// Of the flux P in a closed room of area A, rho P is reflected once and lands somewhere: the area mean of
/// that light is rho P / A, whatever the shape.
TEST(ClosedRoom, AreaMeanOfOneBounce) {
  for (const test::AnalyticScene& s : {test::uniform_box(0.5f), test::integrating_sphere(0.5f, 320)}) {
    test::Gathered g(s.scene);
    const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 64);
    const GatherEstimator gather(g.rays, g.lights, {}, options, 1);
    const auto worker = gather.make_worker();
    std::vector<double> below;  // of area, per triangle
    double area = 0;
    for (std::uint32_t t = 0; t < s.scene.triangle.size(); ++t)
      below.push_back(area += static_cast<double>(area_m2(s.scene, t)));
    double sum = 0, squares = 0;
    constexpr int kPoints = 3000;
    for (std::uint64_t i = 0; i < kPoints; ++i) {
      RandomStream random(11, Stage::test, i);
      const double x = (static_cast<double>(i) + random.uniform_double()) / kPoints * area;
      const auto t =
          static_cast<std::uint32_t>(std::upper_bound(below.begin(), below.end() - 1, x) - below.begin());
      const Vec2 w = sample_triangle(random.uniform2());
      const auto& v = s.scene.triangle[t].v;
      const Vec3 p = (1 - w.x - w.y) * s.scene.position[v[0]] + w.x * s.scene.position[v[1]] +
                     w.y * s.scene.position[v[2]];
      const RecordSite site{p, geometric_normal(s.scene, t), i};
      const auto e = static_cast<double>(gather.make(site, *worker).record.irradiance.y);
      sum += e / kPoints, squares += e * e / kPoints;
    }
    const double truth = 0.5 * 100 / area;
    EXPECT_NEAR(sum, truth, 3.5 * std::sqrt((squares - sum * sum) / kPoints)) << s.name;
    EXPECT_NEAR(sum, truth, 0.02 * truth) << s.name;
  }
}

/// Nothing that reflects sees anything lit: all light is direct.
TEST(Direct, EveryOpenScene) {
  for (const test::AnalyticScene& s : test::all_point_scenes()) {
    if (s.name == "furnace") continue;
    test::Gathered g(s.scene);
    for (const test::Check& check : s.checks) {
      const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 64);
      const double truth = check.irradiance_lx;
      const test::Trial t = g.trial(check.position, check.normal, options, {}, truth);
      expect_unbiased(t, truth, s.name);
      // Point lamps are known exactly; of points spread evenly over others the gain is measured, not known:
      // near a lamp errors are a few thousandths.
      if (t.stderr_of_mean > 1e-6 * truth) {
        EXPECT_LT(t.stated, 1.7) << s.name;
      }
    }
  }
}

/// A mirror of reflectance 0.8 in the plane x = -1 shows the lamp a second time: what arrives by it is 0.8 of
/// what the lamp sends to the place's mirror image.
TEST(Mirror, ShowsTheLampOnceMore) {
  test::AnalyticScene s = test::rectangle_light_parallel();
  Material mirror;
  mirror.model = Model::mirror, mirror.ks = Rgb(0.8f);
  test::hide_images(s.scene, mirror);
  s.scene.material.push_back(mirror);
  test::begin_instance(s.scene, "mirror", static_cast<std::uint32_t>(s.scene.material.size() - 1));
  test::add_quad(s.scene, {-1, 0, -20}, {0, 40, 0}, {0, 0, 40});
  finalize(s.scene);
  test::Gathered g(s.scene);
  for (const Vec3& p : {Vec3(0.5f, 0, 1), Vec3(1.5f, 0, 2)}) {
    const double truth = 0.8 * s.irradiance_lx({-2 - p.x, 0, p.z}, {0, 1, 0});
    for (const std::int64_t bounces : {1, -1}) {
      const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, bounces, 1024);
      const test::Trial t = g.trial(p, {0, 1, 0}, options, {}, truth);
      expect_unbiased(t, truth, "mirror");
      EXPECT_GT(t.stated, 0.7);
      EXPECT_LT(t.stated, kNotAboveInAll);
    }
  }
}

/// In a furnace of a mirroring and scattering material, kd + ks = rho whichever way it goes: light that has
/// been reflected once more is rho times what it was.
TEST(Furnace, DiffuseAndMirrorTogether) {
  test::AnalyticScene s = test::furnace(0.3f);
  Material& walls = s.scene.material[0];
  walls.model = Model::ward, walls.ks = Rgb(0.4f), walls.alpha_x = walls.alpha_y = 0;  // smooth: a mirror
  test::hide_images(s.scene, walls);
  finalize(s.scene);
  test::Gathered g(s.scene);
  const test::Check& check = s.checks[0];
  RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 256);
  expect_unbiased(g.trial(check.position, check.normal, options, {}, 0.7), 0.7, "one bounce");
  // The walk ends where the cache knows the rest.
  options.gather_bounces = -1;
  const RecordTree indirect = test::uniform_tree(Vec3(0), {2, 1, 1.5f}, 0.7f / 0.3f);
  expect_unbiased(g.trial(check.position, check.normal, options, {.indirect = &indirect}, 0.7 / 0.3),
                  0.7 / 0.3, "all bounces");
}

/// Rays enough for the error that was asked for, and no more.
TEST(Error, IsKept) {
  const test::AnalyticScene s = test::furnace(0.5f);
  test::Gathered g(s.scene);
  const test::Check& check = s.checks[0];
  for (const double error : {0.05, 0.02, 0.01}) {
    RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 65536);
    options.error = error;
    for (const IrradianceRecord& r : g.records(check.position, check.normal, options, {}, 20)) {
      EXPECT_LE(r.stderr_lx.y, 1.001 * error * double(r.irradiance.y));
      EXPECT_GE(r.stderr_lx.y, 0.1 * error * double(r.irradiance.y));
    }
    const test::Trial t = g.trial(check.position, check.normal, options, {}, 0.5, 100);
    EXPECT_NEAR(t.mean, 0.5, 3.5 * t.stderr_of_mean);
    EXPECT_LT(t.stderr_of_mean * 10, 1.1 * error * 0.5);
  }
  EXPECT_EQ(g.counters["records above the asked error"], 0u);
  RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 128);
  options.error = 1e-4;
  g.records(check.position, check.normal, options, {}, 7);
  EXPECT_EQ(g.counters["records above the asked error"], 7u);
}

/// dE/dx of a point light over a plane, E = I h (h2 + x2)^-1.5, is -3 x E / (h2 + x2); turned about z by t, E
/// becomes I (n' . w) / d2: its slope is I (dn'/dt . w) / d2.
TEST(Gradient, OfAPointLight) {
  const test::AnalyticScene s = test::point_light_over_plane();
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 64);
  for (const float x : {0.5f, 1.f, 1.5f}) {
    const IrradianceRecord r = g.records({x, 0, 0}, {0, 1, 0}, options, {}, 1)[0];
    const double e = s.irradiance_lx({x, 0, 0}, {0, 1, 0}), d2 = 4 + double(x) * double(x);
    EXPECT_NEAR(r.translation_gradient[1].x, -3 * double(x) * e / d2, 1e-5 * e);
    EXPECT_NEAR(r.translation_gradient[1].y, 0, 1e-5 * e);
    EXPECT_NEAR(r.translation_gradient[1].z, 0, 1e-5 * e);
    const float t = 1e-3f;
    const Vec3 tilted(std::sin(t), std::cos(t), 0);
    const Vec3 w = glm::normalize(Vec3(-x, 2, 0));
    const double slope = e / double(w.y) * double(glm::dot(tilted - Vec3(0, std::cos(t), 0), w)) / double(t);
    EXPECT_NEAR(glm::dot(glm::cross(Vec3(0, 1, 0), tilted), r.rotation_gradient[1]) / t, slope, 1e-3 * e);
  }
}

/// The same for a rectangle, by differences of the closed form.
TEST(Gradient, OfARectangle) {
  const test::AnalyticScene s = test::rectangle_light_parallel();
  test::Gathered g(s.scene);
  RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 64);
  options.light_samples = 1024;
  for (const test::Check& check : s.checks) {
    const Vec3 p = check.position, n = check.normal;
    const IrradianceRecord r = g.records(p, n, options, {}, 1)[0];
    for (const Vec3& step : {Vec3(1e-3f, 0, 0), Vec3(0, 0, 1e-3f)}) {
      const double slope = (s.irradiance_lx(p + step, n) - s.irradiance_lx(p - step, n)) / 2;
      EXPECT_NEAR(glm::dot(r.translation_gradient[1], step), slope, 2e-5 * check.irradiance_lx);
    }
  }
}

}  // namespace
}  // namespace phos
