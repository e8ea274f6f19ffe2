// Image files: what is written comes back, and what others write is understood.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "core/random.h"
#include "image/exr/decode.h"
#include "image/exr/encode.h"
#include "image/hdr.h"
#include "image/png.h"
#include "image/primaries.h"
#include "support/run.h"

namespace phos {
namespace {

Image random_image(int width, int height, const std::vector<std::string>& channels) {
  Image image(width, height);
  RandomStream random(1, Stage::test, 7);
  for (const std::string& name : channels)
    for (float& v : image.channel(name)) v = std::exp(20 * random.uniform() - 10);
  return image;
}

/// OpenEXR has a rational number for it, which other programs read; here it is text.
TEST(Exr, FramesPerSecondIsTheStandardAttribute) {
  const std::string path = test::scratch("frame-rate") + "/a.exr";
  Image image(2, 2);
  image.set_rgb("", std::vector<Rgb>(4));
  EXPECT_FALSE(frames_per_s(image));
  for (const double rate : {24.0, 12.5, 24000.0 / 1001}) {
    image.attributes[kFramesPerSecond] = shortest(rate);
    write_exr(path, image);
    EXPECT_NEAR(frames_per_s(read_image(path)).value_or(0), rate, 1e-6);
    EXPECT_NE(test::slurp(path).find(std::string("framesPerSecond\0rational", 24)), std::string::npos);
  }
  for (const char* wrong : {"", "fast", "0", "-1", "nan", "inf", "24 fps"}) {
    image.attributes[kFramesPerSecond] = wrong;
    EXPECT_FALSE(frames_per_s(image)) << wrong;
    write_exr(path, image);
    EXPECT_FALSE(frames_per_s(read_image(path))) << wrong;
  }
}

TEST(Image, ChannelsAndLayers) {
  Image image(3, 2);
  image.channel("Z");
  EXPECT_TRUE(image.layers().empty());
  image.set_rgb("indirect", std::vector<Rgb>(6, Rgb(1, 2, 3)));
  image.set_rgb("", std::vector<Rgb>(6, Rgb(4, 5, 6)));
  EXPECT_EQ(image.layers(), (std::vector<std::string>{"", "indirect"}));
  EXPECT_EQ(image.rgb("indirect")[5], Rgb(1, 2, 3));
  EXPECT_THROW(std::as_const(image).channel("albedo.R"), std::out_of_range);
}

TEST(Exr, RoundTripIsExact) {
  Image image = random_image(37, 23, {"R", "G", "B", "indirect.R", "normal.X", "Z"});
  image.channel("Z")[0] = 1e30f, image.channel("Z")[1] = -0.0f, image.channel("Z")[2] = 1e-40f;
  image.channel("Z")[3] = INFINITY, image.channel("Z")[4] = NAN;
  image.attributes["phos.key"] = "abc\nd\"e";
  const Image back = decode_exr(encode_exr(image), "memory");
  EXPECT_EQ(back.attributes, image.attributes);
  ASSERT_EQ(back.channels().size(), image.channels().size());
  for (const auto& [name, values] : image.channels()) {
    const std::span<const float> read = std::as_const(back).channel(name);
    EXPECT_EQ(std::memcmp(read.data(), values.data(), values.size() * sizeof(float)), 0) << name;
  }
}

/// Whole blocks of 16 lines and parts of one, that shrink and that cannot; names beyond 31 letters are
/// flagged.
TEST(Exr, BlocksAndLongNames) {
  const std::string name = "a layer whose name is longer than that.R";
  for (const int height : {1, 15, 16, 17, 33})
    for (const bool noise : {false, true}) {
      Image image(700, height);
      const std::span<float> values = image.channel(name);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = noise ? std::bit_cast<float>(RandomStream(3, Stage::test, i).bits()) : 2.f;
      image.attributes["phos.an attribute with a long name"] = "value";
      const std::string bytes = encode_exr(image);
      EXPECT_EQ(bytes[5], 4) << "the flag of long names";
      EXPECT_EQ(noise, bytes.size() > values.size_bytes()) << height;
      const Image back = decode_exr(bytes, "memory");
      EXPECT_EQ(back.attributes, image.attributes);
      EXPECT_EQ(std::memcmp(std::as_const(back).channel(name).data(), values.data(), values.size_bytes()), 0)
          << height;
    }
}

TEST(Exr, SameBytesOnAnyNumberOfThreads) {
  const Image image = random_image(200, 150, {"R", "G", "B", "Z"});
  set_threads(1);
  const std::string one = encode_exr(image);
  set_threads(4);
  const std::string four = encode_exr(image);
  const Image back = decode_exr(four, "memory");
  set_threads(0);
  EXPECT_EQ(one, four);
  EXPECT_EQ(back.channels(), image.channels());
}

TEST(Hdr, RoundTripWithinOneStep) {
  for (const int width : {3, 8, 200, 33000}) {
    const int height = width > 1000 ? 1 : 5;
    Image image = random_image(width, height, {"R", "G", "B"});
    image.attributes["VIEW"] = "-vtv -vp 0 0 0";
    const Image back = decode_hdr(encode_hdr(image), "memory");
    ASSERT_EQ(back.width(), width);
    ASSERT_EQ(back.height(), height);
    EXPECT_EQ(back.attributes, image.attributes);
    const std::vector<Rgb> a = image.rgb(""), b = back.rgb("");
    for (std::size_t i = 0; i < a.size(); ++i) {
      // Half a step of 1/128 of the largest; up to 5 % where a pure Rec.709 colour lies outside Radiance's
      // primaries.
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[i][c], b[i][c], 0.05f * max_component(a[i])) << width << " " << i;
    }
  }
}

TEST(Hdr, FlatRowsRunLengthsAndLongRuns) {
  // One colour compresses to runs; both ways of writing must read the same.
  Image image(300, 4);
  image.set_rgb("", std::vector<Rgb>(1200, Rgb(10, 20, 30)));
  const std::string bytes = encode_hdr(image);
  EXPECT_LT(bytes.size(), 300u);
  const std::vector<Rgb> back = decode_hdr(bytes, "memory").rgb("");
  for (const Rgb& v : back) EXPECT_EQ(v, back[0]);
  // Old runs: a pixel, repeated 2 + 256 * 1 times, and one more pixel.
  std::string old = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 260\n";
  old += std::string("\x80\x80\x80\x81\x01\x01\x01\x02\x01\x01\x01\x01\x40\x40\x40\x81", 16);
  const Image decoded = decode_hdr(old, "memory");
  const std::vector<Rgb> v = decoded.rgb("");
  EXPECT_EQ(v[0], v[258]);
  EXPECT_NEAR(luminance(v[0]), 179 * 2 * 128.5 / 256, 1e-2);
  EXPECT_NEAR(luminance(v[259]), 179 * 2 * 64.5 / 256, 1e-2);
}

TEST(Hdr, ExposureCorrectionAndPhotometricUnit) {
  const std::string pixel("\x80\x80\x80\x81", 4);  // 2 * 128.5/256 = 1.00390625
  const auto read = [&](const std::string& lines) {
    return decode_hdr("#?RADIANCE\n" + lines + "\n-Y 1 +X 1\n" + pixel, "memory").rgb("")[0];
  };
  const double one = 179 * 1.00390625;
  const Rgb plain = read("FORMAT=32-bit_rle_rgbe\n");
  EXPECT_NEAR(luminance(plain), one, 1e-3 * one);
  EXPECT_NEAR(plain.x, plain.y, 1e-3 * one);  // grey stays grey
  EXPECT_NEAR(plain.x, plain.z, 1e-3 * one);
  EXPECT_NEAR(luminance(read("EXPOSURE=2\nEXPOSURE= 4\n")), one / 8, 1e-3 * one);
  EXPECT_NEAR(luminance(read("COLORCORR= 2 2 2\n")), one / 2, 1e-3 * one);
  EXPECT_NEAR(luminance(read("FORMAT=32-bit_rle_xyze\n")), 1.00390625, 1e-3);
  EXPECT_THROW(read("EXPOSURE=0\n"), Error);
  EXPECT_THROW(read("FORMAT=jpeg\n"), Error);
}

TEST(Hdr, EightOrientations) {
  // Pixels 1 (top left), 2 (top right), 3 (bottom left), 4 (bottom right), as exponents.
  const auto pixel = [](int n) { return std::string("\x80\x80\x80", 3) + static_cast<char>(128 + n); };
  const std::pair<const char*, std::array<int, 4>> cases[] = {
      {"-Y 2 +X 2", {1, 2, 3, 4}}, {"-Y 2 -X 2", {2, 1, 4, 3}}, {"+Y 2 +X 2", {3, 4, 1, 2}},
      {"+Y 2 -X 2", {4, 3, 2, 1}}, {"+X 2 -Y 2", {1, 3, 2, 4}}, {"-X 2 -Y 2", {2, 4, 1, 3}},
      {"+X 2 +Y 2", {3, 1, 4, 2}}, {"-X 2 +Y 2", {4, 2, 3, 1}}};
  for (const auto& [size, stored] : cases) {
    std::string bytes = text("#?RADIANCE\n\n", size, "\n");
    for (const int n : stored) bytes += pixel(n);
    const std::vector<Rgb> v = decode_hdr(bytes, "memory").rgb("");
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(luminance(v[i]) / (179 * 0.501953125), std::exp2(static_cast<double>(i + 1)), 1e-2) << size;
  }
}

TEST(Primaries, WhiteAndLuminanceAreKept) {
  const Mat3 m = convert_primaries(kRadiance, kRec709);
  const Rgb white = m * Rgb(1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-5);
  const Rgb weights(0.265f, 0.670f, 0.065f);  // Radiance color.h, rounded there
  for (int c = 0; c < 3; ++c) {
    Rgb one(0);
    one[c] = 1;
    EXPECT_NEAR(luminance(m * one), weights[c], 1e-3);
  }
  EXPECT_FALSE(is_valid({{0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}}));
}

TEST(Png, RoundTrip) {
  Picture picture{5, 3, {}};
  for (int i = 0; i < 45; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(5 * i));
  const Picture back = decode_png(encode_png(picture), "memory");
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.rgb, picture.rgb);
}

