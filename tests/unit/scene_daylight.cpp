// Skies against closed forms and quadrature, the sun's place against an almanac, and what is refused.
#include "scene/sky/daylight.h"

#include <gtest/gtest.h>

#include <array>

#include "core/error.h"
#include "core/random.h"
#include "scene/sky/perez.h"
#include "scene/sky/sun_position.h"
#include "support/complaint.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;
double degrees(double rad) { return rad * 180 / kPiD; }
double radians(double deg) { return deg * kPiD / 180; }

Daylight day(const std::string& sky, const std::string& sun, double sky_lx, double albedo = 0) {
  DaylightOptions o;
  o.sky = sky, o.sun = sun, o.sky_lx = sky_lx, o.ground_albedo = albedo;
  if (!sun.empty()) o.sun_lx = 0;
  return resolve(o);
}

/// Irradiance of a surface with this normal by the upper hemisphere, by quadrature of its own: 180000
/// directions of equal solid angle.
template <class Luminance>
double quadrature_lx(const DVec3& normal, const Luminance& luminance, int n = 300) {
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double y = (i + 0.5) / n, sine = std::sqrt(1 - y * y);
    for (int k = 0; k < 2 * n; ++k) {
      const double phi = kPiD * (k + 0.5) / n;
      const DVec3 w(sine * std::cos(phi), y, sine * std::sin(phi));
      sum += std::max(glm::dot(w, normal), 0.0) * luminance(w);
    }
  }
  return sum * kPiD / (static_cast<double>(n) * n);
}

std::string complaint_of(const DaylightOptions& o) {
  return test::complaint_of([&] { resolve(o); }, ExitCode::usage);
}

}  // namespace

/// Each type has the horizontal illuminance that was asked for, the shape of the standard, and on walls the
/// illuminance of that shape.
TEST(Sky, OfEachTypeHasItsIlluminance) {
  for (int type = 1; type <= 16; ++type) {
    const Daylight d = day("cie:" + std::to_string(type), "200,35", 12345);
    const Environment sky = make_environment(d);
    EXPECT_NEAR(sky.irradiance_up_lx().y, 12345, 0.01) << type;
    const SkyShape shape = cie_sky(type);
    const auto relative = [&](const DVec3& w) { return shape.luminance(w.y, glm::dot(w, *d.towards_sun)); };
    const double scale = 12345 / quadrature_lx({0, 1, 0}, relative);
    double worst = 0;
    for (const DVec3& w :
         {DVec3(0, 1, 0), DVec3(0.6, 0.8, 0), DVec3(0, 0.3, -std::sqrt(0.91)), *d.towards_sun}) {
      const double found = static_cast<double>(sky.luminance(Vec3(w)).x);
      worst = std::max(worst, std::fabs(found / (scale * relative(w)) - 1));
    }
    EXPECT_LT(worst, 0.02) << type;
    for (const DVec3& n : {DVec3(1, 0, 0), DVec3(0, 0, 1), DVec3(0, 0.6, 0.8), DVec3(0, 0.6, -0.8)}) {
      const auto texel = [&](const DVec3& w) { return static_cast<double>(sky.luminance(Vec3(w)).x); };
      const double found = quadrature_lx(n, texel), truth = scale * quadrature_lx(n, relative);
      EXPECT_NEAR(found / truth, 1, 1e-3) << type << " " << n.x << " " << n.y << " " << n.z;
      RecordProperty("type_" + std::to_string(type), std::to_string(found / truth - 1));
    }
  }
}

