// Sensors of any size and strength, where no sensor should be, and very many of them.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "sense/grid.h"
#include "sense/sensor_points.h"
#include "sense/sensor_table.h"
#include "support/sensors.h"

namespace phos::test {
namespace {

void expect_finite(const std::vector<Reading>& readings) {
  for (const Reading& r : readings) {
    for (const float v : {r.illuminance_lx, r.stderr_lx, r.direct_lx, r.indirect_lx}) {
      EXPECT_TRUE(std::isfinite(v));
      EXPECT_GE(v, 0);
    }
  }
}

TEST(SensorExtremes, TheSameLuxAtEverySizeAndPower) {
  for (const float size : {1e-6f, 1.f, 1e6f}) {
    for (const float luminance : {1e-12f, 1.f, 1e12f}) {
      const AnalyticScene s = scaled(furnace(0.5f, luminance), size);
      const auto indirect = static_cast<float>(s.mean_irradiance_lx / 2);
      const Container file = even_cache("scaled", s.scene, s.checks, indirect, 3 * size, Quantity::indirect);
      Sensors sensors = sensors_at(s.checks);
      sensors.points.push_back({size * Vec3(1, 0.5f, 0.75f), {0, 1, 0}});  // in free air
      SensorOptions options;
      options.rays = 256;
      const Read read = read_sensors_of(s.scene, sensors, {file}, options);
      expect_finite(read.readings);
      for (const Reading& r : read.readings)
        EXPECT_NEAR(double(r.illuminance_lx) / s.mean_irradiance_lx, 1, 0.15) << size << " " << luminance;
      EXPECT_EQ(read.report.inside.size(), 0u);
    }
  }
}

TEST(SensorExtremes, SensorsWhereNobodyWouldPutThem) {
  const AnalyticScene s = furnace(0.5f, 100);
  const Container file = even_cache("odd", s.scene, s.checks, 100, 3, Quantity::indirect);
  Sensors sensors;
  const Vec3 up(0, 1, 0);
  for (const Vec3& p : {Vec3(1, -1, 0.7f), Vec3(1e9f), Vec3(-1e15f, 0, 0), Vec3(1e18f), Vec3(0),
                        Vec3(2, 1, 1.5f), Vec3(1, 2, 0.7f)})
    for (const Vec3& n : {up, -up, Vec3(1, 0, 0)}) sensors.points.push_back({p, n});
  SensorOptions options;
  options.rays = 64;
  const Read read = read_sensors_of(s.scene, sensors, {file}, options);
  expect_finite(read.readings);
  EXPECT_EQ(read.report.outside, 15u);
  EXPECT_GE(read.report.inside.size(), 6u);  // near the room, behind its walls
}

TEST(SensorExtremes, NoSensorsAndNoRecords) {
  const AnalyticScene s = furnace(0.5f, 100);
  const Container file = even_cache("few", s.scene, s.checks, 100, 3, Quantity::indirect);
  EXPECT_TRUE(read_sensors_of(s.scene, {}, {file}, {}).readings.empty());
  const Container none = even_cache("none", s.scene, {}, 100, 3, Quantity::indirect);
  SensorOptions options;
  options.rays = 64;
  expect_finite(read_sensors_of(s.scene, sensors_at(s.checks), {none}, options).readings);
}

TEST(SensorExtremes, AHundredThousandAtOnePlaceShareOneRecord) {
  const AnalyticScene s = furnace(0.5f, 100);
  const Container file = even_cache("crowd", s.scene, s.checks, 100, 0.2f, Quantity::indirect);
  Sensors sensors;
  sensors.points.assign(100000, {{1, 0.5f, 0.75f}, {0, 1, 0}});
  SensorOptions options;
  options.rays = 64, options.light_samples = 1;
  const Read read = read_sensors_of(s.scene, sensors, {file}, options);
  EXPECT_EQ(read.report.uncovered, 100000u);
  EXPECT_EQ(read.report.records_made, 1u);
  expect_finite(read.readings);
}

TEST(SensorExtremes, SameTableOnAnyNumberOfThreads) {
  const AnalyticScene s = furnace(0.5f, 100);
  const Container file = even_cache("threads", s.scene, s.checks, 100, 0.5f, Quantity::indirect);
  const RayScene rays(s.scene);
  GridOptions grid;
  grid.spacing_m = 0.05, grid.height_m = 0.5;
  SensorOptions options;
  options.rays = 64;
  std::string table[2];
  for (const int threads : {1, 2}) {
    set_threads(threads);
    const Sensors sensors = workplane(rays, grid);
    EXPECT_EQ(sensors.points.size(), 40u * 30u);
    for (const std::string& piece :
         sensor_csv(sensors, read_sensors_of(s.scene, sensors, {file}, options).readings))
      table[threads - 1] += piece;
  }
  set_threads(0);
  EXPECT_TRUE(table[0] == table[1]);
}

TEST(SensorExtremes, NoiseIsRefusedInOneLineOrRead) {
  const std::string good = "id,x,y,z,nx,ny,nz\n\"a, b\",1,2,3,0,0,1\n# c\nd,-1e-3,+2,3,0,1,0\r\n";
  const std::string letters = "\",\n\r #0123456789.+-eExyzni\t\xef\xbb\xbf[]";
  int read = 0, refused = 0;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    RandomStream random(8, Stage::test, k);
    std::string bad = good;
    for (std::uint32_t times = 1 + random.bits() % 3; times > 0; --times) {
      const std::size_t at = random.bits() % bad.size();
      const char letter = random.bits() % 4 ? letters[random.bits() % letters.size()]
                                            : static_cast<char>(random.bits() % 256);
      if (random.bits() % 3 == 0)
        bad.erase(at, 1 + random.bits() % 4);
      else
        bad[at] = letter;
      if (bad.empty()) bad = ",";
    }
    try {
      for (const SurfaceSample& p : parse_sensors(bad, "p").points)
        ASSERT_TRUE(is_finite(p.position) && std::fabs(glm::length(p.normal) - 1) < 1e-5f);
      ++read;
    } catch (const Error& e) {
      ASSERT_EQ(e.code(), ExitCode::bad_input);
      ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      ++refused;
    }
  }
  EXPECT_GT(read, 500);
  EXPECT_GT(refused, 5000);
}

TEST(SensorExtremes, AMillionLines) {
  std::string lines = "x,y,z,nx,ny,nz\r\n";
  for (int i = 0; i < 1000000; ++i) lines += "1.25,-2e-3,3,0,1,0\r\n";
  EXPECT_EQ(parse_sensors(lines, "p").points.size(), 1000000u);
}

}  // namespace
}  // namespace phos::test
