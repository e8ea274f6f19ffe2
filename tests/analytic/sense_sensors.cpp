// Sensors where the light is known in closed form.
#include <gtest/gtest.h>

#include "core/error.h"
#include "sense/grid.h"
#include "sense/sensor_table.h"
#include "support/cutouts.h"
#include "support/sensors.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;

TEST(SensorsAnalytic, DirectLightOfPointsAndRectangles) {
  for (const AnalyticScene& s :
       {point_light_over_plane(), rectangle_light_parallel(), rectangle_light_perpendicular()}) {
    SensorOptions options;
    options.direct_only = true;
    options.light_samples = 1024;
    const Read read = read_sensors_of(s.scene, sensors_at(s.checks), {}, options);
    for (std::size_t i = 0; i < s.checks.size(); ++i) {
      const Reading& r = read.readings[i];
      const double expected = s.checks[i].irradiance_lx;
      EXPECT_NEAR(double(r.illuminance_lx), expected, 0.005 * expected) << s.name;
      EXPECT_LT(std::fabs(double(r.illuminance_lx) - expected), 3 * double(r.stderr_lx) + 1e-4 * expected);
      EXPECT_EQ(r.direct_lx, r.illuminance_lx);
      EXPECT_EQ(r.indirect_lx, 0);
    }
    EXPECT_EQ(read.report.uncovered, 0u);
  }
}

/// The edge of what is cut out costs samples.
TEST(SensorsAnalytic, LampsThatAreCutOut) {
  for (const AnalyticScene& s : cut_out_lamps()) {
    SensorOptions options;
    options.direct_only = true;
    options.light_samples = 1 << 16;
    const Read read = read_sensors_of(s.scene, sensors_at(s.checks), {}, options);
    for (std::size_t i = 0; i < s.checks.size(); ++i) {
      const double expected = s.checks[i].irradiance_lx;
      EXPECT_NEAR(double(read.readings[i].illuminance_lx), expected, 0.003 * expected) << s.name;
    }
  }
}

/// Glowing walls of albedo rho: M / (1 - rho), of which M is direct and the rest comes from the cache.
TEST(SensorsAnalytic, AFurnaceThroughItsCache) {
  for (const float albedo : {0.1f, 0.5f, 0.9f}) {
    const AnalyticScene s = furnace(albedo, 100);
    const double direct = 100 * kPiD, indirect = s.mean_irradiance_lx - direct;
    const Container file =
        even_cache("furnace", s.scene, s.checks, static_cast<float>(indirect), 3, Quantity::indirect);
    const Read read = read_sensors_of(s.scene, sensors_at(s.checks), {file}, {});
    EXPECT_EQ(read.report.uncovered, 0u);
    EXPECT_EQ(read.report.inside.size(), 0u);
    for (const Reading& r : read.readings) {
      EXPECT_NEAR(double(r.indirect_lx), indirect, 1e-4 * indirect);
      EXPECT_LT(std::fabs(double(r.direct_lx) - direct), 4 * double(r.stderr_lx));
      EXPECT_NEAR(double(r.illuminance_lx), double(r.direct_lx) + double(r.indirect_lx), 1e-2);
      EXPECT_GT(double(r.stderr_lx), 0.0099 * indirect);
    }
  }
}