TEST(Daylight, MoreThanTheSunGivesInSpaceIsToldOf) {
  DaylightOptions o;
  o.sky = "perez", o.sun = "180,60", o.diffuse_w_m2 = 100, o.direct_w_m2 = 900;
  EXPECT_TRUE(resolve(o).warnings.empty());
  o.direct_w_m2 = 1500;
  const Daylight d = resolve(o);
  ASSERT_EQ(d.warnings.size(), 1u);
  EXPECT_EQ(d.warnings[0].find("--direct-irradiance 1500 W/m2 is more than the 1361 W/m2"), 0u)
      << d.warnings[0];
  // In January the sun is nearer: 1361 / 0.9833^2 = 1408.
  o.sun.clear(), o.location = "-30,0", o.when = "2026-01-04T12:00+00:00";
  o.direct_w_m2 = 1400;
  EXPECT_TRUE(resolve(o).warnings.empty());
  o.direct_w_m2 = 1415;
  EXPECT_EQ(resolve(o).warnings.size(), 1u);

  DaylightOptions sun;
  sun.sun = "180,60", sun.sun_lx = 130000;
  EXPECT_TRUE(resolve(sun).warnings.empty());
  sun.sun_lx = 150000;
  EXPECT_EQ(resolve(sun).warnings.size(), 1u);
  sun.sun_lx.reset(), sun.sky = "clear", sun.sky_lx = 1e6;
  EXPECT_EQ(resolve(sun).warnings.size(), 1u);
}

/// Traditional overcast: E = pi Lz (1 + 2 x 2/3) / 3 = 7 pi Lz / 9, and a third of the zenith at the horizon.
/// Uniform: L = E / pi. Ground: albedo E / pi.
TEST(Sky, ClosedForms) {
  const Environment overcast = make_environment(day("overcast", "", 10000, 0.25));
  EXPECT_NEAR(overcast.luminance({0, 1, 0}).y, 90000 / (7 * kPiD), 0.05);
  EXPECT_NEAR(overcast.luminance({1, 1e-4f, 0}).y, 30000 / (7 * kPiD), 10);
  EXPECT_NEAR(overcast.luminance({0, -1, 0}).y, 2500 / kPiD, 0.01);
  EXPECT_NEAR(overcast.luminance({-1, -1e-4f, 0}).y, 2500 / kPiD, 0.01);
  const Environment uniform = make_environment(day("cie:5", "", 1000));
  EXPECT_NEAR(uniform.luminance({0.6f, 0.8f, 0}).y, 1000 / kPiD, 1e-2);
  EXPECT_EQ(uniform.luminance({0.6f, -0.8f, 0}).y, 0);
}

TEST(Sky, IsBrightestAboutTheSun) {
  for (const char* type : {"clear", "cie:8", "cie:11", "cie:13", "cie:15"}) {
    const Daylight d = day(type, "135,40", 20000);
    const Environment sky = make_environment(d);
    double most = 0;
    DVec3 where(0);
    for (int i = 0; i < 90; ++i)
      for (int k = 0; k < 360; ++k) {
        const double h = radians(i + 0.5), a = radians(k + 0.5);
        const DVec3 w(std::cos(h) * std::sin(a), std::sin(h), -std::cos(h) * std::cos(a));
        const auto l = static_cast<double>(sky.luminance(Vec3(w)).x);
        if (l > most) most = l, where = w;
      }
    EXPECT_LT(degrees(std::acos(std::min(glm::dot(where, *d.towards_sun), 1.0))), 3) << type;
    // South-east is +X and +Z, where north is -Z.
    EXPECT_GT(where.x, 0.3);
    EXPECT_GT(where.z, 0.3);
  }
}

/// Overcast is like CIE type 1, clear has a corona; illuminances are irradiance times plausible efficacies.
TEST(Sky, OfPerez) {
  const PerezSky grey = perez_sky({0, 150, radians(40), 1, 11});
  EXPECT_DOUBLE_EQ(grey.clearness, 1);
  EXPECT_LT(std::fabs(grey.shape.luminance(0.3, 0) / grey.shape.luminance(0.3, 1) - 1), 0.5);
  EXPECT_EQ(grey.sun_lx, 0);
  EXPECT_NEAR(grey.sky_lx / 150, 115, 15);
  const PerezSky clear = perez_sky({850, 90, radians(40), 1, 11});
  EXPECT_GT(clear.clearness, 6.2);
  EXPECT_GT(clear.shape.luminance(std::cos(radians(50)), 1),
            5 * clear.shape.luminance(std::cos(radians(50)), 0));
  EXPECT_NEAR(clear.sky_lx / 90, 130, 20);
  EXPECT_NEAR(clear.sun_lx / 850, 100, 10);
  // Epsilon and Delta by hand: Z = 50 deg = 0.8727 rad, 1.041 Z^3 = 0.6919, air mass 1.553.
  EXPECT_NEAR(clear.clearness, ((940.0 / 90) + 0.6919) / 1.6919, 1e-3);
  EXPECT_NEAR(clear.brightness, 90 * 1.553 / 1367, 1e-4);
  DaylightOptions o;
  o.sky = "perez", o.sun = "180,40", o.direct_w_m2 = 850, o.diffuse_w_m2 = 90;
  const Environment sky = make_environment(resolve(o));
  EXPECT_NEAR(sky.irradiance_up_lx().y, clear.sky_lx, 0.01);
  ASSERT_TRUE(sky.sun());
  EXPECT_NEAR(sky.sun()->illuminance_lx.y, clear.sun_lx, 0.1);
  o.sky_lx = 5000, o.sun_lx = 70000;
  const Daylight given = resolve(o);
  EXPECT_EQ(given.sky_lx, 5000);
  EXPECT_EQ(given.sun_lx, 70000);
}

