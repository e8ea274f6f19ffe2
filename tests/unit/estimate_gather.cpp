#include "estimate/gather.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "direct/direct_light.h"
#include "direct/lamp_sampler.h"
#include "estimate/record_of.h"
#include "place/two_level.h"
#include "record/tree.h"
#include "support/gathered.h"

namespace phos {
namespace {

/// A room with one lamp of each kind.
Scene lamps_of_each_kind(int copies = 1) {
  Scene scene;
  test::begin_instance(scene, "walls", test::add_lambert(scene, "grey", 0.5f));
  test::add_room(scene, Vec3(0), Vec3(4, 3, 4));
  for (int i = 0; i < copies; ++i) {
    const float at = 0.2f * static_cast<float>(i);
    test::add_point_light(scene, {1 + at, 2.5f, 1}, 100);
    Light spot;
    spot.kind = Light::Kind::spot, spot.position = {3, 2.5f, 3 - at}, spot.direction = {0, -1, 0};
    spot.intensity = Rgb(200), spot.cos_inner = 0.95f, spot.cos_outer = 0.6f;
    scene.light.push_back(spot);
    test::begin_instance(scene, "panel", test::add_lambert(scene, "panel", 0, 300));
    test::add_quad(scene, {2, 2.9f - 0.01f * static_cast<float>(i), 0.5f + at}, {0.5f, 0, 0},
                   {0, 0, 0.5f});  // shines down
    Material sheet = scene.material.back();
    sheet.double_sided = true;
    scene.material.push_back(sheet);
    test::begin_instance(scene, "sheet", static_cast<std::uint32_t>(scene.material.size() - 1));
    test::add_triangle(scene, {0.5f, 1, 3 - at}, {1, 1.5f, 3 - at}, {0.5f, 2, 3.2f - at});
  }
  finalize(scene);
  return scene;
}

const Vec3 kPlaces[] = {{1, 0, 1}, {3, 0, 3}, {2.2f, 0, 0.7f}, {0.6f, 0, 2.9f}};

/// One sample of one lamp is on the mean what samples of all lamps are; near and far, few lamps and many.
TEST(LampSampler, IsUnbiased) {
  for (const int copies : {1, 4}) {
    const Scene scene = lamps_of_each_kind(copies);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const LampSampler lamps(rays, lights);
    for (const Vec3& p : kPlaces) {
      for (const float height : {0.f, 1.2f, 2.8f}) {
        const SurfacePoint point = receiver(scene, p + Vec3(0, height, 0), {0, 1, 0});
        RandomStream random(3, Stage::test, 0);
        const double truth =
            static_cast<double>(direct_irradiance(rays, lights, point, 4096, random).irradiance.y);
        double sum = 0, squares = 0;
        constexpr int kSamples = 20000;
        for (int i = 0; i < kSamples; ++i) {
          ArrivingLight light;
          lamps.sample(point, {random.uniform(), random.uniform(), random.uniform()}, light);
          if (!(light.lux.y > 0) || (!light.certain && rays.occluded(light.ray))) continue;
          const auto lux = static_cast<double>(light.lux.y);
          sum += lux / kSamples, squares += lux * lux / kSamples;
        }
        EXPECT_NEAR(sum, truth, 4 * std::sqrt((squares - sum * sum) / kSamples) + 1e-3 * truth)
            << copies << " " << p.x << " " << height;
      }
    }
  }
}

TEST(LampSampler, ChoosesWithTheProbabilityThatItStates) {
  for (const int copies : {1, 4}) {
    const Scene scene = lamps_of_each_kind(copies);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const LampSampler lamps(rays, lights);
    for (const Vec3& p : kPlaces) {
      const SurfacePoint point = receiver(scene, p, {0, 1, 0});
      constexpr int kSteps = 1 << 14;
      std::vector<double> chosen(lights.size(), 0), least(lights.size(), 1), most(lights.size(), 0);
      for (int i = 0; i < kSteps; ++i) {
        const LampSampler::Choice c = lamps.choose(point, (static_cast<float>(i) + 0.5f) / kSteps);
        ASSERT_LT(c.light, lights.size());
        EXPECT_FLOAT_EQ(c.probability, lamps.probability(point, c.light));
        ASSERT_GE(c.rest, 0);
        ASSERT_LT(c.rest, 1);
        chosen[c.light] += 1.0 / kSteps;
        least[c.light] = std::min(least[c.light], static_cast<double>(c.rest));
        most[c.light] = std::max(most[c.light], static_cast<double>(c.rest));
      }
      double sum = 0;
      for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto p_i = static_cast<double>(lamps.probability(point, i));
        EXPECT_NEAR(chosen[i], p_i, 2.0 / kSteps);
        if (p_i > 0.01) {
          EXPECT_LT(least[i], 0.01);
          EXPECT_GT(most[i], 0.99);
        }
        sum += p_i;
      }
      EXPECT_NEAR(sum, 1, 1e-5);
    }
  }
}

/// A lamp that cannot light a point is not asked.
TEST(LampSampler, LeavesOutWhatLooksAway) {
  const Scene scene = lamps_of_each_kind();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const LampSampler lamps(rays, lights);
  const SurfacePoint above = receiver(scene, {2.2f, 2.99f, 0.7f}, {0, -1, 0});  // over the panel
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const bool panel = lights[i].name == "panel";
    if (panel || lights[i].kind == Light::Kind::spot) {
      EXPECT_EQ(lamps.probability(above, i), 0) << i;
    }
  }
}

