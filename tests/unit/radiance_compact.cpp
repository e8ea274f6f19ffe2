// Files of radiance records with short numbers: bounds of their errors, extremes, and that they stay the
// same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/random.h"
#include "radiance/cache.h"
#include "radiance/compact_columns.h"
#include "support/radiance_records.h"
#include "support/run.h"

namespace phos {
namespace {

using Numbers = std::vector<float>;

float greatest(const Numbers& v) {
  float most = 0;
  for (const float x : v) most = std::max(most, std::fabs(x));
  return most;
}

/// The numbers of a record of a file, [number][colour]; of band l stand from 3 l^2 on.
Numbers of_band(const Numbers& v, std::size_t l) {
  return {v.begin() + static_cast<std::ptrdiff_t>(3 * l * l),
          v.begin() + static_cast<std::ptrdiff_t>(3 * (l + 1) * (l + 1))};
}

const std::string& folder() {
  static const std::string path = test::scratch("radiance-compact");
  return path;
}

RadianceCache stored(const RadianceCache& cache, Store store, const std::string& name = "a") {
  const std::string path = folder() + "/" + name;
  write_radiance(path, cache, test::radiance_provenance(), store);
  return read_radiance(Container::open(path, FileKind::radiance));
}

/// Light of all sizes in one cache: record i times 10^(4 i - 20), bands that fall, signs of both kinds.
RadianceCache light_of_all_sizes() {
  RadianceCache cache = test::random_radiance({6, 6, 3, 6, 1, 6, 6, 5, 6, 6, 6});
  for (std::size_t i = 0; i < cache.records.size(); ++i) {
    RandomStream random(9, Stage::test, i);
    const float size = std::pow(10.f, 4.f * static_cast<float>(i) - 20);
    RadianceRecord& r = cache.records[i];
    for (Numbers* v : {&r.light, &r.gradient_x, &r.gradient_y})
      for (std::size_t k = 0; k < v->size(); ++k)
        (*v)[k] = (2 * random.uniform() - 1) * size / static_cast<float>(1 + k * k);
    for (float& x : r.stderr_light) x *= 0.1f * size;
  }
  return cache;
}

void expect_within_bounds(const RadianceRecord& a, const RadianceRecord& b) {
  const float most = std::max(greatest(a.light), greatest(a.stderr_light));
  const auto expect_light = [&](const Numbers& x, const Numbers& y) {
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      EXPECT_LE(std::fabs(x[k] - y[k]), std::max(std::ldexp(std::fabs(x[k]), -11), std::ldexp(most, -39)))
          << k;
  };
  expect_light(a.light, b.light);
  expect_light(a.stderr_light, b.stderr_light);
  ASSERT_EQ(a.gradient_x.size(), b.gradient_x.size());
  for (std::size_t l = 0; l < static_cast<std::size_t>(a.order()); ++l) {
    const Numbers x = of_band(a.gradient_x, l), y = of_band(a.gradient_y, l), x2 = of_band(b.gradient_x, l),
                  y2 = of_band(b.gradient_y, l);
    const float bound = std::max(greatest(x), greatest(y)) / 127;
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_LE(std::fabs(x[k] - x2[k]), bound) << l << ' ' << k;
      EXPECT_LE(std::fabs(y[k] - y2[k]), bound) << l << ' ' << k;
    }
  }
}

TEST(CompactRadiance, ErrorsAreWithinBoundsForLightOfAnySize) {
  const RadianceCache cache = light_of_all_sizes(), back = stored(cache, Store::compact);
  ASSERT_EQ(back.records.size(), cache.records.size());
  for (std::size_t i = 0; i < cache.records.size(); ++i) {
    SCOPED_TRACE(i);
    const RadianceRecord &a = cache.records[i], &b = back.records[i];
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.radius_m, b.radius_m);
    EXPECT_EQ(a.order(), b.order());
    expect_within_bounds(a, b);
  }
}

TEST(CompactRadiance, StaysTheSameOnceItIsCompact) {
  const RadianceCache once = stored(light_of_all_sizes(), Store::compact, "once"),
                      twice = stored(once, Store::compact, "twice"), floats = stored(twice, Store::floats);
  EXPECT_EQ(test::slurp(folder() + "/once"), test::slurp(folder() + "/twice"));
  for (std::size_t i = 0; i < once.records.size(); ++i) {
    EXPECT_EQ(once.records[i].light, floats.records[i].light);
    EXPECT_EQ(once.records[i].gradient_x, floats.records[i].gradient_x);
    EXPECT_EQ(once.records[i].stderr_light, floats.records[i].stderr_light);
  }
}

