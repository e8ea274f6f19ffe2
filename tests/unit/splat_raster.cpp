// The plane above a record: what its pixels stand for, and that what they show is what rays find.
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "estimate/hemisphere/hemisphere.h"
#include "splat/raster/hemisphere_raster.h"
#include "splat/raster/raster_plane.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

double sum_of(const RasterPlane& plane) {
  double sum = 0;
  for (const float sr : plane.projected_sr) sum += static_cast<double>(sr);
  return sum;
}

TEST(RasterPlane, PixelsAddUpToTheHemisphere) {
  const double share = 4 * corner_form_factor_parallel(kPlaneHalfSide, kPlaneHalfSide, 1);
  for (const int side : {1, 2, 3, 16, 64, 257}) {
    EXPECT_NEAR(raster_plane(side, RasterBorder::none).covered, share, 1e-12);
    EXPECT_NEAR(sum_of(raster_plane(side, RasterBorder::none)), share * M_PI, 1e-5) << side;
    EXPECT_NEAR(sum_of(raster_plane(side, RasterBorder::coverage)), M_PI, 1e-5) << side;
    EXPECT_NEAR(sum_of(raster_plane(side, RasterBorder::stretch)), M_PI, 1e-5) << side;
  }
}

/// A pixel of side d at direction w subtends cos^4 d^2 of projected solid angle, nearly.
TEST(RasterPlane, SmallPixelsHaveTheirDifferentialSize) {
  constexpr int kSide = 400;
  const RasterPlane plane = raster_plane(kSide, RasterBorder::none);
  const double area = 4 * kPlaneHalfSide * kPlaneHalfSide / kSide / kSide;
  for (std::size_t i = 0; i < plane.direction.size(); i += 37) {
    const double z = static_cast<double>(plane.direction[i].z);
    ASSERT_NEAR(static_cast<double>(plane.projected_sr[i]), area * z * z * z * z, 1e-4 * area);
    ASSERT_NEAR(static_cast<double>(glm::length(plane.direction[i])), 1, 1e-6);
  }
}

/// Only border pixels grow, alike on every side, and each takes what lies beyond it: the share of a wedge of
/// azimuth beyond the edge of the plane, integrated here step by step.
TEST(RasterPlane, BordersReachDownToTheHorizon) {
  constexpr int kSide = 8;
  const RasterPlane none = raster_plane(kSide, RasterBorder::none);
  const RasterPlane stretch = raster_plane(kSide, RasterBorder::stretch);
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const auto i = static_cast<std::size_t>(row * kSide + column);
      const double more =
          static_cast<double>(stretch.projected_sr[i]) - static_cast<double>(none.projected_sr[i]);
      const bool corner = (row == 0 || row == kSide - 1) && (column == 0 || column == kSide - 1);
      if (row != 0 && row != kSide - 1 && column != 0 && column != kSide - 1) {
        EXPECT_EQ(more, 0);
        continue;
      }
      const int along = column == 0 || column == kSide - 1 ? row : column;
      const double y0 = kPlaneHalfSide * (2.0 * along / kSide - 1), y1 = y0 + 2 * kPlaneHalfSide / kSide;
      double expected = 0;
      constexpr int kSteps = 2000;
      const double from = std::atan(y0 / kPlaneHalfSide),
                   step = (std::atan(y1 / kPlaneHalfSide) - from) / kSteps;
      for (int k = 0; k < kSteps; ++k) {
        const double edge = kPlaneHalfSide / std::cos(from + (k + 0.5) * step);
        expected += step * 0.5 / (1 + edge * edge);  // int cos sin dtheta from atan(edge) to the horizon
      }
      EXPECT_NEAR(more, corner ? 2 * expected : expected, 1e-6) << row << ", " << column;
    }
  }
}

RecordOptions raster_options(const Scene& scene, std::int64_t side) {
  RecordOptions options;
  options.estimate = Estimate::raster;
  options.raster_side = side;
  options.gather_bounces = 1;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

/// Drawing and tracing see the same, but where a pixel's centre falls on an edge.
void expect_sees_what_rays_find(const Scene& scene, const std::vector<RecordSite>& sites) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RasterEstimator estimator(rays, lights, {}, raster_options(scene, 48), 1);
  const auto worker = estimator.make_worker();
  Hemisphere h;
  std::size_t pixels = 0, differ = 0;
  for (const RecordSite& site : sites) {
    estimator.sample(site, h, *worker);
    const SurfacePoint from = receiver(scene, site.position, site.normal);
    for (std::size_t i = 0; i < h.size(); ++i) {
      Hit hit;
      rays.intersect({from.leave(site.normal), h.direction[i]}, hit);
      ++pixels;
      ASSERT_GT(glm::dot(h.direction[i], site.normal), 0.3f);
      const bool same = hit.distance_m == h.distance_m[i] ||
                        std::fabs(hit.distance_m - h.distance_m[i]) < 1e-3f * hit.distance_m;
      differ += !same;
    }
  }
  EXPECT_LT(static_cast<double>(differ), 0.003 * static_cast<double>(pixels));
}

TEST(RasterEstimator, SeesWhatRaysFind) {
  const Scene scene = cornell();
  const Vec3 lo = scene.bounds.lo, size = scene.bounds.size();
  expect_sees_what_rays_find(scene, {{lo + size * Vec3(0.3f, 0, 0.7f), {0, 1, 0}, 1},
                                     {lo + size * Vec3(0.5f, 0.999f, 0.2f), {0, -1, 0}, 2},
                                     {lo + size * Vec3(0.002f, 0.5f, 0.5f), {1, 0, 0}, 3}});
}

/// Scale changes nothing; nor do walls that all but touch the record.
TEST(RasterEstimator, SeesAtEverySizeAndInCorners) {
  for (const float size : {1e-6f, 1.f, 1e6f}) {
    const AnalyticScene s = scaled(furnace(0.5f), size);
    std::vector<RecordSite> sites;
    for (const Check& check : s.checks) sites.push_back({check.position, check.normal, sites.size()});
    const Vec3 lo = s.scene.bounds.lo;
    for (const float off : {1e-2f, 1e-4f, 1e-5f})
      sites.push_back({lo + size * Vec3(off, 0, off), {0, 1, 0}, 9});
    expect_sees_what_rays_find(s.scene, sites);
  }
}

TEST(RasterEstimator, SameRecordAgain) {
  const AnalyticScene s = furnace(0.5f);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const RecordOptions options = raster_options(s.scene, 32);
  const RecordSite site{s.checks[0].position, s.checks[0].normal, 5};
  Rgb value[2];
  for (Rgb& v : value) {
    const RasterEstimator estimator(rays, lights, {}, options, 3);
    EXPECT_TRUE(estimator.one_thread());
    const auto worker = estimator.make_worker();
    v = estimator.make(site, *worker).record.irradiance;
  }
  EXPECT_EQ(value[0], value[1]);
}

}  // namespace
}  // namespace phos::test
