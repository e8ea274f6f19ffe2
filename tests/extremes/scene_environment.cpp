// Environment maps that are no light, and light at the ends of what numbers can say.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/random.h"
#include "image/image.h"
#include "scene/lamp/luminaires.h"
#include "support/environment.h"

using namespace phos;
using namespace phos::test;

namespace {

std::string scratch_file(const std::string& name) {
  return std::string(PHOS_SCRATCH) + "/environment_extremes_" + name;
}

std::string map_file(const std::string& name, int width, int height, const Rgb& texel, const Rgb& odd) {
  Image image(width, height);
  std::vector<Rgb> texels(image.pixels(), texel);
  if (!texels.empty()) texels[texels.size() / 2] = odd;
  image.set_rgb("", texels);
  write_exr(scratch_file(name), image);
  return scratch_file(name);
}

/// One line that names the file and holds the word; exit code 3.
void expect_refused(const std::string& path, const std::string& word, double scale = 1) {
  try {
    read_environment(path, scale);
    ADD_FAILURE() << path << " was read";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_EQ(e.where(), path);
    const std::string what = e.what();
    EXPECT_NE(what.find(word), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

}  // namespace

TEST(ReadEnvironment, RefusesWhatIsNoLight) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float odd : {-20.f, kInfinity, -kInfinity, nan}) {
    for (int c = 0; c < 3; ++c) {
      Rgb texel(1);
      texel[c] = odd;
      expect_refused(map_file("odd.exr", 8, 4, Rgb(1), texel), "column 0, row 2");
    }
  }
  expect_refused(map_file("all.exr", 8, 4, Rgb(-1), Rgb(-1)), "32 texels");
}

TEST(ReadEnvironment, RefusesOtherShapes) {
  for (const auto& [w, h] : {std::pair{8, 8}, {7, 4}, {9, 4}, {4, 8}, {1, 1}})
    expect_refused(map_file("shape.exr", w, h, Rgb(1), Rgb(1)), "twice as wide as high");
}

TEST(ReadEnvironment, RefusesOtherFiles) {
  expect_refused(scratch_file("not-there.exr"), "");
  expect_refused(PHOS_SCRATCH, "folder");
  const std::string text_file = scratch_file("text.exr");
  std::ofstream(text_file) << "hello";
  expect_refused(text_file, "OpenEXR");
  std::ofstream(text_file, std::ios::trunc) << "";
  expect_refused(text_file, "OpenEXR");
  // A map cut off in the middle.
  const std::string whole = map_file("whole.exr", 64, 32, Rgb(1), Rgb(2)), cut = scratch_file("cut.exr");
  std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(cut, std::filesystem::file_size(whole) / 2);
  expect_refused(cut, "");
  // Depth alone is no colour.
  Image depth(8, 4);
  depth.channel("Z");
  write_exr(scratch_file("depth.exr"), depth);
  expect_refused(scratch_file("depth.exr"), "R, G and B");
}

TEST(ReadEnvironment, RefusesWhatScalingMakesInfinite) {
  const std::string path = map_file("bright.exr", 8, 4, Rgb(1e30f), Rgb(1e38f));
  EXPECT_EQ(read_environment(path, 1).map.texels()[0], Rgb(1e30f));
  expect_refused(path, "--environment-scale", 1e3);
}

TEST(Environment, IsRightForLightOfAnyStrength) {
  for (const float strength : {1e-30f, 1e-12f, 1.f, 1e12f, 1e30f}) {
    const Environment map =
        map_of(16, [&](int x, int y) { return strength * Rgb(1 + static_cast<float>(x % 3 + y)); });
    double sum = 0;
    constexpr int kCount = 4096;
    for (std::uint64_t k = 0; k < kCount; ++k) {
      RandomStream random(1, Stage::test, k);
      const Environment::Sample s = map.sample(random.uniform2());
      ASSERT_TRUE(std::isfinite(s.density) && s.density > 0);
      ASSERT_TRUE(is_finite(s.direction) && is_finite(s.luminance));
      sum += double(s.luminance.y) / double(s.density) / kCount;
    }
    EXPECT_NEAR(sum / map.integral_lx().y, 1, 1e-4) << strength;
  }
}

TEST(Environment, EndsOfTheUnitSquareAreTexelsThatShine) {
  for (const bool ends : {false, true}) {
    // Black but in the middle, and black in the middle.
    const Environment map = map_of(8, [&](int x, int y) {
      const bool middle = x > 3 && x < 12 && y > 1 && y < 6;
      return Rgb(middle != ends ? 1.f : 0.f);
    });
    for (const float u : {0.f, 0x1p-24f, 0.5f, 1 - 0x1p-24f, 1.f})
      for (const float v : {0.f, 0x1p-24f, 0.5f, 1 - 0x1p-24f, 1.f}) {
        const Environment::Sample s = map.sample({u, v});
        EXPECT_EQ(s.luminance, Rgb(1)) << u << " " << v;
        EXPECT_GT(s.density, 0);
        EXPECT_NEAR(glm::length(s.direction), 1, 1e-6f);
      }
  }
}

TEST(Environment, AnyDirectionIsSomewhere) {
  const Environment map = gradient_map(16);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3& d : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0), Vec3(-0.f, 0, -1), Vec3(1e-38f, 1, 1e-38f),
                        Vec3(nan), Vec3(0, 0, -1), Vec3(-1e-30f, 0, -1)}) {
    EXPECT_TRUE(is_finite(map.luminance(d)));
    EXPECT_TRUE(std::isfinite(map.density(d)));
  }
}

TEST(Environment, OfTwoTexelsHasTwoHalves) {
  const Environment map = map_of(1, [](int x, int) { return Rgb(x == 0 ? 3.f : 1.f); });
  EXPECT_NEAR(map.integral_lx().x, 8 * M_PI, 1e-12);
  EXPECT_EQ(map.luminance({1, 0.3f, 0}), Rgb(3));
  EXPECT_EQ(map.luminance({-1, 0.3f, 0}), Rgb(1));
}
