// Areas of hulls, densities of photons and angles of spots, against the same in long doubles.
#include <gtest/gtest.h>

#include <numbers>

#include "core/random.h"
#include "photon/density.h"
#include "photon/emission.h"
#include "support/rounding.h"

namespace phos::test {
namespace {

constexpr long double kPiL = std::numbers::pi_v<long double>;

/// A cloud `aspect` times as long as wide, turned, of any size.
std::vector<Vec2> cloud(std::size_t n, double aspect, std::uint64_t seed) {
  RandomStream random(seed, Stage::test, 0);
  const double size = std::pow(10.0, 12 * static_cast<double>(random.uniform()) - 6),
               turn = 6.3 * static_cast<double>(random.uniform()), c = std::cos(turn), s = std::sin(turn);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 u = 2.0 * glm::dvec2(random.uniform2()) - 1.0, p(size * u.x, size / aspect * u.y);
    points.emplace_back(glm::dvec2(c * p.x - s * p.y, s * p.x + c * p.y));
  }
  return points;
}

/// Products of differences of floats are nearly all exact in long doubles.
long double cross(const LVec2& a, const LVec2& b, const LVec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Andrew's monotone chain.
std::vector<LVec2> chain_of(const std::vector<Vec2>& points) {
  std::vector<LVec2> sorted(points.begin(), points.end()), hull;
  std::sort(sorted.begin(), sorted.end(),
            [](const LVec2& a, const LVec2& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  for (const bool upper : {false, true}) {
    const std::size_t base = hull.size();
    for (const LVec2& p : sorted) {
      while (hull.size() >= base + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (!upper) std::reverse(sorted.begin(), sorted.end());
  }
  return hull;
}

TEST(Rounding, AreasOfHulls) {
  Rounding area;
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    const double aspect = std::pow(10.0, static_cast<double>(trial % 8));
    const std::vector<Vec2> points = cloud(20 + trial % 200, aspect, trial);
    const std::vector<LVec2> exact = chain_of(points);
    long double twice = 0;
    for (std::size_t i = 1; i + 1 < exact.size(); ++i) twice += cross(exact[0], exact[i], exact[i + 1]);
    if (!(twice > 0)) continue;
    Hull hull;
    convex_hull(points, hull);
    area.see(hull.area, twice / 2, twice / 2);
  }
  area.expect("the area of a hull", "aspect ratio of the points", 1, 1e7, 1e-8);
}

TEST(Rounding, DensitiesOfPhotons) {
  Rounding full, error, kernel;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    RandomStream random(trial, Stage::test, 1);
    const std::size_t n = 20 + trial % 1000;
    const float radius_m = std::pow(10.f, 12 * random.uniform() - 6);
    std::vector<Vec2> offsets;
    std::vector<Rgb> flux;
    for (std::size_t i = 0; i < n; ++i) {
      const float turn = 6.2831853f * random.uniform(), r = 0.999f * radius_m * std::sqrt(random.uniform());
      offsets.emplace_back(r * std::cos(turn), r * std::sin(turn));
      const float faint = std::pow(10.f, -6 * random.uniform());  // one huge among many tiny
      flux.push_back(faint * Rgb(random.uniform(), 1, 1 - 0.5f * random.uniform()));
    }
    DensityScratch scratch;
    const ZoneEstimate e = zone_irradiance(offsets, flux, radius_m, {}, {}, scratch);
    ASSERT_EQ(scratch.used.size(), n);
    LVec3 sum(0), squares(0);
    for (std::size_t i = 0; i < n; ++i)
      if (scratch.used[i]) sum += LVec3(flux[i]), squares += LVec3(flux[i]) * LVec3(flux[i]);
    const auto radius = static_cast<long double>(radius_m), disc = kPiL * radius * radius;
    if (e.kind == ZoneKind::full)
      for (int c = 0; c < 3; ++c) {
        full.see(static_cast<double>(e.irradiance[c]), sum[c] / disc, sum[c] / disc);
        const long double exact = std::sqrt(squares[c]) / disc;
        error.see(static_cast<double>(e.stderr_lx[c]), exact, exact);
      }
    const ZoneEstimate k = kernel_irradiance(offsets, flux, radius_m, Kernel::epanechnikov, scratch);
    LVec3 weighted(0);
    for (std::size_t i = 0; i < n; ++i) {
      const long double r2 = glm::dot(LVec2(offsets[i]), LVec2(offsets[i])) / (radius * radius);
      weighted += LVec3(flux[i]) * (2 * (1 - r2));
    }
    for (int c = 0; c < 3; ++c)
      kernel.see(static_cast<double>(k.irradiance[c]), weighted[c] / disc, weighted[c] / disc);
  }
  full.expect("the density of photons, disc", "strongest over faintest photon", 1, 1e6, 1e-7);
  error.expect("the density's standard error", "strongest over faintest photon", 1, 1e6, 1e-7);
  kernel.expect("the density of photons, kernel", "strongest over faintest photon", 1, 1e6, 1e-7);
}

/// From the doubles that a light says its cone by: what they themselves round is in "light of a spot".
TEST(Rounding, AnglesFromASpotsAxis) {
  Rounding sine;
  for (const double half : {1e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0, 1.5}) {
    for (int i = 0; i < 1000; ++i) {
      RandomStream random(7, Stage::test, static_cast<std::uint64_t>(i));
      const double outer = std::cos(half), inner = std::cos(half * static_cast<double>(random.uniform()));
      const float u = random.uniform();
      const long double o = 1 - static_cast<long double>(outer), n = 1 - static_cast<long double>(inner),
                        x = static_cast<long double>(u) * (n + (o - n) / 3);
      const long double versine = x < n ? x : o - (o - n) * std::cbrt((x - n) / ((o - n) / 3));
      const double cosine = sample_spot_cosine(inner, outer, u);
      const long double exact = std::sqrt(versine * (2 - versine)), unit = std::sqrt(o * (2 - o));
      sine.see(std::sqrt((1 - cosine) * (1 + cosine)), exact, unit);
    }
  }
  sine.expect("the angle from a spot's axis, relative to the cone", "half angle of the cone, rad", 1e-5, 1.5,
              1e-3);
}

}  // namespace
}  // namespace phos::test
