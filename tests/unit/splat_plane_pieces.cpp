// The pieces of the hemisphere that pixels stand for: their solid angles, what becomes of even light, and
// gradients from the borders between pixels.
#include <gtest/gtest.h>

#include "hsh/basis.h"
#include "splat/raster/plane_pieces.h"
#include "support/radiance_scenes.h"

namespace phos::test {
namespace {

const double kEven = std::sqrt(2 * std::numbers::pi);  // c_00 of radiance 1 in every direction

TEST(PlanePieces, AddUpToTheHemisphere) {
  // The pyramid of half openings a, a: 4 asin(sin^2 a).
  const double share = 2 / std::numbers::pi * std::asin(0.8);
  for (const int side : {1, 3, 8, 64}) {
    for (const RasterBorder border : {RasterBorder::none, RasterBorder::coverage, RasterBorder::stretch}) {
      const PlanePieces pieces = plane_pieces(side, border, 5);
      EXPECT_NEAR(pieces.covered, share, 1e-12);
      double sum = 0;
      for (const float sr : pieces.solid_sr) sum += static_cast<double>(sr);
      EXPECT_NEAR(sum / (2 * std::numbers::pi), border == RasterBorder::none ? share : 1, 1e-6) << side;
    }
  }
}

/// The pixels of a plane as `look` shows them, with the pieces' light.
Hemisphere spread_of(const PlanePieces& pieces, const RasterPlane& plane,
                     const std::function<Seen(const DVec3&)>& look) {
  Hemisphere seen, whole;
  seen.resize(plane.direction.size());
  seen.direction = plane.direction, seen.projected_sr = plane.projected_sr;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Seen s = look(DVec3(seen.direction[i]));
    seen.radiance[i] = Rgb(static_cast<float>(s.luminance));
    seen.distance_m[i] = static_cast<float>(s.distance);
    seen.hit_normal[i] = std::isinf(s.distance) ? -seen.direction[i] : Vec3(s.normal);
  }
  pieces.spread(seen, whole);
  return whole;
}

/// The same light from everywhere: the first coefficient, and no other. Not so without the stretched border,
/// where light is missing, or comes from too high.
TEST(PlanePieces, EvenLightIsOneCoefficient) {
  const auto even = [](const DVec3& w) { return Seen{1, -w, 1}; };
  for (const int side : {8, 33, 64}) {
    for (const int order : {3, 6, 10}) {
      RadianceProjector projector(order);
      const auto project = [&](RasterBorder border) {
        const Hemisphere h = spread_of(plane_pieces(side, border, order), raster_plane(side, border), even);
        return channel(projector.project(h, RadianceGradient::none, 0).light);
      };
      std::vector<double> stretched = project(RasterBorder::stretch),
                          shared = project(RasterBorder::coverage), cut = project(RasterBorder::none);
      EXPECT_NEAR(stretched[0], kEven, 1e-5 * kEven);
      EXPECT_NEAR(shared[0], kEven, 1e-5 * kEven);
      EXPECT_NEAR(cut[0], 2 / std::numbers::pi * std::asin(0.8) * kEven, 1e-5 * kEven);
      stretched[0] = shared[0] = 0;
      EXPECT_LT(norm(stretched), 0.004 * kEven) << side << ", order " << order;
      EXPECT_GT(norm(shared), 0.3 * kEven) << side << ", order " << order;
    }
  }
}

/// A piece below the edge shows the surface that its pixel shows, turned towards the place as much.
TEST(PlanePieces, SurfacesBelowTheEdgeFaceThePlaceAsMuch) {
  const PlanePieces pieces = plane_pieces(16, RasterBorder::stretch, 8);
  const RasterPlane plane = raster_plane(16, RasterBorder::stretch);
  const Vec3 normal = glm::normalize(Vec3(0.3f, -0.2f, -1));
  const Hemisphere whole = spread_of(pieces, plane, [&](const DVec3&) { return Seen{2, DVec3(normal), 1}; });
  std::size_t below = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 own = plane.direction[pieces.pixel[i]], w = whole.direction[i];
    ASSERT_NEAR(glm::length(w), 1, 1e-5f);
    ASSERT_GT(w.z, 0);
    if (std::max(std::fabs(w.x), std::fabs(w.y)) < 2 * w.z) continue;
    ++below;
    ASSERT_LT(w.z, own.z);
    EXPECT_NEAR(glm::dot(whole.hit_normal[i], w), glm::dot(normal, own), 1e-5f);
    EXPECT_NEAR(glm::length(whole.hit_normal[i]), 1, 1e-5f);
    // Of the same azimuth, within half a pixel and the corner's.
    EXPECT_GT(glm::dot(glm::normalize(Vec2(w)), glm::normalize(Vec2(own))), 0.99f);
  }
  EXPECT_EQ(below, 4u * 16u * 4u * 6u);  // sides, pixels, cuts, heights
}

/// A dark plate before a lamp overhead, both within the plane's view: hybrid gradients follow the edge that
/// moves, against differences of the light that displaced places see.
TEST(PlanePieces, GradientsSeeEdgesMove) {
  constexpr int kOrder = 5, kSide = 128;
  const GradientScene scene = gradient_scene("rect_occluded");
  const auto look = [&](const DVec3& w) {
    Seen s;
    scene.trace(w, s.distance, s.luminance, s.normal);
    return s;
  };
  const PlanePieces pieces = plane_pieces(kSide, RasterBorder::stretch, kOrder);
  const Hemisphere h = spread_of(pieces, raster_plane(kSide, RasterBorder::stretch), look);
  RadianceProjector projector(kOrder);
  const RadianceRecord hybrid = projector.project(h, RadianceGradient::hybrid, 0, pieces.borders),
                       analytic = projector.project(h, RadianceGradient::analytic, 0, pieces.borders);
  const std::vector<double> truth = coefficients(scene, DVec3(0), kOrder);
  EXPECT_LT(distance(channel(hybrid.light), truth), 0.03 * norm(truth));
  for (const int axis : {0, 1}) {
    const auto at = [&](const DVec3& p) { return coefficients(scene, p, kOrder); };
    const std::vector<double> slope = slope_along(axis, 0.01, at);
    const auto off = [&](const RadianceRecord& r) {
      return distance(channel(axis == 0 ? r.gradient_x : r.gradient_y), slope) / norm(slope);
    };
    RecordProperty("hybrid" + std::to_string(axis), std::to_string(off(hybrid)));
    EXPECT_LT(off(hybrid), 0.1) << axis;
    EXPECT_GT(off(analytic), 3 * off(hybrid)) << axis;
  }
}

}  // namespace
}  // namespace phos::test