/// As many samples as there are lamps of like power; a weak one beside a strong one asks for none of its own.
TEST(LampSampler, SamplesAboutAsManyAsLampsMatter) {
  const auto samples = [](std::initializer_list<float> candela) {
    Scene scene;
    test::begin_instance(scene, "walls", test::add_lambert(scene, "grey", 0.5f));
    test::add_room(scene, Vec3(0), Vec3(4, 3, 4));
    float at = 0.5f;
    for (const float cd : candela) test::add_point_light(scene, {at += 0.2f, 2, 1}, cd);
    finalize(scene);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    return LampSampler(rays, lights).samples();
  };
  EXPECT_EQ(samples({}), 1u);
  EXPECT_EQ(samples({100}), 1u);
  EXPECT_EQ(samples({100, 100}), 2u);
  EXPECT_EQ(samples({100, 30}), 2u);
  EXPECT_EQ(samples({1e6f, 1}), 1u);
  EXPECT_EQ(samples({100, 100, 100}), 3u);
  EXPECT_EQ(samples({100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100}), 4u);
}

/// What is made of rays, and the coarse records that they read, at any size of a scene.
TEST(RecordOptions, ReachAsFarAsTheirKindMay) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    const auto resolved = [&](Footprint footprint, std::optional<double> least, std::optional<double> most) {
      RecordOptions options;
      options.estimate = Estimate::gather, options.footprint = footprint;
      options.min_radius_m = least, options.max_radius_m = most;
      options.resolve(static_cast<float>(size) / 4);
      return options;
    };
    const RecordOptions circle = resolved(Footprint::circle, {}, {}),
                        adaptive = resolved(Footprint::adaptive, {}, {}),
                        small = resolved(Footprint::adaptive, {}, size / 50),
                        large = resolved(Footprint::circle, size / 2, {});
    const double tolerance = 1e-6 * size;
    EXPECT_NEAR(*circle.max_radius_m, size / 4, tolerance);
    EXPECT_NEAR(*adaptive.max_radius_m, size / 8, tolerance);
    EXPECT_NEAR(*coarse_options(circle).max_radius_m, size / 16, tolerance);
    EXPECT_NEAR(*coarse_options(adaptive).max_radius_m, size / 16, tolerance);
    EXPECT_EQ(*coarse_options(small).max_radius_m, size / 50);
    EXPECT_EQ(*coarse_options(large).max_radius_m, size / 2);  // no less than the least
  }
}

