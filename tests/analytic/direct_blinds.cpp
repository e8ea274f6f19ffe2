// Light of the sky through a blind: quadratures of what its slats leave, and by how few rays it is found.
#include <gtest/gtest.h>

#include "direct/direct_reader.h"
#include "scene/opening/find_blinds.h"
#include "scene/opening/find_portals.h"
#include "support/blinds.h"
#include "support/daylight.h"

namespace phos::test {
namespace {

/// Quadrature over the window, lx.
double through_lx(const BlindRoom& room, const DVec3& from, const DVec3& normal, const Environment& sky) {
  constexpr int n = 1200;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const DVec3 at(1 + 2 * (i + 0.5) / n, 0.9 + 1.5 * (k + 0.5) / n, 0), way = at - from;
      const double r2 = glm::dot(way, way);
      const DVec3 w = way / std::sqrt(r2);
      if (!room.passes(from, w)) continue;
      sum += static_cast<double>(luminance(sky.map_luminance(Vec3(w)))) * std::max(glm::dot(w, normal), 0.0) *
             std::fabs(w.z) / r2;
    }
  return sum * 2 * 1.5 / (static_cast<double>(n) * n);
}

}  // namespace

/// Within four standard errors of the quadrature; of less than half the variance of rays over the window
/// whole.
TEST(Blinds, AreSeenThroughGapByGap) {
  const Environment sky = sky_of("overcast", "", 10000);
  double variance = 0;  // of that without gaps, on the mean
  for (const float tilt_rad : {0.f, 0.5f, -0.5f}) {
    const BlindRoom room{.tilt_rad = tilt_rad};
    Scene scene = room.scene();
    surround(scene, sky);
    const RayScene rays(scene);
    scene.portal = find_portals(rays, "auto");
    Scene aimed = scene;
    aimed.blind = find_blinds(rays);
    ASSERT_EQ(aimed.blind.size(), 1u);
    const Luminaires without(scene), with(aimed);
    const struct {
      DVec3 from, normal;
    } places[] = {{{2, 0.8, 1.5}, {0, 1, 0}}, {{2, 0.8, 4}, {0, 1, 0}}, {{2, 1.5, 4}, {0, 0, -1}}};
    for (const auto& [from, normal] : places) {
      const double truth_lx = through_lx(room, from, normal, sky);
      const SurfacePoint at = receiver(scene, Vec3(from), Vec3(normal));
      double mean = 0, squares = 0, plain = 0;
      constexpr int kSeeds = 4, kRays = 2048;
      for (int seed = 0; seed < kSeeds; ++seed) {
        RandomStream random(static_cast<std::uint64_t>(seed), Stage::direct_light, 7);
        for (const Luminaires* lights : {&with, &without}) {
          for (int k = 0; k < kRays; ++k) {
            const float u = random.uniform();
            Illumination light;
            if (!lights->illuminate(0, at.position, u, random.uniform2(), light)) continue;
            const double cosine = std::max(static_cast<double>(glm::dot(at.normal, light.direction)), 0.0);
            const double lx = static_cast<double>(luminance(light.value * arriving_share(rays, at, light))) *
                              cosine / static_cast<double>(light.density);
            if (lights == &with)
              mean += lx, squares += lx * lx;
            else
              plain += lx * lx;
          }
        }
      }
      constexpr double n = kSeeds * kRays;
      mean /= n;
      const double sd = std::sqrt(squares / n - mean * mean), plain_sd = std::sqrt(plain / n - mean * mean);
      EXPECT_NEAR(mean, truth_lx, 4 * sd / std::sqrt(n) + 2e-3 * truth_lx) << tilt_rad << " " << from.z;
      EXPECT_LT(sd, 0.8 * plain_sd) << tilt_rad << " " << from.z;
      variance += sd * sd / (plain_sd * plain_sd) / 9;
    }
  }
  EXPECT_LT(variance, 0.4);
}

}  // namespace phos::test
