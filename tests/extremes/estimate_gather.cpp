#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "core/parallel.h"
#include "estimate/events.h"
#include "estimate/hemisphere/hemisphere_record.h"
#include "place/two_level.h"
#include "record/tree.h"
#include "support/gathered.h"
#include "support/records.h"

namespace phos {
namespace {

void expect_finite(const IrradianceRecord& r) {
  ASSERT_TRUE(is_finite(r.irradiance) && is_finite(r.stderr_lx)) << r.irradiance.y;
  ASSERT_TRUE(r.radius_m > 0 && std::isfinite(r.radius_m)) << r.radius_m;
  ASSERT_FALSE(std::isnan(r.distance_m));
  for (int c = 0; c < 3; ++c) {
    ASSERT_TRUE(is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]));
    ASSERT_GE(r.irradiance[c], 0);
  }
}

TEST(Size, GivesTheSameLux) {
  const test::AnalyticScene s = test::furnace(0.5f);
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    const test::AnalyticScene t = test::scaled(s, scale);
    test::Gathered g(t.scene);
    for (const Quantity paths : {Quantity::indirect, Quantity::all}) {
      const RecordOptions options = test::gather_options(t.scene, paths, 1, 256);
      const double truth = paths == Quantity::all ? 1.5 : 0.5;
      for (const test::Check& check : t.checks) {
        const test::Trial trial = g.trial(check.position, check.normal, options, {}, truth, 50);
        EXPECT_NEAR(trial.mean, truth, 4 * trial.stderr_of_mean) << scale;
        const IrradianceRecord r = g.records(check.position, check.normal, options, {}, 1)[0];
        expect_finite(r);
        EXPECT_GT(r.radius_m, 0.05f * scale);
        EXPECT_LT(r.radius_m, 2 * scale);
      }
    }
  }
}

/// Gradients grow as the scene shrinks; radii shrink with it.
TEST(Size, GradientsFollow) {
  const test::AnalyticScene s = test::rectangle_light_parallel();
  const Vec3 p = s.checks[2].position, n = s.checks[2].normal;
  float slope = 0, radius_m = 0;
  for (const float scale : {1.f, 1e-6f, 1e6f}) {
    const test::AnalyticScene t = test::scaled(s, scale);
    test::Gathered g(t.scene);
    const RecordOptions options = test::gather_options(t.scene, Quantity::all, 1, 64);
    const IrradianceRecord r = g.records(scale * p, n, options, {}, 1)[0];
    expect_finite(r);
    if (scale == 1) slope = glm::length(r.translation_gradient[1]), radius_m = r.radius_m;
    EXPECT_NEAR(glm::length(r.translation_gradient[1]) * scale / slope, 1, 1e-3);
    EXPECT_NEAR(r.radius_m / (scale * radius_m), 1, 1e-3);
  }
}

TEST(Power, OfTheLamps) {
  for (const float luminance : {1e-12f, 1e12f}) {
    const test::AnalyticScene s = test::furnace(0.5f, luminance / kPi);
    test::Gathered g(s.scene);
    for (const Quantity paths : {Quantity::indirect, Quantity::all}) {
      const RecordOptions options = test::gather_options(s.scene, paths, 1, 256);
      const double truth = double(luminance) * (paths == Quantity::all ? 1.5 : 0.5);
      double squares = 0;
      for (const test::Check& check : s.checks) {
        const test::Trial t = g.trial(check.position, check.normal, options, {}, truth, 50);
        EXPECT_NEAR(t.mean / truth, 1, 4 * t.stderr_of_mean / truth);
        squares += t.stated * t.stated;
      }
      EXPECT_LT(std::sqrt(squares / static_cast<double>(s.checks.size())), 1.1);
    }
  }
  for (const float candela : {1e-12f, 1e12f}) {
    const test::AnalyticScene s = test::point_light_over_plane(2, candela);
    test::Gathered g(s.scene);
    const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 64);
    const IrradianceRecord r = g.records({1, 0, 0}, {0, 1, 0}, options, {}, 1)[0];
    expect_finite(r);
    EXPECT_NEAR(r.irradiance.y / (2 * candela / std::pow(5.f, 1.5f)), 1, 1e-5);
  }
}

