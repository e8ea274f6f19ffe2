// What leaves the lights: directions, positions, shares and powers, against their distributions. Chi-squared
// limits are for a probability of 1e-5 (Wilson-Hilferty), seeds are fixed.
#include <gtest/gtest.h>

#include "core/error.h"
#include "photon/emission.h"
#include "support/cutouts.h"
#include "support/scenes.h"

namespace phos {
namespace {

constexpr double kNormal1e5 = 4.265;  // one-sided

double chi2_limit(double freedom) {
  const double a = 2 / (9 * freedom);
  return freedom * std::pow(1 - a + kNormal1e5 * std::sqrt(a), 3);
}

void expect_uniform(const std::vector<std::uint64_t>& counts, const std::string& what) {
  double total = 0, chi2 = 0;
  for (const std::uint64_t n : counts) total += static_cast<double>(n);
  const double expected = total / static_cast<double>(counts.size());
  for (const std::uint64_t n : counts) chi2 += std::pow(static_cast<double>(n) - expected, 2) / expected;
  EXPECT_LT(chi2, chi2_limit(static_cast<double>(counts.size() - 1))) << what;
}

std::size_t bin(double u, std::size_t bins) {
  return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, u) * static_cast<double>(bins)));
}

EmittedPhoton emitted(const Emitter& emitter, std::uint64_t path) {
  RandomStream random(3, Stage::photon_path, path);
  random.start_bounce(0);
  return emitter.emit(path, random);
}

Scene floor_scene() {
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "grey", 0.5f));
  test::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  return scene;
}

TEST(Emission, PointLightIsUniformOverTheSphere) {
  Scene scene = floor_scene();
  test::add_point_light(scene, {0, 1, 0}, 10);
  finalize(scene);
  constexpr std::uint64_t kPaths = 200'000;
  const Emitter emitter(scene, 0.1, kPaths, 1);
  std::vector<std::uint64_t> counts(20 * 20);
  double flux = 0;
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    const EmittedPhoton p = emitted(emitter, i);
    const double phi = std::atan2(p.ray.direction.z, p.ray.direction.x) / (2 * std::numbers::pi) + 0.5;
    ++counts[20 * bin(0.5 + 0.5 * double(p.ray.direction.y), 20) + bin(phi, 20)];
    flux += double(p.flux_lm.x);
    EXPECT_EQ(p.source_normal, p.ray.direction);
  }
  expect_uniform(counts, "point");
  EXPECT_NEAR(flux, 40 * std::numbers::pi, 1e-4 * flux);
}

/// A lamp gives the lumens of what is there of it, and photons start nowhere else.
TEST(Emission, CutOutLampsShineWhereTheyAreSeen) {
  // 2 x 3 m of 1000 cd/m2, one side.
  const double whole = 6000 * std::numbers::pi;
  const double shares[] = {0.5, 1, 0.5, 0.7, 1};
  const std::vector<test::AnalyticScene> lamps = test::cut_out_lamps();
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    const Scene& scene = lamps[k].scene;
    ASSERT_EQ(scene.light.size(), 1u) << lamps[k].name;
    EXPECT_NEAR(static_cast<double>(scene.light[0].flux_lm.x), shares[k] * whole, 1e-4 * whole);
    constexpr std::uint64_t kPaths = 100'000;
    const Emitter emitter(scene, 0.1, kPaths, 1);
    double flux = 0;
    for (std::uint64_t i = 0; i < kPaths; ++i) {
      const EmittedPhoton p = emitted(emitter, i);
      flux += static_cast<double>(p.flux_lm.x);
      if (shares[k] == 0.5 && p.flux_lm.x > 0) {
        EXPECT_LT(p.ray.origin.x, 1.0001f) << lamps[k].name;
      }
    }
    EXPECT_NEAR(flux, shares[k] * whole, 0.01 * whole) << lamps[k].name;
  }
}

TEST(Emission, LampsWithoutAVisibleTexelAreTold) {
  for (const Material::Alpha mode : {Material::Alpha::mask, Material::Alpha::blend}) {
    Scene scene = test::rectangle_light_parallel().scene;
    scene.material[1].alpha_mode = mode, scene.material[1].alpha = 0;
    scene.warnings.clear();
    finalize(scene);
    EXPECT_TRUE(scene.light.empty());
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].line(),
              "light \"light\": is cut out wholly by its alpha, or black: it is ignored");
  }
}