/// Every bin, at every height of the sun: finite, and as bright as said.
TEST(Sky, OfPerezIsFiniteEverywhere) {
  int skies = 0;
  for (const double height : {2.0, 30.0, 89.0})
    for (const double direct : {0.0, 5.0, 40.0, 120.0, 300.0, 600.0, 900.0})
      for (const double diffuse : {20.0, 60.0, 150.0, 400.0}) {
        DaylightOptions o;
        o.sky = "perez", o.sun = "90," + std::to_string(height);
        o.direct_w_m2 = direct, o.diffuse_w_m2 = diffuse, o.sky_lx = 1000;
        try {
          const Daylight d = resolve(o);
          EXPECT_NEAR(make_environment(d).irradiance_up_lx().y, 1000, 1e-2) << height << direct << diffuse;
        } catch (const Error& e) {  // out of the model's range
          EXPECT_EQ(e.code(), ExitCode::usage);
          continue;
        }
        ++skies;
      }
  EXPECT_GT(skies, 45);
}

/// Samples lie in the disc and bring its illuminance; the map beside it stays as it was.
TEST(Sun, IsAnExactDisc) {
  DaylightOptions o;
  o.sky = "clear", o.sun = "120,30", o.sun_lx = 80000, o.sky_lx = 10000, o.sun_diameter_deg = 0.533;
  const Environment light = make_environment(resolve(o));
  ASSERT_TRUE(light.sun());
  const double radius = radians(0.2665);
  const Vec3 middle(light.sun()->towards);
  const double expected = 80000 / (kPiD * std::sin(radius) * std::sin(radius));
  EXPECT_NEAR(static_cast<double>(light.luminance(middle).y) / expected, 1, 1e-3);
  const auto beside = [&](double angle) {
    return Vec3(
        glm::normalize(light.sun()->towards +
                       std::tan(angle) * glm::normalize(glm::cross(light.sun()->towards, DVec3(0, 1, 0)))));
  };
  EXPECT_GT(light.luminance(beside(0.999 * radius)).y, 0.9 * expected);
  EXPECT_LT(light.luminance(beside(1.001 * radius)).y, 0.01 * expected);
  // Two estimates of the same two numbers: sun and sky on the ground.
  for (const bool flux : {false, true}) {
    double sum = 0, squares = 0;
    int in_disc = 0;
    constexpr int kSamples = 200000;
    for (std::uint64_t k = 0; k < kSamples; ++k) {
      RandomStream random(3, Stage::test, k);
      const Environment::Sample s =
          flux ? light.sample_flux(random.uniform2()) : light.sample(random.uniform2());
      const double cosine = std::max(0.0, static_cast<double>(s.direction.y));
      const double x = cosine * static_cast<double>(s.luminance.y) / static_cast<double>(s.density);
      sum += x, squares += x * x;
      const DVec3 apart = DVec3(s.direction) - light.sun()->towards;
      in_disc += glm::length(apart) < 2 * std::sin(radius / 2) * 1.0001;
    }
    const double mean = sum / kSamples, error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
    EXPECT_NEAR(mean, 10000 + 40000, 4 * error);
    EXPECT_GT(in_disc, kSamples / 4);
  }
  const DVec3 all = light.integral_lx();
  const Environment sky_only = make_environment(day("clear", "120,30", 10000));
  // What the ground reflects of the sun is in the map too.
  EXPECT_NEAR(all.y - sky_only.integral_lx().y, 80000 + 0.2 * 50000 * 2, 20);
}

