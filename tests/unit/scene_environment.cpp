// Environment maps: where their texels lie, what they add up to, and what is refused.
#include "scene/sky/environment.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "core/random.h"
#include "image/image.h"
#include "scene/lamp/luminaires.h"
#include "support/environment.h"
#include "support/scenes.h"

using namespace phos;
using namespace phos::test;

namespace {

std::string scratch(const std::string& name) { return std::string(PHOS_SCRATCH) + "/environment_" + name; }

/// One bright texel in a dark map.
Environment spot(int column, int row, double rotation_rad = 0) {
  return map_of(
      32, [&](int x, int y) { return x == column && y == row ? Rgb(1) : Rgb(0); }, rotation_rad);
}

void expect_direction(const Vec3& found, const Vec3& expected, float within) {
  EXPECT_LT(glm::length(found - expected), within)
      << found.x << " " << found.y << " " << found.z << ", expected " << expected.x << " " << expected.y
      << " " << expected.z;
}

}  // namespace

TEST(Environment, LiesAsItsConventionSays) {
  // 64 x 32 texels of 5.6 degrees: rows 15 and 16 meet at the horizon, columns 31 and 32 in the middle.
  constexpr float kTexel = 2 * kPi / 64;
  expect_direction(spot(32, 16).sample({0, 0}).direction, {0, 0, 1}, 1e-5f);   // the middle: +Z
  expect_direction(spot(16, 16).sample({0, 0}).direction, {1, 0, 0}, 1e-5f);   // a quarter to the left: +X
  expect_direction(spot(48, 16).sample({0, 0}).direction, {-1, 0, 0}, 1e-5f);  // to the right: -X
  expect_direction(spot(0, 16).sample({0, 0}).direction, {0, 0, -1}, 1e-5f);   // the left edge: -Z
  expect_direction(spot(5, 0).sample({0.5f, 0.5f}).direction, {0, 1, 0}, kTexel);  // the top row: +Y
  // A quarter turn, counter-clockwise seen from above: +Z goes to +X.
  expect_direction(spot(32, 16, M_PI / 2).sample({0, 0}).direction, {1, 0, 0}, 1e-5f);
  expect_direction(spot(32, 16, -3 * M_PI / 2).sample({0, 0}).direction, {1, 0, 0}, 1e-5f);
}

TEST(Environment, WhatIsSampledIsWhatIsSeen) {
  for (const double rotation : {0.0, 0.7, -2.5, 6.0}) {
    const Environment map = gradient_map(48, rotation);
    int differ = 0;
    for (std::uint64_t k = 0; k < 4000; ++k) {
      RandomStream random(5, Stage::test, k);
      const Environment::Sample s = map.sample(random.uniform2());
      EXPECT_NEAR(glm::length(s.direction), 1, 1e-6f);
      // On the edge between two texels rounding may choose the other.
      differ += map.luminance(s.direction) != s.luminance;
      if (map.luminance(s.direction) == s.luminance) {
        EXPECT_EQ(map.density(s.direction), s.density);
      }
    }
    EXPECT_LE(differ, 4) << rotation;
  }
}

TEST(Environment, AddsUpExactly) {
  const Environment flat = constant_map(16, Rgb(3, 2, 1));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(flat.integral_lx()[c], 4 * M_PI * (3 - c), 1e-12 * 40);
    EXPECT_NEAR(flat.irradiance_up_lx()[c], M_PI * (3 - c), 1e-12 * 10);
  }
  // An odd number of rows: the middle one is cut by the horizon.
  EXPECT_NEAR(constant_map(7, Rgb(1)).irradiance_up_lx().x, M_PI, 1e-12);
  // Light over density is the same for every sample of a grey map: its integral.
  const Environment grey = map_of(32, [](int x, int y) { return Rgb(static_cast<float>(1 + x + 40 * y)); });
  for (const float u : {0.f, 0.3f, 0.999999f}) {
    const Environment::Sample s = grey.sample({u, 1 - u});
    EXPECT_NEAR(s.luminance.x / s.density, grey.integral_lx().x, 1e-5 * grey.integral_lx().x);
  }
}

TEST(Environment, KeepsTheStrataOfItsNumbers) {
  // The vertical irradiance of a sky, from 32 x 32 strata: far better than 1024 random samples (1.6 % here).
  const Environment map = map_of(64, [](int, int y) { return Rgb(static_cast<float>(64 - y)); });
  constexpr int kSide = 32;
  double sum = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Environment::Sample s =
          map.sample(Vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f) / float{kSide});
      sum += double(std::max(0.f, s.direction.y) * s.luminance.x / s.density) / (kSide * kSide);
    }
  EXPECT_NEAR(sum, map.irradiance_up_lx().x, 1e-3 * sum);
}

TEST(Environment, ASunOfOneTexelIsFoundHoweverSmall) {
  // One of 2048 x 1024, with 0.977 of the light: probability follows light, not area.
  const Environment map =
      map_of(1024, [](int x, int y) { return x == 700 && y == 200 ? Rgb(1e9f) : Rgb(10); });
  int sun = 0, sun_flux = 0;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    RandomStream random(6, Stage::test, k);
    const Vec2 u = random.uniform2();
    sun_flux += map.sample_flux(u).luminance.x == 1e9f;
    sun += map.sample(u).luminance.x == 1e9f;
  }
  EXPECT_NEAR(sun_flux, 977, 20);
  // A point that may not see the sun looks elsewhere half of the time.
  EXPECT_NEAR(sun, 489, 60);
}