TEST(Files, ContentDecidesTheFormat) {
  const std::string folder = test::scratch("image_files");
  Image image(9, 4);
  image.set_rgb("", std::vector<Rgb>(36, Rgb(100)));
  write_exr(folder + "/a.hdr", image);
  write_hdr(folder + "/b.exr", image);
  EXPECT_EQ(read_image(folder + "/a.hdr").rgb("")[0], Rgb(100));
  EXPECT_NEAR(read_image(folder + "/b.exr").rgb("")[0].y, 100, 0.5);
  test::spill(folder + "/c.exr", "a text file");
  for (const char* bad : {"/c.exr", "/missing.exr"}) {
    try {
      read_image(folder + bad);
      FAIL() << bad;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_EQ(e.where(), folder + bad) << e.what();
    }
  }
  std::filesystem::remove_all(folder);
}

TEST(Files, OthersPictures) {
  const std::string env = test::shared("scenes/env");
  if (env.empty()) GTEST_SKIP() << "the shared scenes are not here";
  for (const char* name : {"memorial_photo.hdr", "night.hdr", "uffizi.hdr", "evalglare_testimage_fisheye.hdr",
                           "sky19.exr", "mitsuba_envmap.exr"}) {
    const Image image = read_image(env + "/" + name);
    EXPECT_GT(image.pixels(), 1000u) << name;
    double sum = 0;
    for (const Rgb& v : image.rgb("")) sum += luminance(v);
    EXPECT_TRUE(std::isfinite(sum) && sum > 0) << name;
  }
  EXPECT_TRUE(read_image(env + "/evalglare_testimage_fisheye.hdr").attributes.contains("VIEW"));
}

}  // namespace
}  // namespace phos