/// Reda and Andreas 2004 (NREL/TP-560-34302), table A5.1 and A2.1; Meeus 1998, example 25.a.
TEST(Sun, StandsWhereTheAlmanacSays) {
  const SunPosition golden =
      sun_position(radians(39.742476), radians(-105.1786), parse_instant("", "2003-10-17T12:30:30-07:00"));
  EXPECT_NEAR(degrees(golden.azimuth_rad), 194.34024, 0.01);
  EXPECT_NEAR(90 - degrees(golden.elevation_rad), 50.11162, 0.01);  // theirs has 820 hPa
  EXPECT_NEAR(golden.distance_au, 0.9965422974, 2e-5);
  // At the pole, elevation is declination (below -1 degree not refracted), but for parallax.
  const SunPosition pole = sun_position(radians(90), 0, parse_instant("", "1992-10-13T00:00Z"));
  EXPECT_NEAR(degrees(pole.elevation_rad), -7.78507 - 8.794 / 3600, 0.002);
  EXPECT_NEAR(pole.distance_au, 0.99766, 1e-5);
  struct Edge {
    double latitude;
    const char* when;
  };
  // The upper limb touches the horizon: 16' below it the centre, with refraction by the almanac's 34'.
  for (const Edge& e : {Edge{35, "1994-01-02T07:08:13Z"}, Edge{35, "1994-01-02T16:59:56Z"},
                        Edge{-35, "1996-07-05T07:08:15Z"}, Edge{-35, "1996-07-05T17:01:04Z"},
                        Edge{-35, "2004-12-04T04:38:57Z"}, Edge{-35, "2004-12-04T19:02:02Z"}}) {
    const SunPosition s = sun_position(radians(e.latitude), 0, parse_instant("", e.when));
    EXPECT_NEAR(degrees(s.elevation_rad), -16.0 / 60, 0.06) << e.when;
  }
  // Morning in the east, noon in the north of the southern hemisphere, evening in the west.
  const auto azimuth = [](const char* when) {
    return degrees(sun_position(radians(-33.9), radians(18.4), parse_instant("", when)).azimuth_rad);
  };
  EXPECT_NEAR(azimuth("2026-03-20T07:00+02:00"), 88, 4);
  EXPECT_NEAR(std::fabs(std::remainder(azimuth("2026-03-20T12:54+02:00"), 360)), 0, 1);
  EXPECT_NEAR(azimuth("2026-03-20T18:30+02:00"), 273, 4);
}

TEST(Sun, ZonesAndSecondsCount) {
  const double noon = parse_instant("", "2026-06-21T12:00Z");
  EXPECT_EQ(parse_instant("", "2026-06-21T14:00+02:00"), noon);
  EXPECT_EQ(parse_instant("", "2026-06-21T06:30:00-05:30"), noon);
  EXPECT_EQ(parse_instant("", "2026-06-22T02:00:30+14:00"), noon + 30);
  EXPECT_EQ(parse_instant("", "1970-01-01T00:00Z"), 0);
  EXPECT_EQ(parse_instant("", "2000-03-01T00:00Z") - parse_instant("", "2000-02-29T00:00Z"), 86400);
  for (const char* bad :
       {"", "noon", "2026-06-21", "2026-06-21T14:00", "2026-06-21 14:00Z", "2026-02-30T12:00Z",
        "2026-13-01T12:00Z", "2026-06-21T24:00Z", "2026-06-21T12:60Z", "2026-06-21T12:00+2",
        "2026-06-21T12:00Zulu", "1850-06-21T12:00Z", "2026-06-21T12:00:75Z", "-026-06-21T12:00Z"})
    EXPECT_THROW(parse_instant("--when", bad), Error) << bad;
}

