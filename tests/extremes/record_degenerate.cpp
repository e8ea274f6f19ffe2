// Sets of photons and shapes that break the geometry of estimates: each gives the closed form where there is
// one, else something finite, not negative and counted.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "direct/direct_light.h"
#include "hsh/basis.h"
#include "radiance/cache.h"
#include "support/landed.h"
#include "support/limits.h"
#include "support/records.h"

namespace phos::test {
namespace {

/// A floor of 16 m with photons of the caller's.
struct Floor {
  Floor() : scene(point_light_over_plane()), rays(scene.scene) {}

  IrradianceRecord record(const PhotonMap& map, const Vec3& p, Estimate estimate, const Vec3& n = {0, 1, 0}) {
    RecordOptions options;
    options.estimate = estimate, options.paths = Quantity::all;
    options.resolve(scene.scene.bounds.diagonal_m() / 4);
    const DensityEstimator maker(map, rays, options, 1);
    const auto worker = maker.make_worker();
    const IrradianceRecord r = maker.make({p, n, 0}, *worker).record;
    counters.merge(worker->counters);
    EXPECT_TRUE(is_finite(r.irradiance) && is_finite(r.stderr_lx));
    EXPECT_TRUE(r.radius_m > 0 && std::isfinite(r.radius_m));
    EXPECT_GE(r.irradiance.y, 0);
    for (int c = 0; c < 3; ++c)
      EXPECT_TRUE(is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]));
    return r;
  }

  AnalyticScene scene;
  RayScene rays;
  Counters counters;
};

constexpr Estimate kBoth[] = {Estimate::hull, Estimate::kernel};

/// `n` places evenly at random over the square of half side `a`.
std::vector<Landed> scattered(int n, float a, float flux_lm = 1, const Vec3& direction = {0, 1, 0}) {
  std::vector<Landed> landed;
  for (int i = 0; i < n; ++i) {
    RandomStream random(7, Stage::test, static_cast<std::uint64_t>(i));
    const Vec2 p = a * (2.f * random.uniform2() - 1.f);
    landed.push_back({{p.x, 0, p.y}, direction, flux_lm});
  }
  return landed;
}

/// However many photons lie in one point: their flux is over the zone, which is never smaller than that of
/// the least radius, and the zone is known to have no hull.
TEST(Degenerate, CoincidentUpToAMillion) {
  Floor floor;
  for (const int n : {10, 1000, 100000, 1000000}) {
    const PhotonMap map = map_of(std::vector<Landed>(static_cast<std::size_t>(n), {{0.5f, 0, 0.5f}}));
    for (const Estimate estimate : kBoth) {
      const IrradianceRecord beside = floor.record(map, {0.4f, 0, 0.5f}, estimate),
                             there = floor.record(map, {0.5f, 0, 0.5f}, estimate);
      EXPECT_GT(beside.irradiance.y, 0) << n;
      EXPECT_GT(there.irradiance.y, 0) << n;
      // A zone of 0.1 m at least holds all of them: at most n / (pi 0.01) lx.
      EXPECT_LE(beside.irradiance.y, 1.01f * static_cast<float>(n) / (kPi * 0.01f)) << n;
    }
  }
  EXPECT_GE(floor.counters["records with degenerate hull"] + floor.counters["records with too few photons"],
            8u);
}

/// One photon outshines a million others. Away from it the density of the others is right; on it, all the
/// flux of the zone is there, and the standard error says that it is one photon's.
TEST(Degenerate, OneHugeAndAMillionTiny) {
  Floor floor;
  for (const float huge : {1e6f, 1e12f}) {
    std::vector<Landed> landed = scattered(1000000, 4);
    landed.push_back({{1.5f, 0, 1.5f}, {0, 1, 0}, huge});
    const PhotonMap map = map_of(landed);
    const double even = 1000000 / 64.0;
    for (const Estimate estimate : kBoth) {
      for (const Vec3& p : {Vec3(0), Vec3(-2, 0, 1)}) {
        const IrradianceRecord r = floor.record(map, p, estimate);
        EXPECT_NEAR(static_cast<double>(r.irradiance.y) / even, 1,
                    4.5 * static_cast<double>(r.stderr_lx.y) / even);
        EXPECT_LT(r.stderr_lx.y, 0.15f * r.irradiance.y);
      }
      const IrradianceRecord on = floor.record(map, {1.52f, 0, 1.5f}, estimate);
      EXPECT_GT(on.irradiance.y, 0.5 * even + 0.1 * static_cast<double>(huge)) << huge;
      EXPECT_GT(on.stderr_lx.y, 0.9f * on.irradiance.y) << "one photon, and known to be";
    }
  }
}