TEST(Emission, SpotFollowsItsRampForEveryCone) {
  // The cumulative share of c is the integral of the ramp from c to 1; it must be uniform.
  for (const auto& [inner, outer] :
       {std::pair{0.9f, 0.5f}, {1.0f, 0.0f}, {0.8f, 0.8f}, {0.99995f, 0.9999f}, {0.3f, -0.7f}}) {
    const double end = double(inner), width = end - double(outer), total = 1 - end + width / 3;
    const auto above = [&](double c) {
      if (c >= end) return (1 - c) / total;
      const double t = c - double(outer);
      return (1 - end + width / 3 - t * t * t / (3 * width * width)) / total;
    };
    std::vector<std::uint64_t> counts(50);
    constexpr int kSamples = 100'000;
    for (int i = 0; i < kSamples; ++i)
      ++counts[bin(above(double(sample_spot_cosine(inner, outer, (static_cast<float>(i) + 0.5f) / kSamples))),
                   50)];
    for (const std::uint64_t n : counts)
      EXPECT_NEAR(static_cast<double>(n), kSamples / 50.0, 0.05 * kSamples / 50) << inner;
    EXPECT_NEAR(spot_solid_angle_sr(inner, outer), 2 * std::numbers::pi * total, 1e-12);
    EXPECT_NEAR(sample_spot_cosine(inner, outer, 1), double(inner), 1e-12);
  }
}

TEST(Emission, SpotFluxIsTheLightsFlux) {
  Scene scene = floor_scene();
  Light spot;
  spot.kind = Light::Kind::spot;
  spot.position = {0, 2, 0};
  spot.direction = glm::normalize(Vec3(0.3f, -1, 0.2f));
  spot.intensity = Rgb(100, 50, 25);
  spot.cos_inner = 0.95f, spot.cos_outer = 0.8f;
  scene.light.push_back(spot);
  finalize(scene);
  constexpr std::uint64_t kPaths = 10'000;
  const Emitter emitter(scene, 0.1, kPaths, 1);
  DVec3 flux(0);
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    const EmittedPhoton p = emitted(emitter, i);
    flux += DVec3(p.flux_lm);
    EXPECT_GE(glm::dot(p.ray.direction, spot.direction), 0.8f - 1e-5f);
    EXPECT_NEAR(glm::length(p.ray.direction), 1, 1e-5);
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(flux[c], double(scene.light[0].flux_lm[c]), 1e-4 * flux[c]) << "channel " << c;
}

TEST(Emission, AreaLightIsUniformAndCosineWeighted) {
  for (const bool both : {false, true}) {
    Scene scene = floor_scene();
    test::begin_instance(scene, "light", test::add_lambert(scene, "light", 0, 100));
    scene.material.back().double_sided = both;
    test::add_quad(scene, {0, 1, 0}, {2, 0, 0}, {0, 0, 3});  // front towards -y
    finalize(scene);
    constexpr std::uint64_t kPaths = 200'000;
    const Emitter emitter(scene, 0.1, kPaths, 1);
    std::vector<std::uint64_t> place(10 * 10), direction(10 * 10), sides(2);
    double flux = 0;
    for (std::uint64_t i = 0; i < kPaths; ++i) {
      const EmittedPhoton p = emitted(emitter, i);
      ++place[10 * bin(double(p.ray.origin.x) / 2, 10) + bin(double(p.ray.origin.z) / 3, 10)];
      const double c = double(glm::dot(p.ray.direction, p.source_normal));
      const double phi = std::atan2(p.ray.direction.z, p.ray.direction.x) / (2 * std::numbers::pi) + 0.5;
      ++direction[10 * bin(c * c, 10) + bin(phi, 10)];
      ++sides[p.source_normal.y > 0 ? 1 : 0];
      flux += double(p.flux_lm.x);
    }
    expect_uniform(place, "positions");
    expect_uniform(direction, "directions");
    if (both)
      expect_uniform(sides, "sides");
    else
      EXPECT_EQ(sides[1], 0u) << "the front faces down";
    const double expected = std::numbers::pi * 100 * 6 * (both ? 2 : 1);
    EXPECT_NEAR(flux, expected, 1e-4 * expected);
    EXPECT_NEAR(double(scene.light[0].flux_lm.x), expected, 1e-4 * expected);
  }
}