TEST(Daylight, DefaultsAreThoseOfTheHelp) {
  DaylightOptions o;
  o.sky = "clear", o.sun = "0,30";
  const Daylight clear = resolve(o);
  EXPECT_NEAR(clear.sky_lx, 800 + 15500 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(clear.sun_lx, 127500 * std::exp(-0.42), 1e-6);
  EXPECT_EQ(clear.ground_albedo, 0.2);
  EXPECT_NEAR(degrees(clear.sun_radius_rad), 0.2665, 1e-9);
  EXPECT_NEAR(clear.towards_sun->z, -std::sqrt(0.75), 1e-12);  // north is -Z
  o.north_deg = 90;
  EXPECT_NEAR(resolve(o).towards_sun->x, std::sqrt(0.75), 1e-12);
  o.sky = "overcast";
  EXPECT_NEAR(resolve(o).sky_lx, 10800, 1e-6);
  EXPECT_EQ(resolve(o).sun_lx, 0);
  o = {};
  o.sky = "overcast";
  EXPECT_EQ(resolve(o).sky_lx, 10000);
  EXPECT_FALSE(make_environment(resolve(o)).sun());
}

TEST(Daylight, SaysWhatIsWrong) {
  const auto refuse = [](const DaylightOptions& o, const char* part) {
    EXPECT_NE(complaint_of(o).find(part), std::string::npos) << complaint_of(o);
  };
  DaylightOptions o;
  o.sky = "clear";
  refuse(o, "brighter about the sun");
  o.sun = "180,-3";
  refuse(o, "3 degrees below the horizon");
  o.sun = "180;40";
  refuse(o, "AZIMUTH,ELEVATION");
  o.sun = "180,40", o.sky = "blue";
  refuse(o, "\"blue\" is not a sky");
  o.sky = "cie:17";
  refuse(o, "cie:1 to cie:16");
  o.sky = "perez";
  refuse(o, "--direct-irradiance: is missing");
  o.direct_w_m2 = 500, o.diffuse_w_m2 = 5000;
  refuse(o, "0.01 to 0.6");
  o = {}, o.location = "52,13";
  refuse(o, "--when: is missing");
  o.when = "2026-12-21T23:00+01:00";
  refuse(o, "below the horizon");
  o.when = "2026-12-21T12:00+01:00", o.sun = "1,1";
  refuse(o, "give one of the two");
  o = {}, o.location = "152,13", o.when = "2026-12-21T12:00+01:00";
  refuse(o, "is not on earth");
  o = {}, o.sky_lx = 100;
  refuse(o, "give --sky");
  o = {}, o.sun = "1,1", o.sun_lx = 0;
  refuse(o, "gives no light");
  o = {}, o.sky = "overcast", o.dew_point_c = 3;
  refuse(o, "needs --sky perez");
  EXPECT_EQ(complaint_of({}), "");
}

/// The same light has the same recipe, whichever way it was asked for; other light has another.
TEST(Daylight, IsKnownByItsRecipe) {
  const auto recipe = [](auto set) {
    DaylightOptions o;
    o.sky = "overcast";
    set(o);
    return make_environment(resolve(o)).recipe();
  };
  const std::string plain = recipe([](DaylightOptions&) {});
  EXPECT_FALSE(plain.empty());
  EXPECT_EQ(recipe([](DaylightOptions& o) { o.sky = "cie:16", o.sky_lx = 10000, o.ground_albedo = 0.2; }),
            plain);
  EXPECT_EQ(recipe([](DaylightOptions& o) { o.sun = "7,30", o.sky_lx = 10000; }), plain);
  EXPECT_NE(recipe([](DaylightOptions& o) { o.sky_lx = 9999; }), plain);
  EXPECT_NE(recipe([](DaylightOptions& o) { o.ground_albedo = 0.1; }), plain);
  EXPECT_NE(recipe([](DaylightOptions& o) { o.sky = "cie:1"; }), plain);
  const auto sunny = [&](const char* sun, double diameter) {
    return recipe([&](DaylightOptions& o) { o.sky = "clear", o.sun = sun, o.sun_diameter_deg = diameter; });
  };
  EXPECT_EQ(sunny("-350,20", 0.5), sunny("10,20", 0.5));
  EXPECT_NE(sunny("10,20", 0.5), sunny("10,20.01", 0.5));
  EXPECT_NE(sunny("10,20", 0.5), sunny("10,20", 0.6));
}

}  // namespace phos::test