/// In free air no record is near: new ones are made from what rays read of the cache on the walls.
TEST(SensorsAnalytic, FreeAirIsServedByRecordsMadeThere) {
  const AnalyticScene s = furnace(0.5f, 100);
  const double direct = 100 * kPiD, indirect = s.mean_irradiance_lx - direct;
  std::vector<Check>
      walls;  // near enough to each other to cover the walls, and nothing half a hand above them
  for (int i = 0; i < 1500; ++i) {
    RandomStream random(3, Stage::test, static_cast<std::uint64_t>(i));
    Check wall = s.checks[random.bits() % s.checks.size()];
    const Vec3 along = Vec3(2, 1, 1.5f) * Vec3(random.uniform(), random.uniform(), random.uniform());
    for (int axis = 0; axis < 3; ++axis)
      if (wall.normal[axis] == 0) wall.position[axis] = along[axis];
    walls.push_back(wall);
  }
  const Container file =
      even_cache("air", s.scene, walls, static_cast<float>(indirect), 0.3f, Quantity::indirect);
  Sensors sensors;
  for (int i = 0; i < 160; ++i) {
    RandomStream random(4, Stage::test, static_cast<std::uint64_t>(i));
    const Vec3 u(random.uniform(), random.uniform(), random.uniform());
    sensors.points.push_back(
        {Vec3(0.2f) + u * Vec3(1.6f, 0.6f, 1.1f), i % 2 ? Vec3(0, 1, 0) : Vec3(0, 0.6f, 0.8f)});
  }
  for (const LeakTest leak_test : {LeakTest::none, LeakTest::ray}) {
    SensorOptions options;
    options.leak_test = leak_test;
    options.light_samples = 1024;
    const Read read = read_sensors_of(s.scene, sensors, {file}, options);
    EXPECT_GT(read.report.uncovered, 150u);
    EXPECT_GT(read.report.records_made, 0u);
    EXPECT_LT(read.report.records_made, read.report.uncovered);
    double mean = 0, stated = 0;
    for (const Reading& r : read.readings) {
      mean += double(r.indirect_lx) / 160, stated += double(r.stderr_lx) / 160;
      EXPECT_NEAR(double(r.illuminance_lx), s.mean_irradiance_lx, 8 * double(r.stderr_lx) + 0.02 * indirect);
    }
    EXPECT_NEAR(mean, indirect, 0.03 * indirect);
    EXPECT_LT(stated, 0.2 * indirect);
  }
}

/// A cache of all light: the whole is its own, and what is left beside the direct light is noise alone.
TEST(SensorsAnalytic, CachesOfAllLightAreNotLitTwice) {
  const AnalyticScene s = emitting_environment(100);
  const float whole = static_cast<float>(100 * kPiD);
  const Container file = even_cache("all", s.scene, s.checks, whole, 1, Quantity::all);
  SensorOptions options;
  options.light_samples = 1024;
  const Read read = read_sensors_of(s.scene, sensors_at(s.checks), {file}, options);
  for (const Reading& r : read.readings) {
    EXPECT_NEAR(r.illuminance_lx, whole, 1e-3f);
    EXPECT_NEAR(r.direct_lx, whole, 0.02f * whole);
    EXPECT_GE(r.indirect_lx, 0);
    EXPECT_LT(r.indirect_lx, 0.02f * whole);
    // Each record's own is 1 %; where several are blended, that part of it is left which is not their own.
    EXPECT_LE(r.stderr_lx, 0.0101f * whole);
    EXPECT_GE(r.stderr_lx, 0.01f * std::sqrt(kSharedByZones) * whole);
  }
  // Without shadow rays the whole is the same, and its parts are not told apart.
  options.light_samples = 0;
  const Read quick = read_sensors_of(s.scene, sensors_at(s.checks), {file}, options);
  for (std::size_t i = 0; i < quick.readings.size(); ++i) {
    EXPECT_EQ(quick.readings[i].illuminance_lx, read.readings[i].illuminance_lx);
    EXPECT_EQ(quick.readings[i].stderr_lx, read.readings[i].stderr_lx);
    EXPECT_TRUE(std::isnan(quick.readings[i].direct_lx) && std::isnan(quick.readings[i].indirect_lx));
  }
  EXPECT_EQ(quick.report.inside, read.report.inside);
  const std::string row = sensor_csv(sensors_at(s.checks), quick.readings).at(1);
  EXPECT_EQ(row.substr(row.find('\n') - 2, 2), ",,") << row;
  // What the cache does not cover is measured all the same.
  std::vector<Check> none;
  const Container empty = even_cache("empty", s.scene, none, whole, 1, Quantity::all);
  for (const Reading& r : read_sensors_of(s.scene, sensors_at(s.checks), {empty}, options).readings)
    EXPECT_NEAR(r.illuminance_lx, whole, 0.1f * whole);
  const Container other = even_cache("indirect", s.scene, s.checks, 1, 1, Quantity::indirect);
  EXPECT_THROW(SensorCaches(std::vector<Container>{file, other}, nullptr), Error);
}

