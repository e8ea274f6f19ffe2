// Powers, sizes, reflectances and numbers of lights far from everyday ones: right answers or counted events.
#include <gtest/gtest.h>

#include "core/error.h"
#include "photon/events.h"
#include "photon/trace.h"
#include "support/scenes.h"

namespace phos {
namespace {

struct Traced {
  Photons photons;
  PhotonTotals totals;
  Counters counters;
};

Traced traced(const Scene& scene, std::int64_t paths) {
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = paths;
  Traced t;
  t.photons = trace_photons(rays, options, 11, t.totals, t.counters);
  return t;
}

void expect_finite(const Traced& t) {
  for (std::size_t i = 0; i < t.photons.size(); ++i) {
    ASSERT_TRUE(is_finite(t.photons.position[i]) && is_finite(t.photons.flux[i]));
    ASSERT_GE(std::min({t.photons.flux[i].x, t.photons.flux[i].y, t.photons.flux[i].z}), 0);
    ASSERT_GT(t.photons.distance[i], 0);
  }
}

TEST(TraceExtremes, PowersFromPicolumenToTeralumen) {
  for (const float power : {1e-12f, 1e-6f, 1.0f, 1e6f, 1e12f}) {
    const test::AnalyticScene s = test::uniform_box(0.5f, power);
    const Traced t = traced(s.scene, 20'000);
    expect_finite(t);
    // variance of the stored flux: see analytic/photon_density
    const double error = double(power) * std::sqrt(0.5 / 20'000) * 2;
    EXPECT_NEAR(double(t.totals.stored_flux_lm.x), 2 * double(power), 4.8 * error) << power;
  }
}

TEST(TraceExtremes, SizesFromMicrometreToMegametre) {
  for (const float scale : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const test::AnalyticScene s = test::scaled(test::furnace(0.9f), scale);
    const Traced t = traced(s.scene, 10'000);
    expect_finite(t);
    const double expected = s.mean_irradiance_lx * s.area_m2;
    EXPECT_NEAR(double(t.totals.stored_flux_lm.x), expected, 4.8 * expected * std::sqrt(0.9 / 10'000))
        << scale;
    EXPECT_EQ(t.counters[kEscapedEvent], 0u) << scale;
  }
}

TEST(TraceExtremes, AlbedoNearOneEndsAndKeepsItsFlux) {
  const test::AnalyticScene s = test::uniform_box(0.999f, 100);
  const Traced t = traced(s.scene, 1'000);
  expect_finite(t);
  const double expected = s.mean_irradiance_lx * s.area_m2;
  EXPECT_NEAR(double(t.totals.stored_flux_lm.x), expected, 4.8 * expected / std::sqrt(1'000.0));
  EXPECT_EQ(t.counters[kTooLongEvent], 0u);
}

TEST(TraceExtremes, PerfectMirrorsEndAtTheCapAndAreCounted) {
  Scene scene;
  Material mirror;
  mirror.model = Model::mirror;
  mirror.ks = Rgb(1);
  scene.material.push_back(mirror);
  test::begin_instance(scene, "walls", 0);
  test::add_room(scene, Vec3(0), Vec3(1));
  test::add_point_light(scene, {0.3f, 0.4f, 0.6f}, 1);
  finalize(scene);
  const Traced t = traced(scene, 3);
  EXPECT_EQ(t.photons.size(), 0u);
  // As many paths are aimed at the mirrors.
  EXPECT_EQ(t.counters[kTooLongEvent] + t.counters[kEscapedEvent], 6u)
      << "a path neither ended nor was counted";
}

TEST(TraceExtremes, ThousandLightsOfManyPowers) {
  test::AnalyticScene s = test::uniform_box(0.5f, 100);
  double total = 100;
  for (int i = 0; i < 1000; ++i) {
    const float cd = std::pow(10.0f, static_cast<float>(i % 13) - 12);
    test::add_point_light(s.scene, {0.5f, 0.5f, 0.5f}, cd);
    total += 4 * std::numbers::pi * double(cd);
  }
  finalize(s.scene);
  const Traced t = traced(s.scene, 50'000);
  expect_finite(t);
  EXPECT_NEAR(double(t.totals.emitted_flux_lm.x), total, 0.02 * total);
}

TEST(TraceExtremes, GrazingLightStaysOnItsSide) {
  // A lamp a hair above a plate of a hundred metres: nothing may land below, and no flux is lost.
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "grey", 0));
  test::add_quad(scene, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
  test::add_point_light(scene, {0, 1e-4f, 0}, 1);
  finalize(scene);
  const Traced t = traced(scene, 100'000);
  expect_finite(t);
  for (const std::uint32_t n : t.photons.normal) ASSERT_GT(decode_octahedral(n).y, 0.99f);
  EXPECT_NEAR(static_cast<double>(t.photons.size()), 50'000, 4.8 * std::sqrt(25'000.0));
}

TEST(TraceExtremes, InfinitePowerIsRefused) {
  test::AnalyticScene s = test::uniform_box(0.5f, 100);
  s.scene.light[0].intensity = Rgb(kInfinity);
  s.scene.light[0].flux_lm = Rgb(kInfinity);
  EXPECT_THROW(traced(s.scene, 100), Error);
}

TEST(TraceExtremes, OnePath) {
  const Traced t = traced(test::uniform_box(0.5f, 100).scene, 1);
  ASSERT_GE(t.photons.size(), 1u);
  EXPECT_NEAR(t.photons.flux[0].x, 100, 1e-3);
}

}  // namespace
}  // namespace phos