/// Records of order 10, which a Phong lobe of exponent 22 needs.
TEST(CompactRadiance, BytesOfARecord) {
  const RadianceCache cache = test::random_radiance(1000, 10);
  stored(cache, Store::floats, "long"), stored(cache, Store::compact, "short");
  const auto bytes = [&](const char* name) {
    return static_cast<double>(std::filesystem::file_size(folder() + "/" + name)) / 1000;
  };
  EXPECT_NEAR(bytes("long"), 3764, 10);
  EXPECT_NEAR(bytes("short"), 1318, 10);
}

TEST(CompactRadiance, WithoutGradients) {
  RadianceCache cache = test::random_radiance(3, 4);
  for (RadianceRecord& r : cache.records) r.gradient_x.clear(), r.gradient_y.clear();
  const RadianceCache back = stored(cache, Store::compact);
  EXPECT_TRUE(back.records[2].gradient_x.empty());
  EXPECT_TRUE(stored({}, Store::compact).records.empty());
}

// --- columns ---

constexpr float kLeast = std::numeric_limits<float>::min(), kMost = std::numeric_limits<float>::max();

TEST(HalfColumns, Extremes) {
  for (const float size :
       {0.f, std::numeric_limits<float>::denorm_min(), kLeast, 1e-30f, 1.f, 1e30f, kMost}) {
    const Numbers row{size, -size / 3, 0.f, size / 1000};
    const HalfColumns halves(1, {row});
    EXPECT_GE(halves.unit[0], kLeast) << size;
    const bool none = size < kLeast;
    if (none) {
      EXPECT_EQ(halves.unit[0], 1) << size;
    }
    for (std::size_t k = 0; k < row.size(); ++k) {
      const float back = static_cast<float>(halves.columns[0][k]) * halves.unit[0];
      // Units of the least floats are as large as these.
      const float step = size < 1e-30f ? std::ldexp(kLeast, -11) : 0;
      const float within = none ? 0.f : std::max(std::ldexp(std::fabs(row[k]), -11), step);
      EXPECT_NEAR(back, none ? 0.f : row[k], within) << size << ' ' << k;
    }
  }
}

TEST(HalfColumns, AreOfOneUnitARecord) {
  const Numbers light{1, 2, 3, 1e20f, 2e20f, 3e20f}, error{100, 0};
  const HalfColumns halves(2, {light, error});
  ASSERT_EQ(halves.unit.size(), 2u);
  EXPECT_EQ(halves.unit[0], std::ldexp(1.f, 6 - 14)) << "64 <= 100 < 128, as 2^14 <= half < 2^15";
  EXPECT_EQ(static_cast<float>(halves.columns[0][2]) * halves.unit[0], 3);
  EXPECT_EQ(static_cast<float>(halves.columns[1][0]) * halves.unit[0], 100);
  EXPECT_NEAR(static_cast<float>(halves.columns[0][5]) * halves.unit[1], 3e20f, 3e20f / 2048);
}

TEST(ByteColumns, Extremes) {
  for (const float size :
       {0.f, std::numeric_limits<float>::denorm_min(), kLeast, 1e-30f, 1.f, 1e30f, kMost}) {
    const Numbers x{size, -size, size / 2}, y{-size / 3, 0.f, size / 1000};  // one band, three colours
    const ByteColumns bytes(1, 1, {x, y});
    const bool none = size < kLeast;
    if (none) {
      EXPECT_EQ(bytes.exponent[0], 0) << size;
    }
    const double unit = std::ldexp(1.0, bytes.exponent[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double bound = none ? static_cast<double>(kLeast) : size == kMost ? unit : 0.5 * unit;
      EXPECT_LE(std::fabs(bytes.columns[0][k] * unit - static_cast<double>(x[k])), bound) << size;
      EXPECT_LE(std::fabs(bytes.columns[1][k] * unit - static_cast<double>(y[k])), bound) << size;
    }
    if (size >= 1e-30f) {
      EXPECT_LE(unit, static_cast<double>(size) / 63.5) << size;
    }
  }
}

TEST(ByteColumns, HaveAnExponentForEachBandOfBothColumns) {
  Numbers x(3 * 4), y(3 * 4);
  x[0] = 127, x[5] = 1.25f;  // red, band 0; green, band 1
  y[10] = -100;              // blue, band 1
  const ByteColumns bytes(1, 2, {x, y});
  EXPECT_EQ(bytes.exponent, (std::vector<std::int8_t>{0, 0}));
  EXPECT_EQ(bytes.columns[0][0], 127);
  EXPECT_EQ(bytes.columns[0][5], 1);
  EXPECT_EQ(bytes.columns[1][10], -100);
}

}  // namespace
}  // namespace phos