TEST(SensorsAnalytic, SeveralCachesAreOne) {
  const AnalyticScene s = furnace(0.5f, 100);
  const std::vector<Check> some(s.checks.begin(), s.checks.begin() + 3),
      rest(s.checks.begin() + 3, s.checks.end());
  const Container all = even_cache("whole", s.scene, s.checks, 77, 3, Quantity::indirect),
                  first = even_cache("first", s.scene, some, 77, 3, Quantity::indirect),
                  second = even_cache("second", s.scene, rest, 77, 3, Quantity::indirect);
  const Read one = read_sensors_of(s.scene, sensors_at(s.checks), {all}, {}),
             two = read_sensors_of(s.scene, sensors_at(s.checks), {first, second}, {});
  EXPECT_EQ(two.report.uncovered, 0u);
  for (std::size_t i = 0; i < one.readings.size(); ++i)
    EXPECT_NEAR(one.readings[i].illuminance_lx, two.readings[i].illuminance_lx, 1e-3f);
}

/// Records on the lit wall, large enough to be taken for the dark one a centimetre behind it.
TEST(SensorsAnalytic, TheLeakTestKeepsThinWallsDark) {
  const AnalyticScene s = thin_walls(1000, 0.01f);
  std::vector<Check> lit, dark;
  for (const Check& check : s.checks) (check.irradiance_lx > 0 ? lit : dark).push_back(check);
  const Container file = even_cache("walls", s.scene, lit, 1000, 3, Quantity::indirect);
  double leaked[2] = {0, 0};
  for (const LeakTest leak_test : {LeakTest::none, LeakTest::ray}) {
    SensorOptions options;
    options.leak_test = leak_test;
    for (const Reading& r : read_sensors_of(s.scene, sensors_at(dark), {file}, options).readings) {
      EXPECT_EQ(r.direct_lx, 0);
      leaked[leak_test == LeakTest::ray] += double(r.illuminance_lx);
    }
  }
  EXPECT_GT(leaked[0], 100);
  EXPECT_LT(leaked[1], 1);
}

/// A lamp of I cd at height h over a square floor: I h / d^3 over the grid's points.
TEST(SensorsAnalytic, StatisticsOfAGridOnAKnownField) {
  const AnalyticScene s =
      point_light_over_plane(2, 1000, 0);  // a floor of 16 x 16 m, the lamp over its middle
  GridOptions grid;
  grid.spacing_m = 1, grid.mesh = "floor";
  const Sensors sensors = mesh_grid(s.scene, grid);
  ASSERT_EQ(sensors.points.size(), 256u);
  SensorOptions options;
  options.direct_only = true;
  const Json summary = summarise(read_sensors_of(s.scene, sensors, {}, options).readings);
  double sum = 0;
  for (int i = 0; i < 16; ++i)
    for (int k = 0; k < 16; ++k) sum += point_over_plane_lx(1000, 2, std::hypot(i - 7.5, k - 7.5));
  const double mean = sum / 256, most = point_over_plane_lx(1000, 2, std::hypot(0.5, 0.5)),
               least = point_over_plane_lx(1000, 2, std::hypot(7.5, 7.5));
  EXPECT_NEAR(summary.find("mean_lx")->as_number() / mean, 1, 1e-4);
  EXPECT_NEAR(summary.find("max_lx")->as_number() / most, 1, 1e-4);
  EXPECT_NEAR(summary.find("min_lx")->as_number() / least, 1, 1e-4);
  EXPECT_NEAR(summary.find("U0")->as_number() / (least / mean), 1, 1e-4);
  EXPECT_NEAR(summary.find("Ud")->as_number() / (least / most), 1, 1e-4);
}

TEST(SensorsAnalytic, AnExactWholeIsSplitByTheDirectLight) {
  const AnalyticScene s = point_light_over_plane(2, 1000, 0);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  SensorReport report;
  std::vector<Whole> whole;
  for (const Check& check : s.checks) whole.push_back({check.irradiance_lx + 5, 0.25});
  const std::vector<Reading> readings =
      read_light_exactly(sensors_at(s.checks), rays, lights, whole, {}, report);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(double(readings[i].illuminance_lx), s.checks[i].irradiance_lx + 5, 1e-3);
    EXPECT_NEAR(readings[i].indirect_lx, 5, 0.02);
    EXPECT_EQ(readings[i].stderr_lx, 0.25f);
  }
}

}  // namespace
}  // namespace phos::test