/// All from one direction, ever nearer to the surface: flux is what counts, not where it came from.
TEST(Degenerate, AllFromOneDirectionDownToGrazing) {
  Floor floor;
  const double even = 20000 / 64.0;
  double last = 90;
  for (const double elevation : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const Vec3 from(static_cast<float>(std::cos(elevation)), static_cast<float>(std::sin(elevation)), 0);
    const PhotonMap map = map_of(scattered(20000, 4, 1, from));
    bool right = true;
    for (const Estimate estimate : kBoth)
      for (const Vec3& p : {Vec3(0.3f, 0, 0.2f), Vec3(-1, 0, 1)}) {
        const IrradianceRecord r = floor.record(map, p, estimate);
        right = right && std::fabs(static_cast<double>(r.irradiance.y) - even) <
                             4.5 * static_cast<double>(r.stderr_lx.y);
      }
    EXPECT_TRUE(right) << elevation << " rad above the surface";
    if (right) last = elevation;
  }
  expect_limit({"irradiance from photons of one direction", "elevation above the surface, rad", last, kPi / 2,
                0, "not tested"});
}

/// Light to one side of a wall that stands on the floor stays there, up to the wall's foot.
TEST(Degenerate, ZonesSplitByAWall) {
  AnalyticScene s = point_light_over_plane();
  begin_instance(s.scene, "wall", 0);
  add_quad(s.scene, {0, 0, -8}, {0, 0, 16}, {0, 4, 0});
  s.scene.light.clear();
  add_point_light(s.scene, {2, 2, 0}, 1);
  finalize(s.scene);
  const RayScene rays(s.scene);
  std::vector<Landed> landed;
  for (Landed l : scattered(40000, 4)) {
    if (l.position.x > 0) landed.push_back(l);
  }
  const PhotonMap map = map_of(landed);
  const double even = 40000 / 64.0;
  RecordOptions options;
  options.paths = Quantity::all;
  options.resolve(s.scene.bounds.diagonal_m() / 4);
  const DensityEstimator maker(map, rays, options, 1);
  double leak = 0, least = 1;
  for (const float x : {1.f, 0.3f, 0.1f, 0.03f, 0.01f, 1e-3f, 1e-4f, 1e-5f}) {
    const IrradianceRecord lit = record_at(maker, {x, 0, 0.5f}, {0, 1, 0}),
                           dark = record_at(maker, {-x, 0, 0.5f}, {0, 1, 0});
    leak = std::max(leak, static_cast<double>(dark.irradiance.y) / even);
    EXPECT_EQ(dark.irradiance.y, 0) << x;
    EXPECT_NEAR(static_cast<double>(lit.irradiance.y) / even, 1,
                4.5 * static_cast<double>(lit.stderr_lx.y) / even)
        << x;
    least = static_cast<double>(x);
  }
  expect_limit({"irradiance beside a wall, lit on the other side", "distance from the wall, m", least, 1,
                leak, "nearer: not tested"});
}