TEST(Environment, ABlackMapGivesNothing) {
  const Environment map = constant_map(4, Rgb(0));
  EXPECT_EQ(map.sample({0.5f, 0.5f}).density, 0);
  EXPECT_EQ(map.density({0, 1, 0}), 0);
  EXPECT_EQ(map.integral_lx(), DVec3(0));
}

TEST(Environment, IsOneOfTheLightsOfItsScene) {
  Scene scene = open_floor();
  surround(scene, constant_map(8, Rgb(2)));
  ASSERT_EQ(scene.light.size(), 1u);
  EXPECT_EQ(scene.light[0].kind, Light::Kind::environment);
  const float radius_m = bounding_radius_m(scene);
  EXPECT_NEAR(scene.light[0].flux_lm.x, 8 * kPi * kPi * radius_m * radius_m,
              1e-3f * scene.light[0].flux_lm.x);
  const Luminaires lights(scene);
  EXPECT_EQ(lights.environment(), 0);
  Illumination light;
  ASSERT_TRUE(lights.illuminate(0, Vec3(0), 0, {0.2f, 0.3f}, light));
  EXPECT_EQ(light.distance_m, kInfinity);
  EXPECT_EQ(light.value, Rgb(2));
  EXPECT_EQ(lights.density_beyond(Vec3(0), light.direction), light.density);
  EXPECT_EQ(background_luminance(scene, {0, 1, 0}), Rgb(2));
  // Finalized again it is still one light.
  finalize(scene);
  EXPECT_EQ(scene.light.size(), 1u);
}

TEST(Environment, ABlackOneIsIgnoredWithAWarning) {
  Scene scene = open_floor();
  surround(scene, constant_map(8, Rgb(0)));
  EXPECT_TRUE(scene.light.empty());
  ASSERT_FALSE(scene.warnings.empty());
  EXPECT_NE(scene.warnings.back().line().find("environment"), std::string::npos);
  EXPECT_EQ(Luminaires(scene).environment(), -1);
  EXPECT_EQ(Luminaires(scene).density_beyond(Vec3(0), {0, 1, 0}), 0);
}

TEST(Environment, IsPartOfTheHashOfItsScene) {
  Scene plain = open_floor();
  finalize(plain);
  std::vector<std::string> hashes = {plain.hash};
  const auto add = [&](const Environment& map) {
    Scene scene = open_floor();
    surround(scene, map);
    for (const std::string& other : hashes) EXPECT_NE(scene.hash, other);
    EXPECT_FALSE(scene.parts["environment"].as_string().empty());
    EXPECT_EQ(scene.parts["geometry"].as_string(), plain.parts["geometry"].as_string());
    hashes.push_back(scene.hash);
  };
  add(constant_map(8, Rgb(1)));
  add(constant_map(8, Rgb(2)));
  add(constant_map(9, Rgb(1)));
  add(constant_map(8, Rgb(1), 0.1));
  // The same light all told, elsewhere.
  add(spot(3, 3));
  add(spot(4, 3));
}

TEST(ReadEnvironment, ScalesAndConverts) {
  Image image(4, 2);
  image.set_rgb("", std::vector<Rgb>(8, Rgb(1, 2, 3)));
  write_exr(scratch("small.exr"), image);
  EXPECT_EQ(read_environment(scratch("small.exr"), 2).map.texels()[5], Rgb(2, 4, 6));
  // Written as Radiance .hdr, divided by 179 lm/W and read back: cd/m2 again, to RGBE's 1 %.
  write_hdr(scratch("small.hdr"), image);
  const Rgb back = read_environment(scratch("small.hdr")).map.texels()[5];
  EXPECT_NEAR(back.x, 1, 0.02f);
  EXPECT_NEAR(back.z, 3, 0.02f);
}

TEST(ReadEnvironment, KeepsTheLuminanceOfColoursBeyondRec709) {
  // Green of wider primaries: red is negative, X, Y and Z are not.
  const Rgb green(-0.05f, 1, 0.1f);
  Image image(4, 2);
  std::vector<Rgb> texels(8, Rgb(1));
  texels[2] = texels[7] = green;
  image.set_rgb("", texels);
  write_exr(scratch("green.exr"), image);
  const EnvironmentFile file = read_environment(scratch("green.exr"));
  EXPECT_EQ(file.outside_gamut, 2u);
  const Rgb c = file.map.texels()[7];
  EXPECT_EQ(c.x, 0);
  EXPECT_GT(c.y, c.z);
  EXPECT_GT(c.z, 0);
  EXPECT_NEAR(luminance(c), luminance(green), 1e-6f);
  EXPECT_EQ(file.map.texels()[0], Rgb(1));
}

TEST(ReadEnvironment, TellsMapsFromOtherPictures) {
  const std::string folder = PHOS_SOURCE "/../shared/scenes/env/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/scenes/env";
  for (const char* name :
       {"mitsuba_envmap.exr", "night.hdr", "sky19.exr", "tungsten_envmap.hdr", "uffizi.hdr"}) {
    const EnvironmentFile file = read_environment(folder + name);
    EXPECT_GT(file.map.integral_lx().y, 0) << name;
    EXPECT_LT(file.outside_gamut, 0.001 * static_cast<double>(file.map.texels().size())) << name;
  }
  for (const char* name : {"evalglare_testimage_fisheye.hdr", "memorial_photo.hdr"})
    EXPECT_THROW(read_environment(folder + name), Error) << name;
}