/// Two hemispheres made by hand: means weigh rays, distances are harmonic or least.
TEST(RecordOf, JoinsPasses) {
  Hemisphere a, b;
  for (auto [h, rays, light, distance] : {std::tuple{&a, 64, 1.f, 1.f}, std::tuple{&b, 256, 3.f, 4.f}}) {
    h->frame = make_frame({0, 0, 1});
    h->rings = rings_for(rays), h->slices = slices_for(h->rings);
    const auto n = static_cast<std::size_t>(h->rings * h->slices);
    h->resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const float sin2 =
          (static_cast<float>(i / static_cast<std::size_t>(h->slices)) + 0.5f) / static_cast<float>(h->rings);
      const float phi = 2 * kPi * (static_cast<float>(i % static_cast<std::size_t>(h->slices)) + 0.5f) /
                        static_cast<float>(h->slices);
      h->direction[i] = {std::sqrt(sin2) * std::cos(phi), std::sqrt(sin2) * std::sin(phi),
                         std::sqrt(1 - sin2)};
      h->radiance[i] = Rgb(light), h->distance_m[i] = distance, h->hit_normal[i] = -h->direction[i];
      h->projected_sr[i] = kPi / static_cast<float>(n);
    }
  }
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  const std::vector<Hemisphere> passes{a, b};
  RecordOptions options;
  options.estimate = Estimate::gather;
  options.min_radius_m = 0.01, options.max_radius_m = 100;
  options.resolve(1);
  const IrradianceRecord harmonic = record_of({}, passes, options).record;
  EXPECT_NEAR(harmonic.irradiance.y, std::numbers::pi * (na + 3 * nb) / (na + nb), 1e-4);
  EXPECT_NEAR(harmonic.distance_m, (na + nb) / (na + nb / 4), 1e-4);
  EXPECT_NEAR(harmonic.radius_m, harmonic.distance_m, 1e-4);
  EXPECT_NEAR(harmonic.stderr_lx.y, 0, 1e-4);
  options.radius = RadiusRule::least;
  EXPECT_FLOAT_EQ(record_of({}, passes, options).record.distance_m, 1);
  options.max_radius_m = 0.5;
  EXPECT_FLOAT_EQ(record_of({}, passes, options).record.radius_m, 0.5f);
}

/// Where the gradient would change a channel by its own value, the record ends; channels that hardly count do
/// not matter, and a record that is to have no gradients is limited all the same.
TEST(RecordOf, EndsWhereTheGradientTakesAll) {
  PlaceLight light;
  light.irradiance = Rgb(10, 5, 0.01f);
  light.distance_m = 50;
  light.gradients.translation[0] = {1, 0, 0};
  light.gradients.translation[1] = {0, 2, 0};
  light.gradients.translation[2] = {3, 0, 0};
  light.gradients.rotation[0] = {0, 1, 0};
  RecordOptions options;
  options.estimate = Estimate::gather;
  options.min_radius_m = 0.01, options.max_radius_m = 100;
  options.resolve(1);
  const Made made = record_of({}, light, options);
  EXPECT_FLOAT_EQ(made.record.radius_m, 2.5f);
  EXPECT_EQ(made.record.translation_gradient[1], Vec3(0, 2, 0));
  EXPECT_EQ(made.record.rotation_gradient[0], Vec3(0, 1, 0));
  EXPECT_FLOAT_EQ(made.record.distance_m, 50);
  options.gradients = GradientMode::none;
  const Made without = record_of({}, light, options);
  EXPECT_FLOAT_EQ(without.record.radius_m, 2.5f);
  EXPECT_EQ(without.record.translation_gradient[1], Vec3(0));
  light.irradiance.x = std::numeric_limits<float>::quiet_NaN();
  RecordSite site;
  site.position = {0.5f, 1, -2};
  try {
    record_of(site, light, options, {400000, 5000000, 0});
    ADD_FAILURE() << "a record of light that is no number";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
    EXPECT_NE(std::string(e.what()).find("(400000.5, 5000001, -2) m"), std::string::npos) << e.what();
  }
}

TEST(Gather, BrightPlacesMayHaveNearerNeighbours) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  RecordOptions options;
  options.estimate = Estimate::gather;
  options.resolve(s.scene.bounds.diagonal_m() / 4);
  RecordSite site{s.checks[0].position, s.checks[0].normal};
  site.least_radius_m = 3;
  const auto share = [&](float lux, double usual_lx) {
    RecordTree coarse(s.scene.bounds, 0.2);
    IrradianceRecord known;
    known.position = site.position, known.normal = site.normal, known.irradiance = Rgb(lux),
    known.radius_m = 1;
    if (lux > 0) coarse.insert(known);
    GatherSource source;
    source.indirect = &coarse, source.usual_lx = usual_lx;
    const GatherEstimator estimator(rays, lights, source, options, 1);
    const Made made = estimator.make(site, *estimator.make_worker());
    EXPECT_EQ(made.site_least_m, 3.f);
    return made.least_share;
  };
  EXPECT_EQ(share(20, 10), 1.f);
  EXPECT_EQ(share(1, 10), 1.f);
  EXPECT_EQ(share(10, 0), 1.f) << "unknown";
  EXPECT_EQ(share(0, 10), 1.f) << "no record there";
  EXPECT_FLOAT_EQ(share(80, 10), 0.5f);
  EXPECT_FLOAT_EQ(share(8e-10f, 1e-10), 0.5f);
  EXPECT_EQ(share(1e30f, 10), 0.25f);
}

