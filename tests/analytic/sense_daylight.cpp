// Sensors under skies and suns, against closed forms.
#include <gtest/gtest.h>

#include "core/error.h"
#include "direct/direct_light.h"
#include "scene/opening/find_portals.h"
#include "sense/daylight_factor.h"
#include "sense/sensor_table.h"
#include "support/daylight.h"

namespace phos::test {
namespace {

/// Direct light at a point that faces up, and its standard error.
std::pair<double, double> lx_at(const Scene& scene, const Vec3& p, int samples = 1024) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RandomStream random(1, Stage::direct_light, 7);
  const DirectIrradiance e = direct_irradiance(rays, lights, receiver(scene, p, {0, 1, 0}), samples, random);
  return {static_cast<double>(e.irradiance.y), static_cast<double>(e.stderr_lx.y)};
}

/// The factor of a sensor, and its standard error, as the table has them, in percent.
std::pair<double, double> factor_at(const Scene& scene, const Vec3& p, int samples = 4096) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  Sensors sensors;
  sensors.points = {{p, {0, 1, 0}}};
  SensorOptions options;
  options.direct_only = true, options.light_samples = samples;
  SensorReport report;
  const auto readings = read_light(sensors, rays, lights, {{}, nullptr}, options, report);
  const auto pieces = sensor_csv(sensors, readings, open_sky_lx(scene));
  EXPECT_TRUE(pieces[0].ends_with(",daylight_factor_percent,daylight_factor_stderr_percent\n"));
  const std::string& line = pieces[1];
  const std::size_t error = line.rfind(','), factor = line.rfind(',', error - 1);
  return {std::stod(line.substr(factor + 1)), std::stod(line.substr(error + 1))};
}

}  // namespace

TEST(Sensors, InTheOpenReadWhatWasAskedFor) {
  for (int type = 1; type <= 16; ++type) {
    Scene scene = open_floor();
    surround(scene, sky_of("cie:" + std::to_string(type), "250,40", 8000, 0));
    const auto [lx, error] = lx_at(scene, {0.1f, 0, 0.2f});
    EXPECT_NEAR(lx, 8000, 4 * error + 1) << type;
    EXPECT_LT(error, 80) << type;
  }
}

/// E = E_n sin(elevation) by the sun, in a scene of any size.
TEST(Sensors, InTheSunReadItsIlluminance) {
  for (const float metres : {1e-6f, 1.f, 1e6f})
    for (const double elevation : {3.0, 20.0, 60.0, 90.0}) {
      Scene scene = open_floor(metres);
      surround(scene, sky_of("", "30," + std::to_string(elevation), 0, 90000));
      const auto [lx, error] = lx_at(scene, {0, 0, 0}, 256);
      const double truth = 90000 * std::sin(glm::radians(elevation));
      EXPECT_NEAR(lx, truth, 4 * error + 1e-5 * truth) << metres << " " << elevation;
      EXPECT_LT(error, 2e-3 * truth) << elevation;
    }
}

/// Sun and sky together, one light: neither eats the other's samples.
TEST(Sensors, ReadSunAndSkyTogether) {
  Scene scene = open_floor();
  surround(scene, sky_of("clear", "30,30", 12000, 80000));
  const auto [lx, error] = lx_at(scene, {0, 0, 0});
  EXPECT_NEAR(lx, 52000, 4 * error + 5);
  EXPECT_LT(error, 0.005 * lx);
}

/// The sun in the zenith, an edge at height h: a penumbra as wide as h times the sun's angle, the disc's
/// segment in it.
TEST(Sensors, SeeThePenumbraOfTheSun) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    const float height = 2 * scale;
    Scene scene = under_an_edge(height, 3 * scale);
    surround(scene, sky_of("", "0,90", 0, 100000));
    const double radius = static_cast<double>(height) * std::tan(glm::radians(0.533 / 2));
    for (const double t : {-1.05, -0.7, -0.25, 0.0, 0.4, 0.9, 1.05}) {
      const auto [lx, error] = lx_at(scene, {static_cast<float>(t * radius), 0, 0.3f * scale}, 4096);
      EXPECT_NEAR(lx / 100000, seen_of_disc(t), 4 * error / 100000 + 2e-3) << t << " at " << scale;
      EXPECT_LT(error, 600);
    }
  }
}

