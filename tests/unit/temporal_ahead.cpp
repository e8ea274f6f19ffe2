#include "temporal/ahead.h"

#include <gtest/gtest.h>

#include "estimate/density.h"
#include "estimate/gather.h"
#include "estimate/radiance_gather.h"
#include "photon/trace.h"
#include "support/moving_rooms.h"
#include "support/two_frames.h"
#include "temporal/change.h"

namespace phos {
namespace {

using test::Mover;

const RecordSite kOnPlatform{{2.1f, 0.2f, 2.1f}, {0, 1, 0}, 3};
const RecordSite kOnWall{{4, 1.3f, 2.2f}, {-1, 0, 0}, 4};

struct Room : test::TwoFrames {
  explicit Room(Mover mover, float scale = 1)
      : TwoFrames(test::moving_room(mover, 0, scale), test::moving_room(mover, 1, scale)) {}

  RecordOptions options(Quantity paths = Quantity::indirect) const {
    return test::gather_options(scene[0], paths, 1, 256);
  }
  Made make(const Estimator& now, const Estimator& next, const RecordSite& site,
            const AheadOptions& ahead = {}, Quantity paths = Quantity::indirect) const {
    const AheadEstimator estimator({now, rays[0], lights[0]}, {next, rays[1], lights[1]}, change,
                                   options(paths), 1, ahead);
    const auto worker = estimator.make_worker();
    const Made made = estimator.make(site, *worker);
    counted = worker->counters["records traced one frame ahead"];
    return made;
  }
  Made gathered(const RecordSite& site, const AheadOptions& ahead = {},
                Quantity paths = Quantity::indirect) const {
    const GatherEstimator now(rays[0], lights[0], {}, options(paths), 1),
        next(rays[1], lights[1], {}, options(paths), 1);
    return make(now, next, site, ahead, paths);
  }
  mutable std::uint64_t counted = 0;
};

void expect_same(const IrradianceRecord& a, const IrradianceRecord& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.irradiance, b.irradiance);
  EXPECT_EQ(a.stderr_lx, b.stderr_lx);
  EXPECT_EQ(a.radius_m, b.radius_m);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(a.rotation_gradient[c], b.rotation_gradient[c]);
    EXPECT_EQ(a.translation_gradient[c], b.translation_gradient[c]);
  }
}

Made alone(const Estimator& estimator, const RecordSite& site) {
  const auto worker = estimator.make_worker();
  return estimator.make(site, *worker);
}

/// Looking ahead changes no record, and where nothing changes the one ahead is the same bit for bit: also
/// where something moves that no light comes by.
TEST(Ahead, IsTheRecordWhereNothingChanges) {
  for (const Mover mover : {Mover::nothing, Mover::elsewhere}) {
    const Room room(mover);
    EXPECT_EQ(room.change.light(), mover == Mover::elsewhere);
    for (const RecordSite& site : {kOnPlatform, kOnWall}) {
      for (const LookAhead look : {LookAhead::reproject, LookAhead::trace}) {
        for (const Quantity paths : {Quantity::indirect, Quantity::all}) {
          const Made made = room.gathered(site, {.look = look}, paths);
          ASSERT_TRUE(made.ahead) << name_of(mover);
          expect_same(made.record, made.ahead->record);
          EXPECT_EQ(change_rate(made.record.irradiance, made.ahead->record.irradiance, 1e-3), 0);
          EXPECT_EQ(made.ahead->holes, 0);
          const GatherEstimator now(room.rays[0], room.lights[0], {}, room.options(paths), 1);
          expect_same(made.record, alone(now, site).record);
        }
      }
    }
  }
}

TEST(Ahead, NoneLooksNowhere) {
  const Room room(Mover::lamp);
  EXPECT_FALSE(room.gathered(kOnWall, {.look = LookAhead::none}).ahead);
}

/// Light that dims to 0.8 dims every record to that, and nothing is left to chance: the same samples are
/// taken twice.
TEST(Ahead, DimmedLampDimsAll) {
  const Room room(Mover::dimmer);
  for (const Quantity paths : {Quantity::indirect, Quantity::all}) {
    const Made made = room.gathered(kOnWall, {.share = 1}, paths);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(made.ahead->record.irradiance[c], 0.8f * made.record.irradiance[c],
                  1e-5f * made.record.irradiance[c]);
    }
  }
}

TEST(Ahead, MovesWithItsSurface) {
  const Room room(Mover::floor);
  const Made made = room.gathered(kOnPlatform, {.look = LookAhead::trace});
  ASSERT_TRUE(made.ahead);
  const IrradianceRecord& r = made.ahead->record;
  const Vec3 rise(0.05f, 0.1f + 0.5f * 0.08f, 0);  // it lies in the middle of the platform, which tilts
  EXPECT_NEAR(glm::length(r.position - (kOnPlatform.position + rise)), 0, 1e-5f);
  EXPECT_NEAR(glm::length(r.normal - glm::normalize(Vec3(-0.08f, 1.2f, 0))), 0, 1e-5f);
  const GatherEstimator next(room.rays[1], room.lights[1], {}, room.options(), 1);
  expect_same(r, alone(next, {r.position, r.normal, kOnPlatform.item}).record);
}

