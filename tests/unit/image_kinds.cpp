// Pictures in other colour spaces, and sound pictures of kinds that are not read.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "image/exr/decode.h"
#include "image/exr/encode.h"
#include "image/hdr.h"
#include "image/primaries.h"
#include "support/complaint.h"
#include "support/run.h"

namespace phos {
namespace {

constexpr Primaries kAcesAp0{{0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}};
constexpr Primaries kCieXyz{{1, 0}, {0, 1}, {0, 0}, {1.f / 3, 1.f / 3}};
constexpr Primaries kRomm{{0.7347f, 0.2653f}, {0.1596f, 0.8404f}, {0.0366f, 0.0001f}, {0.3457f, 0.3585f}};

/// Where the value of an attribute of a header begins.
std::size_t value_of(const std::string& file, const std::string& name, const std::string& type) {
  const std::string key = name + '\0' + type + '\0';
  const std::size_t at = file.find(key);
  EXPECT_NE(at, std::string::npos) << name;
  return at + key.size() + 4;
}

/// A picture of one colour, stored with these chromaticities.
std::string exr_of(const Rgb& colour, const Primaries& primaries) {
  Image image(4, 4);
  image.set_rgb("", std::vector<Rgb>(16, colour));
  std::string file = encode_exr(image);
  std::memcpy(file.data() + value_of(file, "chromaticities", "chromaticities"), &primaries, 32);
  return file;
}

Rgb first_pixel(const std::string& exr) { return decode_exr(exr, "memory").rgb("")[0]; }

void expect_grey(const Rgb& c, float value) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(c[i], value, 1e-4f * value);
}

TEST(ColourSpaces, WhiteStaysWhite) {
  for (const Primaries& p : {kAcesAp0, kCieXyz, kRomm, kRec709}) {
    EXPECT_TRUE(is_valid(p));
    expect_grey(first_pixel(exr_of(Rgb(100), p)), 100);
  }
}

TEST(ColourSpaces, ComponentsOfXyzAreWhatTheyAre) {
  // Y alone is luminance; X and Z have none.
  EXPECT_NEAR(luminance(first_pixel(exr_of({0, 70, 0}, kCieXyz))), 70, 0.02);
  EXPECT_NEAR(luminance(first_pixel(exr_of({70, 0, 0}, kCieXyz))), 0, 0.02);
  EXPECT_NEAR(luminance(first_pixel(exr_of({0, 0, 70}, kCieXyz))), 0, 0.02);
  const Mat3 identity = rgb_to_xyz(kCieXyz);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(identity[i][j], i == j, 1e-6);
}

TEST(ColourSpaces, LuminanceOfAcesIsItsSecondRow) {
  // SMPTE ST 2065-1: Y = 0.3439664498 R + 0.7281660966 G - 0.0721325464 B.
  const Mat3 m = rgb_to_xyz(kAcesAp0);
  EXPECT_NEAR(m[0][1], 0.3439664498, 1e-5);
  EXPECT_NEAR(m[1][1], 0.7281660966, 1e-5);
  EXPECT_NEAR(m[2][1], -0.0721325464, 1e-5);
  EXPECT_NEAR(luminance(first_pixel(exr_of({10, 20, 30}, kAcesAp0))), 3.4397 + 14.5633 - 2.1640, 1e-2);
}

TEST(ColourSpaces, WhatSpansNone) {
  Primaries p = kRec709;
  p.white = {0.3f, 0};
  EXPECT_FALSE(is_valid(p));
  p.white = {0.3f, 0.7f};
  EXPECT_FALSE(is_valid(p)) << "no Z";
  p = kRec709, p.blue = {0.47f, 0.465f};
  EXPECT_FALSE(is_valid(p)) << "on a line";
  p = kRec709, p.red.x = NAN;
  EXPECT_FALSE(is_valid(p));
  const std::string why = test::complaint_of([&] { first_pixel(exr_of(Rgb(1), p)); });
  EXPECT_NE(why.find("not a colour space"), std::string::npos) << why;
}

TEST(ColourSpaces, ZerosAreNoneGiven) {
  const std::string pixel("\x80\x80\x80\x80", 4);  // 128.5 / 256
  const auto hdr = [&](const std::string& line) {
    return decode_hdr("#?RADIANCE\n" + line + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + pixel, "memory")
        .rgb("")[0];
  };
  EXPECT_EQ(hdr("PRIMARIES=0 0 0 0 0 0 0 0\n"), hdr(""));
  EXPECT_EQ(hdr("PRIMARIES= 0.0 0 0 0 0 0 0.000 0\n"), hdr(""));
  EXPECT_THROW(hdr("PRIMARIES=0 0 0 0 0 0 0.3333 0.3333\n"), Error);
  EXPECT_EQ(first_pixel(exr_of(Rgb(7), {Vec2(0), Vec2(0), Vec2(0), Vec2(0)})), Rgb(7));
}

std::string complaint_of_exr(const std::string& file) {
  return test::complaint_of([&] { decode_exr(file, "a.exr"); });
}

TEST(UnreadKinds, SubsampledChroma) {
  std::string file = exr_of(Rgb(1), kRec709);
  // Of a channel: name, type, four flags, xSampling, ySampling.
  const std::size_t blue = value_of(file, "channels", "chlist");
  file[blue + 2 + 4 + 4] = 2, file[blue + 2 + 4 + 4 + 4] = 2;
  const std::string why = complaint_of_exr(file);
  EXPECT_NE(why.find("a.exr: has subsampled chroma (B), which phos does not read"), std::string::npos) << why;
  EXPECT_EQ(why.find("damaged"), std::string::npos) << why;
}

TEST(UnreadKinds, LaterCompressions) {
  std::string file = exr_of(Rgb(1), kRec709);
  const std::size_t at = value_of(file, "compression", "compression");
  file[at] = 11;
  const std::string why = complaint_of_exr(file);
  EXPECT_NE(why.find("has compression 11 of OpenEXR, which phos does not read"), std::string::npos) << why;
  file[at] = 100;
  EXPECT_NE(complaint_of_exr(file).find("damaged"), std::string::npos);
}

TEST(UnreadKinds, FormatsOfRadiance) {
  const std::string why = test::complaint_of(
      [] { decode_hdr("#?RADIANCE\nNCOMP=8\nFORMAT=Radiance_spectra\n\n-Y 1 +X 1\n", "a.hdr"); });
  EXPECT_NE(why.find("has the FORMAT \"Radiance_spectra\", which phos does not read"), std::string::npos)
      << why;
}

TEST(UnreadKinds, TruncatedOnesAreDamaged) {
  const std::string file = exr_of(Rgb(1), kAcesAp0);
  for (std::size_t n = 4; n < file.size(); n += 7)
    EXPECT_NE(complaint_of_exr(file.substr(0, n)).find("damaged or truncated"), std::string::npos) << n;
}

TEST(UnreadKinds, SharedFilesOfOtherSpaces) {
  const std::string folder = test::shared("faults/11-photoshop-hdr-and-aces-xyz-exr-refused");
  if (folder.empty()) GTEST_SKIP() << "the shared faults are not here";
  for (const char* name : {"aces-ap0", "acescg", "prophoto", "xyz"}) {
    const Image image = read_image(folder + "/" + name + ".exr");
    expect_grey(image.rgb("")[0], 100);
  }
  EXPECT_NEAR(luminance(read_image(folder + "/photoshop.hdr").rgb("")[0]), 128.5 / 128 * 179, 0.05);
}

}  // namespace
}  // namespace phos