TEST(DaylightFactor, IsAllInTheOpen) {
  for (const double lx : {1.0, 10000.0}) {
    Scene scene = open_floor();
    surround(scene, sky_of("overcast", "", lx));
    EXPECT_NEAR(open_sky_lx(scene), lx, 1e-5 * lx);
    const auto [factor, error] = factor_at(scene, {0.3f, 0, 0.1f});
    EXPECT_NEAR(factor, 100, 4 * error + 0.01);
    EXPECT_LT(error, 0.5);
  }
}

/// Behind a window of a black room: the integral of the overcast sky's luminance over it.
TEST(DaylightFactor, BehindAWindow) {
  Scene scene = room_with_window(0);
  surround(scene, sky_of("overcast", "", 5000));
  const auto overcast = [](const DVec3& w) { return 9 * 5000 / (7 * std::numbers::pi) * (1 + 2 * w.y) / 3; };
  for (const DVec3& p : {DVec3(2.5, 0, 3), DVec3(1, 0, 2.5), DVec3(2.5, 0.8, 2), DVec3(4, 0, 1)}) {
    const double truth = 100 * through_window_lx(p, overcast, 100) / 5000;
    const auto [factor, error] = factor_at(scene, Vec3(p), 65536);
    EXPECT_NEAR(factor, truth, 4 * error + 2e-3 * truth);
    EXPECT_LT(error, 0.05 * truth);
  }
}

/// The same light, at a small part of the noise: through portals that were found or named, that miss half of
/// the window, or that are elsewhere; overcast or with a sun that shines in; in a room of any size.
TEST(Portals, AimShadowRays) {
  const double sun_lx = 50000, height = glm::radians(35.0);
  const Environment overcast = sky_of("overcast", "", 5000), sunny = sky_of("clear", "180,35", 5000, sun_lx);
  for (const float metres : {1.f, 1e-6f, 1e6f}) {
    Scene scene = room_with_window(0);
    for (Vec3& p : scene.position) p *= metres;
    const Portal window{metres * Vec3(2, 1, 4), {{0, metres, 0}, {metres, 0, 0}}, false, {0, 0, -1}};
    Portal half = window, elsewhere = window;
    half.edge[1] *= 0.5f, elsewhere.corner.z = 0, elsewhere.inwards = Vec3(0, 0, 1);
    for (const bool sun : {false, true}) {
      surround(scene, sun ? sunny : overcast);
      const DVec3 p = sun ? DVec3(2.5, 0, 2) : DVec3(1.3, 0, 2);
      const double truth =
          (sun ? sun_lx * std::sin(height) : 0) +
          through_window_lx(
              p,
              [&](const DVec3& w) {
                return static_cast<double>(luminance(scene.environment->map_luminance(Vec3(w))));
              },
              100);
      const auto error_by = [&](const std::vector<Portal>& portals) {
        scene.portal = portals;
        const auto [lx, error] = lx_at(scene, Vec3(p) * metres, 16384);
        EXPECT_NEAR(lx, truth, 4 * error + 3e-3 * truth) << metres << " " << sun << " " << portals.size();
        return error;
      };
      const double blind = error_by({}), aimed = error_by({window});
      const double found = error_by(find_portals(RayScene(scene), "auto"));
      const double halved = error_by({half}), missed = error_by({elsewhere});
      if (sun) continue;  // of what the sun's samples leave, no portal takes away
      EXPECT_LT(aimed, 0.1 * blind);
      EXPECT_LT(found, 0.2 * blind);
      EXPECT_LT(halved, 6 * blind);
      EXPECT_LT(missed, 6 * blind);
    }
  }
}

TEST(DaylightFactor, IsOfTheSkyAlone) {
  const auto refused = [](Scene scene, const char* why) {
    try {
      open_sky_lx(scene);
      ADD_FAILURE() << why;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
  };
  Scene dark = open_floor();
  finalize(dark);
  refused(dark, "needs a sky");
  Scene sunny = open_floor();
  surround(sunny, sky_of("clear", "10,40"));
  refused(sunny, "a sun shines too");
  Scene lamp = open_floor();
  add_point_light(lamp, {0, 1, 0}, 5);
  surround(lamp, sky_of("overcast", ""));
  refused(lamp, "shines too; take it out");
  Scene below = open_floor();
  surround(below, map_of(8, [](int, int y) { return Rgb(y > 3 ? 1.f : 0.f); }));
  refused(below, "this sky gives none");
}

}  // namespace phos::test
