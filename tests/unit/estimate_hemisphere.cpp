#include "core/float_traps.h"
#include "estimate/hemisphere/hemisphere.h"

#include <gtest/gtest.h>

#include "estimate/hemisphere/ray_gradients.h"
#include "support/gradient_scenes.h"
#include "support/scenes.h"

namespace phos {
namespace {

using test::DVec2;

RandomStream numbers(std::uint64_t item) { return {21, Stage::test, item}; }

Hemisphere seen(const std::string& scene, int rings, std::uint64_t item = 0, const Frame& frame = {}) {
  RandomStream random = numbers(item);
  return test::seen_by_rays(test::gradient_scene(scene), rings, slices_for(rings), random, frame);
}

constexpr GradientMode kRayModes[] = {GradientMode::analytic, GradientMode::hybrid,
                                      GradientMode::ward_heckbert, GradientMode::krivanek};

TEST(Hemisphere, RingsAreAsManyAsTheRaysAllow) {
  EXPECT_EQ(slices_for(1), 3);
  EXPECT_EQ(slices_for(8), 25);
  EXPECT_EQ(slices_for(16), 50);
  EXPECT_EQ(rings_for(0), 1);
  EXPECT_EQ(rings_for(1), 1);
  EXPECT_EQ(rings_for(200), 8);
  EXPECT_EQ(rings_for(199), 7);
  EXPECT_EQ(rings_for(800), 16);
  for (std::int64_t rays = 3; rays < 20000; rays += 7) {
    const int m = rings_for(rays);
    EXPECT_LE(m * slices_for(m), rays);
    EXPECT_GT((m + 1) * slices_for(m + 1), rays);
  }
}

/// The corner formulas of the other tests and Lambert's formula are independent.
TEST(Hemisphere, ClosedFormsOfRectanglesAgree) {
  const test::Rectangle ceiling = test::gradient_scene("rect_ceiling").rectangles[0],
                        wall = test::gradient_scene("rect_wall_x1").rectangles[0];
  const auto parallel = [](double a, double b) { return test::corner_form_factor_parallel(a, b, 2); };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(test::rectangle_lx(ceiling, ceiling.lo, ceiling.hi, DVec3(0), {0, 0, 1}),
              pi * (parallel(1.5, 1) - parallel(1.5, -1) - parallel(-0.5, 1) + parallel(-0.5, -1)), 1e-12);
  EXPECT_NEAR(test::rectangle_lx(wall, wall.lo, wall.hi, DVec3(0), {0, 0, 1}),
              pi * (test::corner_form_factor_perpendicular(2, 2, 1) -
                    test::corner_form_factor_perpendicular(-1, 2, 1)),
              1e-12);
  EXPECT_NEAR(test::gradient_scene("white_furnace").irradiance_lx(DVec3(0)), pi, 1e-12);
}

TEST(Hemisphere, IrradianceIsExactUnderAnEvenSky) {
  for (const int rings : {1, 2, 8, 31}) {
    Hemisphere h = seen("white_furnace", rings);
    for (Rgb& light : h.radiance) light = Rgb(1, 2, 1e12f);
    const Rgb e = irradiance_of(h);
    EXPECT_NEAR(e.x, kPi, 1e-6f * kPi);
    EXPECT_NEAR(e.y, 2 * kPi, 2e-6f * kPi);
    EXPECT_NEAR(e.z / 1e12f, kPi, 1e-6f * kPi);
    EXPECT_EQ(standard_error_of(h), Rgb(0));
  }
}

/// Light that grows by a part that depends on the ring and one that depends on the slice differs between
/// strata, but not within them: only the first and the last ring see a kink.
TEST(Hemisphere, ErrorHoldsNoEvenVariationFromCellToCell) {
  Hemisphere h = seen("white_furnace", 16);
  for (int j = 0; j < h.rings; ++j)
    for (int k = 0; k < h.slices; ++k)
      h.radiance[h.at(j, k)] =
          Rgb(static_cast<float>(2 + j / 16.0 + std::cos(2 * std::numbers::pi * k / 50)));
  EXPECT_LT(standard_error_of(h).x, 1e-4f * irradiance_of(h).x);
}

/// Independent noise of variance v in each cell: the variance of the sum is v (pi/n)^2 n.
TEST(Hemisphere, ErrorOfNoiseIsItsSpread) {
  for (const int rings : {1, 2, 3, 8, 16}) {
    double stated = 0;
    const int reps = 400;
    Hemisphere h = seen("white_furnace", rings);
    const auto cells = static_cast<double>(h.size());
    for (int r = 0; r < reps; ++r) {
      RandomStream random = numbers(static_cast<std::uint64_t>(1000 + r));
      for (Rgb& light : h.radiance) light = Rgb(random.uniform());
      stated += std::pow(static_cast<double>(standard_error_of(h).x), 2) / reps;
    }
    const double truth = std::numbers::pi * std::numbers::pi / 12 / cells;
    EXPECT_NEAR(stated / truth, 1, 6 / std::sqrt(reps * cells)) << rings;
  }
}

TEST(Hemisphere, DistancesAreMeansAndLeasts) {
  Hemisphere h = seen("rect_ceiling", 8);
  for (std::size_t i = 0; i < h.size(); ++i)  // within a sphere about the receiver
    h.distance_m[i] = 3;
  EXPECT_FLOAT_EQ(harmonic_distance_m(h), 3);
  EXPECT_FLOAT_EQ(least_distance_m(h), 3);
  for (int k = 0; k < h.slices; ++k) h.distance_m[h.at(7, k)] = kInfinity;
  EXPECT_NEAR(harmonic_distance_m(h), 3 * 8 / 7.f, 1e-5f);  // an eighth of the light's weight escapes
  std::fill(h.distance_m.begin(), h.distance_m.end(), kInfinity);
  EXPECT_EQ(harmonic_distance_m(h), kInfinity);
  EXPECT_EQ(least_distance_m(h), kInfinity);
  // A ray along the ground says nothing of the least distance.
  h.direction[0] = normalized_or_zero({1, 0, 0.17f}), h.distance_m[0] = 1;
  h.direction[1] = normalized_or_zero({1, 0, 0.18f}), h.distance_m[1] = 2;
  EXPECT_FLOAT_EQ(least_distance_m(h), 2);
  h.distance_m[2] = 0;
  EXPECT_EQ(harmonic_distance_m(h), 0);
}

TEST(RayGradients, AreNoneInAnEvenSky) {
  const Hemisphere h = seen("white_furnace", 16);
  const Gradients g = ray_gradients(h, GradientMode::ward_heckbert, 1e-3f);
  EXPECT_EQ(g.translation[0], Vec3(0));
  EXPECT_LT(glm::length(g.rotation[0]), 1e-6f);
  const Gradients none = ray_gradients(h, GradientMode::none, 1e-3f);
  EXPECT_EQ(none.translation[1], Vec3(0));
  EXPECT_EQ(none.rotation[1], Vec3(0));
}

/// With nothing in the way, the far edge of light and the near one are one: both forms are the same sum.
TEST(RayGradients, HybridIsAnalyticWhereNothingOccludes) {
  for (const char* scene : {"rect_ceiling", "closed_box_5L", "white_furnace"}) {
    const Hemisphere h = seen(scene, 16);
    const Gradients a = ray_gradients(h, GradientMode::analytic, 1e-3f),
                    b = ray_gradients(h, GradientMode::hybrid, 1e-3f);
    EXPECT_EQ(a.translation[0], b.translation[0]) << scene;
  }
  const Hemisphere h = seen("rect_occluded", 16);
  const Gradients a = ray_gradients(h, GradientMode::analytic, 1e-3f),
                  b = ray_gradients(h, GradientMode::hybrid, 1e-3f);
  EXPECT_GT(glm::length(a.translation[0] - b.translation[0]), 0.2f);
}

/// A black leaf before a sky infinitely far takes away what it would give if it were as bright as the sky.
TEST(RayGradients, HybridSeesALeafBeforeTheSky) {
  test::GradientScene scene{"leaf", {{2, 1, {0.2, -0.6}, {1.2, 0.3}, 1}}, {}, false, {}};
  const DVec2 shade = -scene.translation();
  test::Spread spread;
  for (std::uint64_t r = 0; r < 60; ++r) {
    RandomStream random = numbers(300 + r);
    Hemisphere h = test::seen_by_rays(scene, 16, 50, random);
    for (std::size_t i = 0; i < h.size(); ++i) h.radiance[i] = Rgb(std::isinf(h.distance_m[i]) ? 1.f : 0.f);
    const Gradients g = ray_gradients(h, GradientMode::hybrid, 1e-3f);
    spread.add(DVec2(g.translation[0].x, g.translation[0].y));
  }
  EXPECT_NEAR(spread.mean().x, shade.x, 4 * spread.sd() / std::sqrt(60) + 0.03 * glm::length(shade));
  EXPECT_NEAR(spread.mean().y, shade.y, 4 * spread.sd() / std::sqrt(60) + 0.03 * glm::length(shade));
}

/// Turning cells and frame about the normal turns nothing else; neither does another choice of world axes.
TEST(RayGradients, TurnWithTheWorld) {
  Hemisphere h = seen("closed_box_5L", 16);
  const glm::mat3 turn(glm::rotate(Mat4(1), 1.1f, normalized_or_zero({1, -2, 0.5f})));
  Hemisphere turned = h;
  turned.frame = {turn * h.frame.x, turn * h.frame.y, turn * h.frame.z};
  for (std::size_t i = 0; i < h.size(); ++i)
    turned.direction[i] = turn * h.direction[i], turned.hit_normal[i] = turn * h.hit_normal[i];
  for (const GradientMode mode : kRayModes) {
    const Gradients a = ray_gradients(h, mode, 1e-3f), b = ray_gradients(turned, mode, 1e-3f);
    EXPECT_LT(glm::length(turn * a.translation[0] - b.translation[0]), 2e-5f) << name_of(mode);
    EXPECT_LT(glm::length(turn * a.rotation[0] - b.rotation[0]), 2e-5f) << name_of(mode);
  }
}

/// Lengths times s: translation over s. Light times p: all times p. Each channel by itself.
TEST(RayGradients, ScaleWithLengthAndLight) {
  for (const char* scene : {"rect_occluded", "closed_box_5L", "sphere"}) {
    const Hemisphere h = seen(scene, 8);
    for (const GradientMode mode : kRayModes) {
      const Gradients g = ray_gradients(h, mode, 1e-4f);
      const float size = glm::length(g.translation[0]), turn = glm::length(g.rotation[0]);
      for (const float length : {1e-6f, 1e6f}) {
        Hemisphere other = h;
        for (float& d : other.distance_m) d *= length;
        for (Rgb& light : other.radiance) light *= Rgb(1e12f, 1, 1e-12f);
        const Gradients o = ray_gradients(other, mode, 1e-4f * length);
        const float power[] = {1e12f, 1, 1e-12f};
        for (int c = 0; c < 3; ++c) {
          EXPECT_LT(glm::length(o.translation[c] * length / power[c] - g.translation[c]), 1e-5f * size)
              << scene << " " << name_of(mode) << " " << length;
          EXPECT_LT(glm::length(o.rotation[c] / power[c] - g.rotation[c]), 1e-5f * turn);
        }
      }
    }
  }
}

TEST(RayGradients, AreFiniteWhateverTheRaysSaw) {
  const NoFloatTraps traps;  // without a least distance they are infinite
  const auto expect_finite = [](const Hemisphere& h, const char* what) {
    for (const GradientMode mode : kRayModes) {
      for (const float least : {0.f, 1e-6f}) {
        const Gradients g = ray_gradients(h, mode, least);
        for (int c = 0; c < 3; ++c) {
          EXPECT_TRUE(is_finite(g.rotation[c])) << what << " " << name_of(mode);
          EXPECT_TRUE(least == 0 || is_finite(g.translation[c])) << what << " " << name_of(mode);
          EXPECT_FALSE(std::isnan(g.translation[c].x)) << what << " " << name_of(mode);
        }
      }
    }
  };
  for (const int rings : {1, 2, 8}) {
    Hemisphere h = seen("closed_box_5L", rings);
    h.distance_m[0] = 0;
    expect_finite(h, "starts on a surface");
    h.distance_m[1] = std::numeric_limits<float>::denorm_min();
    expect_finite(h, "nearly");
    h.distance_m[2] = kInfinity, h.hit_normal[2] = -h.direction[2];
    expect_finite(h, "one escapes");
    for (std::size_t i = 0; i < h.size(); ++i) h.hit_normal[i] = h.direction[i];
    expect_finite(h, "wrong side");
    std::fill(h.radiance.begin(), h.radiance.end(), Rgb(0));
    expect_finite(h, "dark");
    h = seen("rect_ceiling", rings);
    std::fill(h.distance_m.begin(), h.distance_m.end(), kInfinity);
    expect_finite(h, "sky");
    for (const GradientMode mode : kRayModes)
      EXPECT_EQ(ray_gradients(h, mode, 1e-3f).translation[0], Vec3(0)) << "infinitely far: " << name_of(mode);
  }
}

/// A set without cells: the same sums, of rays in any order.
TEST(RayGradients, OfAnUnstructuredSetAreTheAnalyticOnes) {
  const Hemisphere h = seen("closed_box_5L", 64);
  Hemisphere loose = h;
  loose.rings = loose.slices = 0;
  std::reverse(loose.direction.begin(), loose.direction.end());
  std::reverse(loose.radiance.begin(), loose.radiance.end());
  std::reverse(loose.distance_m.begin(), loose.distance_m.end());
  std::reverse(loose.hit_normal.begin(), loose.hit_normal.end());
  const Gradients a = ray_gradients(h, GradientMode::analytic, 1e-3f),
                  b = ray_gradients(loose, GradientMode::analytic, 1e-3f);
  EXPECT_LT(glm::length(a.translation[0] - b.translation[0]), 1e-5f);
  EXPECT_LT(glm::length(a.rotation[0] - b.rotation[0]),
            0.02f * glm::length(a.rotation[0]));  // 8 rings, not 64
  EXPECT_EQ(standard_error_of(loose), Rgb(0));
  EXPECT_FLOAT_EQ(irradiance_of(loose).x, irradiance_of(h).x);
  EXPECT_DEATH(ray_gradients(loose, GradientMode::hybrid, 1e-3f), "no cells");
  EXPECT_DEATH(ray_gradients(h, GradientMode::positional, 1e-3f), "not a gradient of rays");
}

TEST(ZoneShape, SecondMomentsOfPolygonsAreExact) {
  // Rectangle a x b about its centre: a^3 b / 12 and a b^3 / 12; a triangle's, by hand.
  const std::vector<Vec2> rectangle{{1, 2}, {4, 2}, {4, 7}, {1, 7}};
  for (const std::vector<std::uint32_t>& order :
       {std::vector<std::uint32_t>{0, 1, 2, 3}, std::vector<std::uint32_t>{2, 1, 0, 3}}) {
    const ZoneShape s = polygon_shape(rectangle, order);
    EXPECT_NEAR(s.centroid_m.x, 2.5, 1e-12);
    EXPECT_NEAR(s.centroid_m.y, 4.5, 1e-12);
    EXPECT_NEAR(s.second_moments_m4[0][0], 27.0 * 5 / 12, 1e-12);
    EXPECT_NEAR(s.second_moments_m4[1][1], 3.0 * 125 / 12, 1e-12);
    EXPECT_NEAR(s.second_moments_m4[0][1], 0, 1e-12);
    EXPECT_NEAR(s.second_moments_m4[1][0], 0, 1e-12);
  }
  // Right triangle with legs b along x, h along y: I = b^3 h / 36, b h^3 / 36, product -b^2 h^2 / 72.
  const std::vector<Vec2> triangle{{0, 0}, {2, 0}, {0, 3}};
  const ZoneShape t = polygon_shape(triangle, std::vector<std::uint32_t>{0, 1, 2});
  EXPECT_NEAR(t.second_moments_m4[0][0], 8.0 * 3 / 36, 1e-12);
  EXPECT_NEAR(t.second_moments_m4[1][1], 2.0 * 27 / 36, 1e-12);
  EXPECT_NEAR(t.second_moments_m4[0][1], -36.0 / 72, 1e-12);
  // A polygon of many sides is a disc.
  std::vector<Vec2> round;
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double phi = 2 * std::numbers::pi * i / 2000;
    round.emplace_back(0.5 + 2 * std::cos(phi), 2 * std::sin(phi)), rows.push_back(i);
  }
  const ZoneShape p = polygon_shape(round, rows), d = disc_shape(2);
  EXPECT_NEAR(p.centroid_m.x, 0.5, 1e-6);
  EXPECT_NEAR(p.second_moments_m4[0][0] / d.second_moments_m4[0][0], 1, 1e-4);
  EXPECT_NEAR(d.second_moments_m4[1][1], std::numbers::pi * 4, 1e-12);
}

/// Lengths times s, light times p: translation times p/s, z2 as it was.
TEST(ZoneShape, ComparisonDoesNotDependOnUnits) {
  const test::PhotonSource source(test::gradient_scene("rect_occluded"), 0.4);
  ZonePhotons zone;
  RandomStream random = numbers(50);
  source.draw(2000, 2000, random, zone);
  const std::vector<std::uint8_t> used(zone.size(), 1);
  const ComparedGradients g = compare_gradients(zone, used, source.area_m2(), Frame(), disc_shape(0.4));
  EXPECT_GT(g.z2, 4);
  for (const double length : {1e-6, 1e6}) {
    for (const double power : {1e-12, 1e12}) {
      ZonePhotons other = zone;
      for (Vec2& x : other.offset_m) x *= static_cast<float>(length);
      for (float& r : other.inverse_distance) r /= static_cast<float>(length);
      for (Rgb& flux : other.flux_lm) flux *= static_cast<float>(power * length * length);
      const ComparedGradients o = compare_gradients(other, used, source.area_m2() * length * length, Frame(),
                                                    disc_shape(0.4 * length));
      EXPECT_NEAR(o.z2, g.z2, 1e-4 * g.z2) << length << " " << power;
      const auto back = static_cast<float>(length / power);
      for (int c = 0; c < 3; ++c) {
        EXPECT_LT(glm::length(o.positional.translation[c] * back - g.positional.translation[c]), 1e-4f);
        EXPECT_LT(glm::length(o.blend.translation[c] * back - g.blend.translation[c]), 1e-4f);
        EXPECT_LT(glm::length(o.analytic.translation[c] * back - g.analytic.translation[c]), 1e-5f);
      }
    }
  }
}

/// No shape, no photon, all on a line: the analytic gradient, and no verdict.
TEST(ZoneShape, WithoutExtentComparesNothing) {
  const std::vector<Vec2> line{{0, 0}, {1, 1}, {3, 3}};
  ZonePhotons zone;
  zone.offset_m = line, zone.flux_lm.assign(3, Rgb(1));
  zone.direction.assign(3, normalized_or_zero({1, 0, 1})), zone.inverse_distance.assign(3, 1.f);
  zone.source_normal.assign(3, normalized_or_zero({-1, 0, -1}));
  const std::vector<std::uint8_t> used(3, 1), unused(3, 0);
  const auto compare = [&](std::span<const std::uint8_t> which, const ZoneShape& shape) {
    const ComparedGradients g = compare_gradients(zone, which, 1, Frame(), shape);
    EXPECT_EQ(g.z2, 0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(g.blend.translation[c], g.analytic.translation[c]);
      EXPECT_EQ(g.positional.translation[c], g.analytic.translation[c]);
      EXPECT_TRUE(is_finite(g.analytic.translation[c]));
    }
  };
  compare(used, polygon_shape(line, std::vector<std::uint32_t>{0, 1, 2}));
  compare(used, polygon_shape(line, std::vector<std::uint32_t>{0, 2}));
  compare(used, polygon_shape({}, {}));
  compare(used, ZoneShape{});
  compare(unused, disc_shape(4));
}

}  // namespace
}  // namespace phos