TEST(Emission, TexturedLightEmitsItsFlux) {
  Scene scene = floor_scene();
  Texture texture;
  texture.width = 4, texture.height = 1;
  texture.texels = {Vec4(0.2f), Vec4(1), Vec4(0), Vec4(0.5f, 0.1f, 0.9f, 1)};
  scene.texture.push_back(texture);
  test::begin_instance(scene, "light", test::add_lambert(scene, "light", 0, 100));
  scene.material.back().emissive.texture = 0;
  test::add_quad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  scene.uv0.assign(scene.position.size(), Vec2(0));
  const std::size_t first = scene.position.size() - 4;
  for (std::size_t i = 0; i < 4; ++i)
    scene.uv0[first + i] = {scene.position[first + i].x, scene.position[first + i].z};
  finalize(scene);
  ASSERT_EQ(scene.light.size(), 1u);
  constexpr std::uint64_t kPaths = 200'000;
  const Emitter emitter(scene, 0.1, kPaths, 1);
  DVec3 sum(0), squares(0);
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    const DVec3 f(emitted(emitter, i).flux_lm);
    sum += f, squares += f * f;
  }
  for (int c = 0; c < 3; ++c) {
    const double expected = double(scene.light[0].flux_lm[c]);
    const double deviation = std::sqrt(std::max(0.0, squares[c] - sum[c] * sum[c] / kPaths));
    EXPECT_NEAR(sum[c], expected, 4.8 * deviation + 0.005 * expected)
        << "channel " << c;  // the flux is itself a sum of samples
  }
}

TEST(Emission, DirectionalFillsTheBoundingDisc) {
  Scene scene = floor_scene();
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(Vec3(1, -2, 0.5f));
  sun.intensity = Rgb(1000);
  scene.light.push_back(sun);
  finalize(scene);
  constexpr std::uint64_t kPaths = 200'000;
  const Emitter emitter(scene, 0.1, kPaths, 1);
  const float radius = bounding_radius_m(scene);
  const Frame frame = make_frame(sun.direction);
  std::vector<std::uint64_t> counts(10 * 12);
  double flux = 0;
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    const EmittedPhoton p = emitted(emitter, i);
    const Vec3 local = frame.to_local(p.ray.origin - scene.bounds.centre()) / radius;
    const double phi = std::atan2(local.y, local.x) / (2 * std::numbers::pi) + 0.5;
    ++counts[12 * bin(double(local.x) * double(local.x) + double(local.y) * double(local.y), 10) +
             bin(phi, 12)];
    EXPECT_LT(local.z, -1);
    EXPECT_TRUE(p.from_infinity);
    flux += double(p.flux_lm.x);
  }
  expect_uniform(counts, "disc");
  EXPECT_NEAR(flux, double(scene.light[0].flux_lm.x), 1e-4 * flux);
}

TEST(Emission, SharesAreKeptToAFewPathsAndSmallLampsAreNotStarved) {
  Scene scene = floor_scene();
  const std::vector<float> candela{1e6f, 1, 0, 500, 1e-3f};
  for (const float cd : candela) test::add_point_light(scene, {0, 1, 0}, cd > 0 ? cd : 1);
  finalize(scene);
  scene.light[2].intensity = scene.light[2].flux_lm = Rgb(0);
  for (const std::uint64_t paths : {1000u, 65'536u, 100'003u}) {
    const Emitter emitter(scene, 0.5, paths, 9);
    std::vector<std::uint64_t> counts(candela.size());
    std::vector<double> flux(candela.size());
    for (std::uint64_t i = 0; i < paths; ++i) {
      const std::size_t light = emitter.light_of(i);
      ++counts[light];
      flux[light] += double(emitted(emitter, i).flux_lm.x);
    }
    for (std::size_t i = 0; i < candela.size(); ++i) {
      const double expected = emitter.share(i) * static_cast<double>(paths);
      // A van der Corput sequence of N points counts any interval to within log2(N) + 2.
      EXPECT_NEAR(static_cast<double>(counts[i]), expected, 2 + std::log2(static_cast<double>(paths)))
          << "light " << i;
      if (candela[i] > 0) {
        EXPECT_GT(emitter.share(i), 0.99 * 0.5 / 5) << "light " << i << " starves";
        EXPECT_NEAR(flux[i], 4 * std::numbers::pi * double(candela[i]), 0.2 * flux[i]);
      } else {
        EXPECT_EQ(counts[i], 0u) << "a dark light";
      }
    }
  }
}

TEST(Emission, NoLightSaysSo) {
  Scene scene = floor_scene();
  finalize(scene);
  EXPECT_THROW(Emitter(scene, 0.1, 10, 0), Error);
  test::add_point_light(scene, {0, 1, 0}, 0);
  finalize(scene);
  EXPECT_THROW(Emitter(scene, 0.1, 10, 0), Error);
}

}  // namespace
}  // namespace phos