/// Where more than a share comes to light, the next frame is traced.
TEST(Ahead, TracesWhereTooMuchCameToLight) {
  const Room room(Mover::wall);
  const RecordSite beside{{0.8f, 0, 2}, {0, 1, 0}, 5};
  const Made patient = room.gathered(beside, {.most_holes = 1});
  EXPECT_EQ(room.counted, 0u);
  EXPECT_GT(patient.ahead->holes, 0);
  const Made traced = room.gathered(beside, {.most_holes = 0});
  EXPECT_EQ(room.counted, 1u);
  EXPECT_EQ(traced.ahead->holes, patient.ahead->holes);
  const GatherEstimator next(room.rays[1], room.lights[1], {}, room.options(), 1);
  expect_same(traced.ahead->record, alone(next, beside).record);
}

/// Several passes are all looked at.
TEST(Ahead, OfRaysUntilAnError) {
  const Room room(Mover::dimmer);
  RecordOptions options = room.options();
  options.error = 0.01, options.rays = 4096;
  const GatherEstimator now(room.rays[0], room.lights[0], {}, options, 1),
      next(room.rays[1], room.lights[1], {}, options, 1);
  const Made made = room.make(now, next, kOnWall, {.share = 1});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(made.ahead->record.irradiance[c], 0.8f * made.record.irradiance[c],
                1e-5f * made.record.irradiance[c]);
  }
}

TEST(Ahead, OfRadianceRecords) {
  for (const Mover mover : {Mover::elsewhere, Mover::dimmer, Mover::floor}) {
    const Room room(mover);
    const RadianceEstimator now(room.rays[0], room.lights[0], {}, room.options(), 5, RadianceGradient::hybrid,
                                1),
        next(room.rays[1], room.lights[1], {}, room.options(), 5, RadianceGradient::hybrid, 1);
    for (const LookAhead look : {LookAhead::reproject, LookAhead::trace}) {
      const Made made = room.make(now, next, kOnPlatform, {.look = look, .share = 1, .most_holes = 1});
      ASSERT_TRUE(made.ahead && made.ahead->radiance);
      const RadianceRecord &a = *made.radiance, &b = *made.ahead->radiance;
      EXPECT_EQ(b.order(), 5);
      if (mover == Mover::floor) {
        EXPECT_EQ(b.position, made.ahead->record.position);
        EXPECT_NEAR(glm::length(b.frame.z - glm::normalize(Vec3(-0.08f, 1.2f, 0))), 0, 1e-5f);
        continue;
      }
      const float factor = mover == Mover::dimmer ? 0.8f : 1;
      for (std::size_t i = 0; i < a.light.size(); ++i)
        EXPECT_NEAR(b.light[i], factor * a.light[i], 2e-5f * std::fabs(a.light[0]));
      if (mover == Mover::elsewhere) {
        EXPECT_EQ(a.light, b.light);
        EXPECT_EQ(a.gradient_x, b.gradient_x);
      }
    }
  }
}

/// Estimators of no hemisphere are asked again: photons of the same paths.
TEST(Ahead, OfPhotons) {
  const Room room(Mover::floor);
  RecordOptions options;
  options.resolve(room.scene[0].bounds.diagonal_m() / 4);
  Counters counters;
  const auto photons_of = [&](const RayScene& rays) {
    PhotonOptions few;
    few.paths = 20000;
    PhotonTotals totals;
    Photons traced = trace_photons(rays, few, 7, totals, counters);
    return PhotonMap::build(std::move(traced), totals);
  };
  const PhotonMap photons[] = {photons_of(room.rays[0]), photons_of(room.rays[1])};
  const DensityEstimator now(photons[0], room.rays[0], options, 1),
      next(photons[1], room.rays[1], options, 1);
  const Made made = room.make(now, next, kOnPlatform);
  ASSERT_TRUE(made.ahead);
  expect_same(made.record, alone(now, kOnPlatform).record);
  const IrradianceRecord& r = made.ahead->record;
  EXPECT_GT(r.position.y, kOnPlatform.position.y + 0.05f);
  expect_same(r, alone(next, {r.position, r.normal, kOnPlatform.item}).record);
}

/// The same in millimetres and in kilometres.
TEST(Ahead, KnowsNoScale) {
  const auto ahead_at = [](Mover mover, float scale) {
    const Room room(mover, scale);
    RecordSite site = kOnPlatform;
    site.position *= scale;
    return room.gathered(site);
  };
  for (const Mover mover : {Mover::lamp, Mover::occluder, Mover::wall, Mover::floor}) {
    const Made one = ahead_at(mover, 1);
    for (const float scale : {1e-6f, 1e6f}) {
      const Made other = ahead_at(mover, scale);
      ASSERT_TRUE(other.ahead);
      EXPECT_NEAR(other.record.irradiance.y, one.record.irradiance.y, 0.02f * one.record.irradiance.y);
      EXPECT_NEAR(other.ahead->record.irradiance.y, one.ahead->record.irradiance.y,
                  0.02f * one.ahead->record.irradiance.y)
          << name_of(mover) << " " << scale;
    }
  }
}

}  // namespace
}  // namespace phos
