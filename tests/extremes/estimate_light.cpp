// Lamps far from everyday ones, alone and beside each other, each against its closed form.
#include <gtest/gtest.h>

#include "core/random.h"
#include "direct/direct_light.h"
#include "estimate/gather.h"
#include "photon/events.h"
#include "support/gathered.h"
#include "support/limits.h"
#include "support/records.h"

namespace phos::test {
namespace {

/// Light straight from the lamps.
DirectIrradiance direct(const Scene& scene, const Vec3& p, const Vec3& n, int samples = 256) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RandomStream random(1, Stage::test, 0);
  return direct_irradiance(rays, lights, receiver(scene, p, n), samples, random);
}

constexpr double kSunCd_m2 = 1.6e9, kSunRadius_rad = 4.65e-3;

/// A square that looks as large as the sun, 100 m up.
void add_sun(Scene& scene) {
  const double half = 100 * kSunRadius_rad * std::sqrt(std::numbers::pi) / 2;
  const auto a = static_cast<float>(half);
  begin_instance(scene, "sun", add_lambert(scene, "sun", 0, static_cast<float>(kSunCd_m2)));
  add_quad(scene, {-a, 100, -a}, {2 * a, 0, 0}, {0, 0, 2 * a});
}
double sun_lx() {
  const double half = 100 * kSunRadius_rad * std::sqrt(std::numbers::pi) / 2;
  return std::numbers::pi * kSunCd_m2 * 4 * corner_form_factor_parallel(half, half, 100);
}

/// A floor half in the shade of a roof, a night-light under the roof.
Scene sun_and_night_light(bool sun, bool night) {
  Scene s;
  const std::uint32_t black = add_lambert(s, "black", 0);
  begin_instance(s, "floor", black);
  add_quad(s, {-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
  begin_instance(s, "roof", black);
  add_quad(s, {0, 2, -6}, {0, 0, 12}, {6, 0, 0});
  if (sun) add_sun(s);
  if (night) add_point_light(s, {3, 1, 0}, 1e-3f);
  finalize(s);
  return s;
}

TEST(Light, SunBesideANightLight) {
  const Vec3 up(0, 1, 0), bright(-3, 0, 0), shade(3, 0, 0.5f);
  const double night_there = point_over_plane_lx(1e-3, 1, 0.5),
               night_far = 1e-3 / std::pow(37.0, 1.5);  // 6 m aside, 1 m up; sees it under the roof
  const Scene both = sun_and_night_light(true, true), sun = sun_and_night_light(true, false),
              night = sun_and_night_light(false, true);
  const auto lux = [&](const Scene& s, const Vec3& p) {
    return static_cast<double>(direct(s, p, up).irradiance.y);
  };
  EXPECT_NEAR(lux(sun, bright) / sun_lx(), 1, 5e-3);
  EXPECT_EQ(lux(sun, shade), 0);
  EXPECT_NEAR(lux(night, shade) / night_there, 1, 1e-5);
  EXPECT_NEAR(lux(night, bright) / night_far, 1, 1e-5);
  EXPECT_NEAR(lux(both, shade) / night_there, 1, 1e-5);
  EXPECT_NEAR(lux(both, bright) / sun_lx(), 1, 5e-3);
  // Together, each lamp's own part is there.
  const RayScene rays(both);
  const Luminaires lights(both);
  RandomStream random(1, Stage::test, 0);
  std::vector<LampSample> samples;
  sample_lamps(rays, lights, receiver(both, bright, up), 64, random, samples);
  double of_night = 0;
  for (const LampSample& l : samples)
    if (lights[l.light].kind == Light::Kind::point) of_night += static_cast<double>(l.irradiance.y);
  EXPECT_NEAR(of_night / night_far, 1, 1e-5);
}

/// Photons too: the sun's flux is 1e9 times the night-light's, which still has its tenth of an equal share.
TEST(Light, PhotonsOfASunBesideANightLight) {
  const Scene both = sun_and_night_light(true, true);
  const Lit lit = light_up(both, 200000);
  RecordOptions options = all_light(both);
  const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
  const IrradianceRecord shade = record_at(maker, {3, 0, 0.5f}, {0, 1, 0}),
                         bright = record_at(maker, {-3, 0, 0}, {0, 1, 0});
  const double night = point_over_plane_lx(1e-3, 1, 0.5);
  EXPECT_NEAR(static_cast<double>(shade.irradiance.y) / night, 1,
              4.5 * static_cast<double>(shade.stderr_lx.y) / night + 0.1);
  EXPECT_NEAR(static_cast<double>(bright.irradiance.y) / sun_lx(), 1,
              4.5 * static_cast<double>(bright.stderr_lx.y) / sun_lx() + 0.05);
}

/// A spot ever thinner, of 1 lm: the whole lumen lands on the floor below, and lights just the disc that it
/// should.
TEST(Light, LaserThinSpots) {
  double last = 0, worst = 0;
  for (const double half_rad : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    Scene s;
    begin_instance(s, "floor", add_lambert(s, "black", 0));
    add_quad(s, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    Light spot;
    spot.kind = Light::Kind::spot, spot.name = "laser";
    spot.position = {0.1f, 1, 0.2f}, spot.direction = {0, -1, 0};
    spot.cos_inner = static_cast<decltype(spot.cos_inner)>(std::cos(half_rad));
    spot.cos_outer = spot.cos_inner;
    const double solid_angle = 4 * std::numbers::pi * std::pow(std::sin(half_rad / 2), 2);
    spot.intensity = Rgb(static_cast<float>(1 / solid_angle));
    s.light.push_back(spot);
    finalize(s);
    ASSERT_EQ(s.light.size(), 1u) << half_rad << ": " << (s.warnings.empty() ? "" : s.warnings[0].line());
    double off = std::fabs(static_cast<double>(s.light[0].flux_lm.y) - 1);
    const Lit lit = light_up(s, 2000);
    EXPECT_EQ(lit.photons.size(), 2000u);
    const double radius = std::tan(half_rad);
    double farthest = 0, mean2 = 0;
    for (const Vec3& p : lit.photons.position) {
      const double r = std::hypot(static_cast<double>(p.x) - static_cast<double>(0.1f),
                                  static_cast<double>(p.z) - static_cast<double>(0.2f));
      farthest = std::max(farthest, r), mean2 += r * r / 2000;
    }
    const double rounding = 2.5e-7;  // of positions, which are sums of products of 1
    EXPECT_LE(farthest, radius * (1 + 1e-5) + rounding) << half_rad;
    if (half_rad >= 1e-5) {
      EXPECT_NEAR(std::sqrt(2 * mean2) / radius, 1, 0.06) << half_rad;  // even over the disc
    }
    // In the middle of the disc, and 1.2 of its radii aside.
    const double middle = 1 / solid_angle;
    const double e = static_cast<double>(direct(s, {0.1f, 0, 0.2f}, {0, 1, 0}).irradiance.y);
    off = std::max(off, std::fabs(e / middle - 1));
    EXPECT_LT(off, 1e-2) << half_rad;
    if (half_rad >= 1e-5) {
      const auto beside = static_cast<float>(0.1f + 1.2 * radius);
      EXPECT_EQ(direct(s, {beside, 0, 0.2f}, {0, 1, 0}).irradiance.y, 0) << half_rad;
    }
    if (!(off < 1e-2)) break;
    last = half_rad, worst = std::max(worst, off);
  }
  expect_limit({"light of a spot", "half angle of the cone, rad", last, 0.1, worst, "below: not tested"});
}

/// 100 x 100 lamps over a floor: the sum of the closed forms.
TEST(Light, TenThousandLuminaires) {
  Scene s;
  begin_instance(s, "floor", add_lambert(s, "black", 0));
  add_quad(s, {-10, 0, -10}, {0, 0, 20}, {20, 0, 0});
  double law = 0;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      const float x = -9.9f + 0.2f * static_cast<float>(i), z = -9.9f + 0.2f * static_cast<float>(j);
      const float cd = (i + j) % 2 == 0 ? 1.f : 0.01f;
      add_point_light(s, {x, 3, z}, cd);
      law += point_over_plane_lx(static_cast<double>(cd), 3, std::hypot(double(x) - 0.5, double(z) + 1));
    }
  finalize(s);
  const double e = static_cast<double>(direct(s, {0.5f, 0, -1}, {0, 1, 0}).irradiance.y);
  EXPECT_NEAR(e / law, 1, 1e-5);
  const Lit lit = light_up(s, 200000);
  const DensityEstimator maker(lit.photons, *lit.rays, all_light(s), 1);
  const IrradianceRecord r = record_at(maker, {0.5f, 0, -1}, {0, 1, 0});
  EXPECT_NEAR(static_cast<double>(r.irradiance.y) / law, 1,
              4.5 * static_cast<double>(r.stderr_lx.y) / law + 0.01);
  // Rays that choose among the lamps, at the places that they find.
  EXPECT_NEAR(static_cast<double>(lit.photons.totals.emitted_flux_lm.y) / (5050.0 * 4 * std::numbers::pi), 1,
              1e-3);
}

/// A lamp in a closed box: not one photon, ray or lux gets out, however large the box, and wherever it stands
/// in a scene that was read from a file (16 diagonals off at most). Farther off, floats are so coarse that
/// one photon in ten thousand lands beyond the edge between two walls.
TEST(Light, NothingLeavesAClosedBox) {
  std::uint64_t paths = 0;
  double worst_leak = 0;
  for (const float size : {1e-3f, 1.f, 1e3f}) {
    for (const float away : {0.f, 4.f, 16.f, 1000.f}) {
      Scene s;
      const std::uint32_t grey = add_lambert(s, "grey", 0.8f);
      const Vec3 at = away * size * Vec3(1, 0.7f, -0.4f);
      begin_instance(s, "box", grey);
      add_room(s, at - size * Vec3(0.5f, 0.4f, 0.3f), at + size * Vec3(0.5f, 0.4f, 0.3f));
      begin_instance(s, "ground", grey);
      add_quad(s, at + size * Vec3(-5, -1, -5), {0, 0, 10 * size}, {10 * size, 0, 0});
      add_point_light(s, at + size * Vec3(0.1f, 0.2f, 0.1f), 100);
      finalize(s);
      const Lit lit = light_up(s, 20000);
      std::uint64_t outside = 0;
      for (const Vec3& p : lit.photons.position) outside += p.y < at.y - 0.5f * size;
      const double leak =
          static_cast<double>(lit.photons.totals.escaped_flux_lm.y) / (400 * std::numbers::pi);
      if (away > 16) {
        EXPECT_LT(leak, 1e-3);
        worst_leak = std::max(worst_leak, leak);
        continue;
      }
      EXPECT_EQ(outside, 0u) << size << " m, " << away << " sizes off";
      EXPECT_EQ(leak, 0) << size << " m, " << away << " sizes off";
      paths += 20000;
      const Gathered gathered(s);
      const RecordOptions options = gather_options(s, Quantity::all, 1, 256);
      const GatherEstimator estimator(gathered.rays, gathered.lights, {}, options, 1);
      for (const Vec3& p : {Vec3(0, -1, 0), Vec3(0.6f, -1, 0.2f)})
        EXPECT_EQ(record_at(estimator, at + size * p, {0, 1, 0}).irradiance, Rgb(0));
      EXPECT_EQ(direct(s, at + size * Vec3(0, 0.4f, 0), {0, 1, 0}).irradiance, Rgb(0)) << "on the lid";
    }
  }
  std::printf("1000 sizes off, %.2g of the flux gets out\n", worst_leak);
  expect_limit({"flux that leaks from a closed box", "offset of the coordinates, sizes", 0, 16, 0,
                "at 1000: 1e-4 of the flux"});
  std::printf("%llu paths from inside, none out\n", static_cast<unsigned long long>(paths));
}

/// Light of a square lamp through a slit in a board: under it, the strip of the lamp that shows through.
TEST(Light, ThroughASlit) {
  double last = 1, worst = 0;
  for (const float slit : {0.1f, 1e-2f, 1e-3f, 1e-4f, 1e-5f}) {
    Scene s;
    const std::uint32_t black = add_lambert(s, "black", 0);
    begin_instance(s, "floor", black);
    add_quad(s, {-3, 0, -3}, {0, 0, 6}, {6, 0, 0});
    begin_instance(s, "board", black);
    add_quad(s, {-3, 1, -3}, {0, 0, 6}, {3 - 0.5f * slit, 0, 0});
    add_quad(s, {0.5f * slit, 1, -3}, {0, 0, 6}, {3 - 0.5f * slit, 0, 0});
    begin_instance(s, "lamp", add_lambert(s, "lamp", 0, 1000));
    add_quad(s, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
    finalize(s);
    // Twice as high as the board: a strip twice as wide as the slit shows.
    const double law =
        std::numbers::pi * 1000 * 4 * corner_form_factor_parallel(static_cast<double>(slit), 1, 2);
    // Enough samples that a thousand of them fall into the strip, if that can be.
    const int samples = static_cast<int>(std::min(4e6, 1000 / static_cast<double>(slit)));
    const DirectIrradiance e = direct(s, {0, 0, 0}, {0, 1, 0}, samples);
    const double off = std::fabs(static_cast<double>(e.irradiance.y) / law - 1);
    if (slit < 1e-4f) {
      // Some forty samples show it; the stated error says so.
      EXPECT_LT(off, 4.5 * static_cast<double>(e.stderr_lx.y) / law + 0.02) << slit;
      continue;
    }
    EXPECT_LT(off, 0.02 + 4.5 * static_cast<double>(e.stderr_lx.y) / law) << slit;
    EXPECT_EQ(direct(s, {1.5f + 2 * slit, 0, 0}, {0, 1, 0}, 1000).irradiance.y, 0)
        << "the strip is off the lamp";
    last = static_cast<double>(slit), worst = std::max(worst, off);
  }
  expect_limit({"direct light of a lamp of 2 m through a slit", "width of the slit, m", last, 0.1, worst,
                "below: few samples find the slit, and the stated error says so", true});
}

/// Glass takes nothing: all that a lamp in a black room sends is found on the walls, whatever bends it.
TEST(Light, CausticsKeepTheirEnergy) {
  for (const Model model : {Model::dielectric, Model::thin_dielectric}) {
    for (const float ior : {1.0001f, 1.33f, 1.5f, 2.4f, 10.f}) {
      Scene s;
      begin_instance(s, "room", add_lambert(s, "black", 0));
      add_room(s, Vec3(-2), Vec3(2));
      AnalyticScene ball = integrating_sphere(0, 320, 0.7f);
      add_lambert(s, "glass", 0);
      s.material.back().model = model, s.material.back().ior = ior;
      begin_instance(s, "ball", 1);
      for (const Triangle& t : ball.scene.triangle)  // fronts outwards
        add_triangle(s, ball.scene.position[t.v[0]], ball.scene.position[t.v[2]],
                     ball.scene.position[t.v[1]]);
      add_point_light(s, {1.1f, 0.9f, 0.3f}, 100);
      add_point_light(s, {0.1f, -0.1f, 0.2f}, 1);  // in the glass
      finalize(s);
      PhotonTotals totals;
      Counters counters;
      const RayScene rays(s);
      PhotonOptions options;
      options.paths = 20000, options.caustic_paths = 0;  // aimed paths carry the same light in the mean alone
      const Photons photons = trace_photons(rays, options, 1, totals, counters);
      std::uint64_t caustic = 0;
      for (const std::uint8_t path : photons.path)
        caustic += path == static_cast<std::uint8_t>(PhotonPath::caustic);
      if (model == Model::dielectric) {
        EXPECT_GT(caustic, 500u);
      } else if (ior > 1.2f) {
        EXPECT_GT(caustic, 5u) << "what it reflects: passing is no event";
      }
      EXPECT_EQ(totals.escaped_flux_lm, Rgb(0)) << ior;
      const double lost =
          1 - static_cast<double>(totals.stored_flux_lm.y) / static_cast<double>(totals.emitted_flux_lm.y);
      // Roulette among what total reflection keeps long has the right mean, and noise; no lumen is
      // unaccounted for.
      const auto kept = static_cast<double>(counters[kKeptInGlassEvent]);
      EXPECT_LT(std::fabs(lost), 1e-6 + 3 * std::sqrt(kept) / 20000) << "ior " << ior;
      EXPECT_LT(kept, 50) << "ior " << ior;
      const double absorbed =
          static_cast<double>(totals.absorbed_flux_lm.y) / static_cast<double>(totals.emitted_flux_lm.y);
      EXPECT_NEAR(absorbed, 1, 1e-6) << "ior " << ior;
      EXPECT_EQ(counters[kNonFiniteEvent] + counters[kTooLongEvent], 0u) << "ior " << ior;
    }
  }
}

/// The sun ever lower over a floor: E falls as the sine.
TEST(Light, GrazingSun) {
  double last = 1, worst = 0;
  for (const double elevation : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    Scene s;
    begin_instance(s, "floor", add_lambert(s, "grey", 0.5f));
    add_quad(s, {-8, 0, -8}, {0, 0, 16}, {16, 0, 0});
    Light sun;
    sun.kind = Light::Kind::directional, sun.name = "sun", sun.intensity = Rgb(1e5f);
    sun.direction =
        Vec3(static_cast<float>(-std::cos(elevation)), static_cast<float>(-std::sin(elevation)), 0);
    s.light.push_back(sun);
    finalize(s);
    const double law = 1e5 * std::sin(elevation);
    const double off =
        std::fabs(static_cast<double>(direct(s, {0.3f, 0, 0.2f}, {0, 1, 0}).irradiance.y) / law - 1);
    EXPECT_LT(off, 1e-5) << elevation;
    last = elevation, worst = std::max(worst, off);
    // Photons: those that come down are on the front side, and carry what the floor gets.
    const Lit lit = light_up(s, 20000);
    const double floor_lm = law * 256;
    double front = 0;
    for (std::size_t i = 0; i < lit.photons.size(); ++i) {
      EXPECT_GT(decode_octahedral(lit.photons.normal[i]).y, 0);
      if (lit.photons.path[i] == static_cast<std::uint8_t>(PhotonPath::direct))
        front += static_cast<double>(lit.photons.flux[i].y);
    }
    const double one = static_cast<double>(lit.photons.totals.emitted_flux_lm.y) / 20000;
    EXPECT_NEAR(front, floor_lm, 4.5 * std::sqrt(floor_lm * one) + 1.01 * one) << elevation;
  }
  expect_limit(
      {"direct light of the sun", "elevation above the surface, rad", last, 1, worst, "below: not tested"});
}

}  // namespace
}  // namespace phos::test