/// Towards the corner of three planes, in a furnace: the same light all the way.
TEST(Degenerate, CornerOfThreePlanes) {
  const AnalyticScene s = furnace(0.5f);
  const Lit lit = light_up(s.scene, 200000);
  const DensityEstimator maker(lit.photons, *lit.rays, all_light(s.scene), 1);
  double worst = 0, least = 1;
  for (const float d : {0.3f, 0.1f, 1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p(d), n(0);
      p[axis] = 0, n[axis] = 1;
      const IrradianceRecord r = record_at(maker, p, n);
      const double off = static_cast<double>(r.irradiance.y) - s.mean_irradiance_lx;
      EXPECT_LT(std::fabs(off), 4.5 * static_cast<double>(r.stderr_lx.y)) << d;
      worst =
          std::max(worst, (std::fabs(off) - 4.5 * static_cast<double>(r.stderr_lx.y)) / s.mean_irradiance_lx);
    }
    least = static_cast<double>(d);
  }
  expect_limit({"irradiance from photons in a corner", "distance from three walls, m", least, 0.3,
                std::max(worst, 0.0), "nearer: not tested", true});
}

/// The dark side of a wall ever thinner, and of a sheet without any thickness.
TEST(Degenerate, ThinWalls) {
  double thinnest = 1;
  for (const float gap : {0.1f, 1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f}) {
    const AnalyticScene s = thin_walls(1000, gap);
    const Lit lit = light_up(s.scene, 20000);
    const DensityEstimator maker(lit.photons, *lit.rays, all_light(s.scene), 1);
    float leak = 0;
    for (const Check& check : s.checks)
      if (!(check.irradiance_lx > 0))
        leak = std::max(leak, record_at(maker, check.position, check.normal).irradiance.y);
    if (gap >= 1e-4f) {
      EXPECT_EQ(leak, 0) << gap << " m";
    }
    if (leak > 0) break;
    thinnest = static_cast<double>(gap);
  }
  expect_limit(
      {"dark side of two walls of 4 m, lit from one side", "gap between the walls, m", thinnest, 0.1, 0,
       "below: one wall is taken for the other, because the gap is within the rounding of positions"});
}

/// A triangle of 1 m by ever less, as a lamp: its light at 1 m is its area's, seen from afar.
TEST(Degenerate, NeedleLamps) {
  double worst = 0, last = 1;
  for (const double aspect : {1e1, 1e3, 1e5, 1e7, 1e9, 1e12}) {
    AnalyticScene s = point_light_over_plane(1, 1);
    s.scene.light.clear();
    begin_instance(s.scene, "needle", add_lambert(s.scene, "glow", 0, 1000));
    add_triangle(s.scene, {-0.5f, 1, 0}, {0.5f, 1, 0}, {0, 1, static_cast<float>(1 / aspect)});
    finalize(s.scene);
    const RayScene rays(s.scene);
    const Luminaires lights(s.scene);
    RandomStream random(1, Stage::test, 0);
    const DirectIrradiance e =
        direct_irradiance(rays, lights, receiver(s.scene, Vec3(0), {0, 1, 0}), 4096, random);
    // Width w(x) = w0 (1 - 2|x|), at height 1: E = L int w / (1 + x2)^2 dx.
    double law = 0;
    for (int i = 0; i < 100000; ++i) {
      const double x = (i + 0.5) / 100000 - 0.5, d2 = 1 + x * x;
      law += 1000 * (1 - 2 * std::fabs(x)) / aspect / (d2 * d2) / 100000;
    }
    const double off = std::fabs(static_cast<double>(e.irradiance.y) / law - 1);
    // Of the slimmer ones, across too: their depth counts at the widest.
    EXPECT_LT(off, aspect > 50 ? 2e-3 : 0.1) << aspect;
    if (aspect > 50) worst = std::max(worst, off);
    last = aspect;
  }
  expect_limit(
      {"direct light of a needle", "aspect ratio of the triangle", 1e3, last, worst, "above: not tested"});
}