/// A value beyond the range of numbers is an error that says so.
TEST(Power, BeyondNumbers) {
  const test::AnalyticScene s = test::point_light_over_plane(1e-3f, 2e37f);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 64);
  try {
    const IrradianceRecord r = g.records({0, 0, 0}, {0, 1, 0}, options, {}, 1)[0];
    expect_finite(r);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
  }
}

/// On an edge, in a corner, in the air, inside of a solid, outside of the scene, below the floor.
TEST(Site, Anywhere) {
  const test::AnalyticScene s = test::furnace(0.5f);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 256);
  const Vec3 places[] = {{1, 0, 0},    {0, 0, 0},        {2, 1, 1.5f},  {1, 0.5f, 0.7f}, {1, 1e-7f, 1e-7f},
                         {1, 0, 0.7f}, {-1, 0.5f, 0.7f}, {1, -1, 0.7f}, {1e6f, 0, 0}};
  const Vec3 normals[] = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, glm::normalize(Vec3(1, 1, 1))};
  for (const Vec3& p : places)
    for (const Vec3& n : normals)
      for (const IrradianceRecord& r : g.records(p, n, options, {}, 3)) expect_finite(r);
  // In the air, whichever way it faces, a furnace is a furnace.
  for (const Vec3& n : normals) {
    const test::Trial t = g.trial({1, 0.5f, 0.7f}, n, options, {}, 1.5, 100);
    EXPECT_NEAR(t.mean, 1.5, 4 * t.stderr_of_mean);
  }
  // Outside, behind the lamps, it is dark but for what no wall sends: nothing.
  EXPECT_EQ(g.records({-1, 0.5f, 0.7f}, {-1, 0, 0}, options, {}, 1)[0].irradiance, Rgb(0));
}

/// The hemisphere of a corner lies between walls that it touches: half or three quarters of its rays start in
/// one. What is left is right: never more than there is.
TEST(Site, EdgeHasNoMoreThanThereIs) {
  const test::AnalyticScene s = test::emitting_environment();
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 256);
  const Vec3 u(1, 0.25f, 0), v = glm::cross(glm::normalize(Vec3(-0.25f, 1, 0.5f)), glm::normalize(u));
  const Vec3 n = glm::normalize(glm::cross(v, u));
  // The border and the corner of a sheet in the open are lit like its middle.
  for (const Vec3& p : {0.5f * u, 0.5f * (u + v)}) {
    const test::Trial t = g.trial(p, n, options, {}, s.checks[0].irradiance_lx, 50);
    EXPECT_NEAR(t.mean, s.checks[0].irradiance_lx, 4 * t.stderr_of_mean);
  }
}

TEST(Nothing, ToSeeIsDark) {
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "grey", 0.5f));
  test::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  finalize(scene);
  test::Gathered g(scene);
  for (const Quantity paths : {Quantity::indirect, Quantity::all}) {
    for (const std::int64_t bounces : {-1, 1}) {
      const RecordOptions options = test::gather_options(scene, paths, bounces, 64);
      const IrradianceRecord r = g.records({0, 0, 0}, {0, 1, 0}, options, {}, 1)[0];
      expect_finite(r);
      EXPECT_EQ(r.irradiance, Rgb(0));
      EXPECT_EQ(r.stderr_lx, Rgb(0));
      EXPECT_EQ(r.distance_m, kInfinity);
      EXPECT_FLOAT_EQ(r.radius_m, static_cast<float>(*options.max_radius_m));
    }
  }
}