TEST(CoarseLevel, MeanIrradianceIsByArea) {
  EXPECT_EQ(mean_irradiance_lx({}), 0);
  IrradianceRecord near, far;
  near.irradiance = Rgb(100), near.radius_m = 1;
  far.irradiance = Rgb(10), far.radius_m = 3;
  EXPECT_NEAR(mean_irradiance_lx(std::vector{near, far}), (100 + 9 * 10) / 10., 1e-5);
}

TEST(Gather, DirectionsLieInTheirCells) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const test::Gathered g(s.scene);
  const GatherEstimator gather(g.rays, g.lights, {}, test::gather_options(s.scene, Quantity::indirect, 1, 64),
                               1);
  const auto worker = gather.make_worker();
  for (const std::int64_t rays : {1, 16, 64, 1000, 4096}) {
    Hemisphere h;
    gather.sample({{1, 0.5f, 0.7f}, glm::normalize(Vec3(1, 2, 3)), 5}, rays, 0, h, *worker);
    ASSERT_TRUE(h.stratified());
    ASSERT_LE(h.size(), static_cast<std::size_t>(std::max<std::int64_t>(rays, 3)));
    double sum = 0;
    for (int j = 0; j < h.rings; ++j) {
      for (int k = 0; k < h.slices; ++k) {
        const std::size_t i = h.at(j, k);
        const Vec3 w = h.frame.to_local(h.direction[i]);
        EXPECT_NEAR(glm::length(w), 1, 1e-6);
        const float ring = (w.x * w.x + w.y * w.y) * static_cast<float>(h.rings);
        EXPECT_GT(ring, static_cast<float>(j) - 1e-4f);
        EXPECT_LT(ring, static_cast<float>(j + 1) + 1e-4f);
        float slice = std::atan2(w.y, w.x) / (2 * kPi) * static_cast<float>(h.slices);
        if (slice < static_cast<float>(k) - 0.5f) slice += static_cast<float>(h.slices);
        EXPECT_GT(slice, static_cast<float>(k) - 1e-3f);
        EXPECT_LT(slice, static_cast<float>(k + 1) + 1e-3f);
        EXPECT_TRUE(std::isfinite(h.distance_m[i]));
        EXPECT_LT(glm::dot(h.hit_normal[i], h.direction[i]), 0);
        sum += static_cast<double>(h.projected_sr[i]);
      }
    }
    EXPECT_NEAR(sum, std::numbers::pi, 1e-4);
  }
}

/// A smooth normal looks below the flat triangle that it stands on: no ray sees the triangle itself.
TEST(Gather, DoesNotSeeItsOwnSurface) {
  const test::AnalyticScene s = test::emitting_environment(100, 1);
  const test::Gathered g(s.scene);
  const GatherEstimator gather(g.rays, g.lights, {},
                               test::gather_options(s.scene, Quantity::indirect, 1, 1024), 1);
  const auto worker = gather.make_worker();
  const Vec3 n = s.checks[0].normal, side = glm::normalize(glm::cross(n, Vec3(1, 0, 0)));
  const Vec3 smooth = glm::normalize(n + 0.5f * side);
  Hemisphere h;
  gather.sample({{0, 0, 0}, smooth, 1}, 1024, 0, h, *worker);
  int below = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const float up = glm::dot(h.direction[i], n);
    if (std::fabs(up) < 1e-3f) continue;  // some leave the sheet before they reach it
    below += up < 0;
    EXPECT_EQ(h.radiance[i], Rgb(0));  // walls reflect nothing, and the sheet is not seen
    EXPECT_EQ(h.distance_m[i] == kInfinity, up < 0);
  }
  EXPECT_GT(below, 30);
}

/// Over a parallel surface close below, a record must not reach so far that it is taken for one of it.
TEST(Gather, RecordOnASheetStaysShort) {
  const test::AnalyticScene s = test::thin_walls(1000, 0.001f);
  test::Gathered g(s.scene);
  const RecordOptions options = test::gather_options(s.scene, Quantity::all, 1, 64);
  const IrradianceRecord r = g.records({0.3f, 0.1f, 0}, {0, 0, 1}, options, {}, 1)[0];
  EXPECT_GT(r.irradiance.y, 500);
  EXPECT_LE(r.radius_m, 0.051f);
  EXPECT_TRUE(record_apart(r, {0.3f, 0.1f, -0.001f}, {0, 0, 1}));
}

}  // namespace
}  // namespace phos