/// A surface cut into needles: the same irradiance on it as on one that is whole.
TEST(Degenerate, NeedleFloors) {
  for (const float aspect : {1e2f, 1e4f, 1e6f, 1e7f}) {
    AnalyticScene s = point_light_over_plane(1, 100);
    const float w = 8 / aspect;
    // Needles of 8 m by w beside the middle, in place of a strip that is cut out of the floor.
    s.scene.triangle.clear(), s.scene.triangle_instance.clear(), s.scene.instance.clear();
    s.scene.position.clear(), s.scene.normal.clear();
    begin_instance(s.scene, "floor", 0);
    add_quad(s.scene, {-4, 0, -4}, {0, 0, 8}, {4, 0, 0});
    add_triangle(s.scene, {0, 0, -4}, {0, 0, 4}, {w, 0, -4});
    add_triangle(s.scene, {w, 0, -4}, {0, 0, 4}, {w, 0, 4});
    add_quad(s.scene, {w, 0, -4}, {0, 0, 8}, {4 - w, 0, 0});
    finalize(s.scene);
    const Lit lit = light_up(s.scene, 100000);
    std::uint64_t escaped_down = 0;
    for (const Vec3& p : lit.photons.position) escaped_down += p.y < -1e-3f;
    EXPECT_EQ(escaped_down, 0u);
    const DensityEstimator maker(lit.photons, *lit.rays, all_light(s.scene), 1);
    const IrradianceRecord r = record_at(maker, {0.5f * w, 0, 0.2f}, {0, 1, 0});
    const double law = point_over_plane_lx(100, 1, 0.2);
    EXPECT_NEAR(static_cast<double>(r.irradiance.y) / law, 1, 0.12) << aspect;
  }
}

/// One triangle, a lamp above it, and nothing else.
TEST(Degenerate, SceneOfOneTriangle) {
  Scene scene;
  begin_instance(scene, "triangle", add_lambert(scene, "grey", 0.5f));
  add_triangle(scene, {-1, 0, -1}, {0, 0, 1.5f}, {1, 0, -1});
  add_point_light(scene, {0, 1, 0}, 100);
  finalize(scene);
  const Lit lit = light_up(scene, 200000);
  const DensityEstimator maker(lit.photons, *lit.rays, all_light(scene), 1);
  const IrradianceRecord r = record_at(maker, {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(r.irradiance.y, 100, 4.5f * r.stderr_lx.y + 4);  // a zone's mean is below its peak
  EXPECT_EQ(record_at(maker, {0, 0, 0}, {0, -1, 0}).irradiance.y, 0);
  IrradianceCache cache;
  Counters counters;
  const PlacementReport report =
      place_at_photons(cache, lit.photons, *lit.rays, all_light(scene), {.max_candidates = 500}, 1, counters);
  EXPECT_GT(report.kept, 0u);
}

/// Light of one direction in harmonics of order 30, from the pole to the horizon: its irradiance is its
/// cosine, and its squares add up to (order)^2 / (2 pi) everywhere.
TEST(Degenerate, ThirtyBandsFromThePoleToTheHorizon) {
  constexpr int kOrder = 30;
  const HarmonicBasis<float> basis(kOrder);
  std::vector<float> h(static_cast<std::size_t>(basis.count())), light(3 * h.size());
  double worst = 0, worst_energy = 0;
  std::vector<double> elevations{kPi / 2, 1.2, 0.5, 0};
  for (int d = 1; d <= 7; ++d) {
    elevations.push_back(std::pow(10.0, -d));            // near the horizon
    elevations.push_back(kPi / 2 - std::pow(10.0, -d));  // near the pole
  }
  for (const double e : elevations)
    for (const double turn : {0.0, 1.0, 2.5}) {
      const DVec3 w(std::cos(e) * std::cos(turn), std::cos(e) * std::sin(turn), std::sin(e));
      basis.evaluate(BasisKind::hsh, static_cast<float>(w.x), static_cast<float>(w.y),
                     static_cast<float>(w.z), h.data());
      double energy = 0;
      for (std::size_t i = 0; i < h.size(); ++i) {
        light[3 * i] = light[3 * i + 1] = light[3 * i + 2] = h[i];
        energy += static_cast<double>(h[i]) * static_cast<double>(h[i]);
      }
      worst = std::max(worst, std::fabs(static_cast<double>(irradiance_of(light).y) - w.z));
      worst_energy = std::max(worst_energy, std::fabs(energy * 2 * std::numbers::pi / (kOrder * kOrder) - 1));
    }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worst_energy, 1e-3);
  expect_limit({"harmonics of order 30",
                "elevation of the light, rad (error relative to its full irradiance)", 0, kPi / 2, worst,
                "none"});
}

}  // namespace
}  // namespace phos::test
