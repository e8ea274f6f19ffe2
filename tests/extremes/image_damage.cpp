// Damaged image files: every reader ends with an Error or with a picture of the size that the file can hold.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "image/exr/decode.h"
#include "image/exr/encode.h"
#include "image/hdr.h"
#include "image/png.h"
#include "support/run.h"

namespace phos {
namespace {

constexpr std::size_t kMostPixels = 16u << 20;  // what the readers allow to a short file

Image small_image() {
  Image image(29, 21);
  RandomStream random(3, Stage::test, 1);
  for (const char* name : {"R", "G", "B", "indirect.R", "Z"})
    for (float& v : image.channel(name)) v = 100 * random.uniform();
  image.attributes["phos.key"] = "0123456789abcdef";
  return image;
}

/// Runs `decode` on every truncation and on bytes flipped all over, at most about `trials` of each; returns
/// how many were refused.
template <class Decode>
int damage(const std::string& bytes, std::size_t trials, const Decode& decode) {
  int refused = 0;
  const auto attempt = [&](const std::string& s) {
    try {
      EXPECT_LE(decode(s), kMostPixels);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      ++refused;
    }
  };
  const std::size_t header = std::min<std::size_t>(bytes.size(), 700);
  const std::size_t step = std::max<std::size_t>(1, bytes.size() / trials);
  for (std::size_t n = 0; n < bytes.size(); n += step) attempt(bytes.substr(0, n));
  RandomStream random(5, Stage::test, bytes.size());
  for (std::size_t i = 0; i < trials; ++i) {
    std::string s = bytes;
    const std::size_t range = i % 2 == 0 ? header : bytes.size();
    for (std::size_t flips = 1 + random.bits() % 3; flips > 0; --flips)
      s[random.bits() % range] = static_cast<char>(random.bits());
    attempt(s);
  }
  return refused;
}

std::size_t pixels(const Image& image) {
  for (const auto& [name, values] : image.channels()) EXPECT_EQ(values.size(), image.pixels());
  return image.pixels();
}

TEST(Damage, Exr) {
  set_threads(1);
  const std::string bytes = encode_exr(small_image());
  const int refused =
      damage(bytes, 1500, [](const std::string& s) { return pixels(decode_exr(s, "x.exr")); });
  set_threads(0);
  EXPECT_GT(refused, 1500);  // every truncation at least
}

TEST(Damage, ExrOfOthers) {
  const std::string path = test::shared("scenes/env/sky19.exr");
  if (path.empty()) GTEST_SKIP() << "the shared scenes are not here";
  const std::string bytes = test::slurp(path);
  EXPECT_GT(damage(bytes, 40, [](const std::string& s) { return pixels(decode_exr(s, "x.exr")); }), 38);
}

TEST(Damage, Hdr) {
  const std::string bytes = encode_hdr(small_image());
  const int refused = damage(bytes, 3000, [](const std::string& s) {
    const Image image = decode_hdr(s, "x.hdr");
    for (const Rgb& v : image.rgb("")) EXPECT_TRUE(is_finite(v));
    return pixels(image);
  });
  EXPECT_GT(refused, 2000);
}

TEST(Damage, Png) {
  Picture picture{31, 17, {}};
  RandomStream random(9, Stage::test, 2);
  for (int i = 0; i < 3 * 31 * 17; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(random.bits() & 63));
  const int refused = damage(encode_png(picture), 1500, [](const std::string& s) {
    const Picture p = decode_png(s, "x.png");
    return static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  });
  EXPECT_GT(refused, 1000);
}

TEST(Damage, HeaderThatAsksForTerabytes) {
  EXPECT_THROW(decode_hdr("#?RADIANCE\n\n-Y 99999999 +X 99999999\n\1\2\3\4", "x.hdr"), Error);
  Image image(8, 8);
  image.channel("Y");
  std::string bytes = encode_exr(image);
  const std::size_t window =
      bytes.find("dataWindow") + std::string("dataWindow\0box2i\0\0\0\0\0", 21).size() + 8;
  bytes[window + 2] = 1;  // 65,536 more columns
  bytes[window + 6] = 1;  // and rows
  EXPECT_THROW(decode_exr(bytes, "x.exr"), Error);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20) << "kB";
}

}  // namespace
}  // namespace phos