/// Dark, but what is seen would be lit if a wall did not hide the lamp: how dark is known to a ray.
TEST(Nothing, LitHasAnError) {
  const test::AnalyticScene s = test::thin_walls(1000, 0.01f);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, 1, 64);
  const IrradianceRecord r = g.records({0, 0, 0}, {0, 0, -1}, options, {}, 1)[0];
  EXPECT_EQ(r.irradiance, Rgb(0));
  EXPECT_GT(r.stderr_lx.y, 0);
  EXPECT_LT(r.stderr_lx.y, 0.5f * 1000 / 52);  // one ray of 52 that shows a wall of 1000 lx
}

/// Gloss under a coat is signed: it takes light from the Lambert part. The sum of few rays can fall below
/// zero where a hit sends its one ray of gloss to a lamp, and is dark then; no file takes less than nothing.
TEST(Nothing, IsTheLeastThereIs) {
  test::AnalyticScene s = test::furnace(0.9f, 0);
  Material& m = s.scene.material[0];
  m.model = Model::plastic, m.alpha_x = m.alpha_y = 0.1f, m.ior = 1.5f;
  test::begin_instance(s.scene, "lamp", test::add_lambert(s.scene, "lamp", 0, 1000));
  test::add_quad(s.scene, {0.2f, 0.99f, 0.2f}, {1.6f, 0, 0}, {0, 0, 1.1f});
  finalize(s.scene);
  test::Gathered g(s.scene);
  const RecordTree dark = test::uniform_tree(Vec3(0), Vec3(2, 1, 1.5f), 1e-6f);
  GatherSource source;
  source.indirect = &dark;
  const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, -1, 8);
  for (const IrradianceRecord& r : g.records({1, 0, 0.75f}, {0, 1, 0}, options, source, 2000))
    expect_finite(r);
  EXPECT_GT(g.counters[kBelowZeroEvent], 0u) << "nothing was tested";
}

/// Within a body that reflects more than it gets, where rays come by a crack and photons do not: from a place
/// there each walk would go on for ever, and start others where it reads nothing.
TEST(Walks, EndWithinABodyThatReflectsTooMuch) {
  test::AnalyticScene s = test::point_light_over_plane();
  Material shiny = s.scene.material[0];
  shiny.model = Model::phong, shiny.kd = Rgb(0.66f), shiny.ks = Rgb(0.9f), shiny.exponent = 400;
  s.scene.material.push_back(shiny);
  test::begin_instance(s.scene, "body", static_cast<std::uint32_t>(s.scene.material.size() - 1));
  const Vec3 at = s.checks[0].position + Vec3(0.01f);
  test::add_room(s.scene, at, at + Vec3(0.1f));
  finalize(s.scene);
  const test::Lit lit = test::light_up(s.scene, 20'000);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::indirect, -1, 128);
  const CoarseLevel coarse(*lit.rays, lit.photons, options, 1);
  const auto records = g.records(at + Vec3(0.05f, 0, 0.05f), {0, 1, 0}, options, coarse.source(), 2);
  for (const IrradianceRecord& r : records) expect_finite(r);
  EXPECT_GT(g.counters["gathered paths cut"], 0u);
}

TEST(Determinism, SameBytesForAnyThreads) {
  const test::AnalyticScene s = test::furnace(0.5f);
  test::Gathered g(s.scene);
  RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 1024);
  options.error = 0.02;
  const GatherEstimator estimator(g.rays, g.lights, {}, options, 7);
  std::vector<std::vector<IrradianceRecord>> runs;
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    std::vector<IrradianceRecord> made(60);
    parallel_chunks(made.size(), 7, [&](std::size_t begin, std::size_t end) {
      const auto worker = estimator.make_worker();
      for (std::size_t i = begin; i < end; ++i) {
        const test::Check& check = s.checks[i % s.checks.size()];
        made[i] = estimator.make({check.position, check.normal, i}, *worker).record;
      }
    });
    runs.push_back(std::move(made));
  }
  set_threads(0);
  for (const auto& run : runs)
    EXPECT_EQ(std::memcmp(run.data(), runs[0].data(), run.size() * sizeof(IrradianceRecord)), 0);
}

}  // namespace
}  // namespace phos
