// Light through sheets that scatter it: gathered records, records from photons and shading, against closed
// forms.
#include <gtest/gtest.h>

#include "estimate/shading.h"
#include "place/two_level.h"
#include "record/tree.h"
#include "support/gathered.h"
#include "support/opal.h"
#include "support/records.h"

namespace phos::test {
namespace {

TEST(Opal, GatheredRaysSeeTheLightBehind) {
  const OpalUnderALamp opal;
  Gathered gathered(opal.scene);
  const RecordOptions options = gather_options(opal.scene, Quantity::indirect, -1, 1024);
  for (const float x : {0.f, 0.5f, 0.9f}) {
    const double truth = OpalUnderALamp::floor_lx(static_cast<double>(x));
    const Trial t = gathered.trial({x, 0, 0}, {0, 1, 0}, options, {}, truth, 50);
    EXPECT_NEAR(t.mean, truth, 4 * t.stderr_of_mean + 0.002 * truth) << x;
  }
}

TEST(Opal, GatheredRaysInAFurnace) {
  const OpalFurnace furnace;
  Gathered gathered(furnace.scene);
  const RecordOptions options = gather_options(furnace.scene, Quantity::all, -1, 512);
  // What the sheet receives of itself is nothing: its sides see walls alone.
  const RecordTree dark = uniform_tree({-1, 0, -1}, {1, 2, 1}, 0);
  for (const Check& c : OpalFurnace::places()) {
    const Trial t =
        gathered.trial(c.position, c.normal, options, {.indirect = &dark}, OpalFurnace::kIrradiance_lx, 100);
    EXPECT_NEAR(t.mean, OpalFurnace::kIrradiance_lx,
                4 * t.stderr_of_mean + 0.002 * OpalFurnace::kIrradiance_lx)
        << c.position.y << ' ' << c.normal.y;
  }
}

/// The lit floor below does not shine on the sheet's upper side, which gets nothing but the lamp's light:
/// what the floor sends up goes through and is gone.
TEST(Opal, TheFloorDoesNotLightTheOtherSide) {
  const OpalUnderALamp opal(0, 0.9f);
  const Lit lit = light_up(opal.scene, 400'000, 1);
  Gathered gathered(opal.scene);
  const RecordOptions options = gather_options(opal.scene, Quantity::indirect, -1, 512);
  const CoarseLevel coarse(*lit.rays, lit.photons, options, 1);
  const double truth = OpalUnderALamp::floor_lx(0);
  const Trial t = gathered.trial({0, 0, 0}, {0, 1, 0}, options, coarse.source(), truth, 30);
  EXPECT_NEAR(t.mean, truth, 4 * t.stderr_of_mean + 0.01 * truth);
}

TEST(Opal, PhotonsPass) {
  const OpalUnderALamp opal;
  const Lit lit = light_up(opal.scene, 2'000'000, 1);
  RecordOptions options;
  options.resolve(opal.scene.bounds.diagonal_m() / 4);
  options.max_radius_m = 0.2;
  const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
  for (const float x : {0.f, 0.5f}) {
    const double truth = OpalUnderALamp::floor_lx(static_cast<double>(x));
    const IrradianceRecord r = record_at(maker, {x, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(double(r.irradiance.y), truth, 3 * double(r.stderr_lx.y) + 0.01 * truth) << x;
  }
}

/// Seen from below, and seen from above, where it reflects.
TEST(Opal, IsShadedByTheLightOnBothSides) {
  const OpalUnderALamp opal(0.3f);
  const RayScene rays(opal.scene);
  const Luminaires lights(opal.scene);
  RecordTree records(opal.scene.bounds, 0.2);
  IrradianceRecord r;
  r.position = {0.3f, OpalUnderALamp::kHeight, 0}, r.normal = {0, 1, 0};
  r.irradiance = Rgb(40), r.distance_m = r.radius_m = 100;
  records.insert(r);
  r.normal = {0, -1, 0}, r.irradiance = Rgb(7);
  records.insert(r);
  const Shading shading(rays, lights, records, {});
  const double straight_lx = point_over_plane_lx(1000, 1, 0.3);
  for (const bool below : {true, false}) {
    const Vec3 wo = glm::normalize(Vec3(0.2f, below ? -1 : 1, 0.1f));
    SurfacePoint point;
    ASSERT_TRUE(trace(rays, {Vec3(0.3f, OpalUnderALamp::kHeight, 0) + 0.2f * wo, -wo}, point));
    RandomStream random(1, Stage::test, 1);
    ShadingLog log;
    const double seen = static_cast<double>(shading.outgoing(point, wo, 0, Rgb(1), 1, random, log).y);
    const double above_lx = straight_lx + 40, below_lx = 7;
    const double truth =
        (below ? 0.3 * below_lx + 0.5 * above_lx : 0.3 * above_lx + 0.5 * below_lx) / std::numbers::pi;
    EXPECT_NEAR(seen, truth, 1e-3 * truth) << below;
    EXPECT_TRUE(log.misses.empty());
  }
}

}  // namespace
}  // namespace phos::test
