// Directions towards area lights and an environment follow the density that is stated for them.
#include <gtest/gtest.h>

#include "scene/lamp/luminaires.h"
#include "support/chi2.h"
#include "support/environment.h"
#include "support/quad.h"

using namespace phos;
using namespace phos::test;

namespace {

/// Density of the direction d from the origin towards a lamp in the plane z, by intersecting its triangles.
double density(const Scene& scene, const Luminaires& lights, const Vec3& d) {
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    const auto& v = scene.triangle[t].v;
    const DVec3 a(scene.position[v[0]]), e1 = DVec3(scene.position[v[1]]) - a,
                                         e2 = DVec3(scene.position[v[2]]) - a;
    const DVec3 n = glm::cross(e1, e2), dir(d);
    const double det = -glm::dot(dir, n);
    if (det <= 0) continue;
    const double distance = -glm::dot(a, n) / det;
    const DVec3 q = glm::cross(-a, dir);
    const double u = glm::dot(e2, q) / det, w = -glm::dot(e1, q) / det;
    if (distance < 0 || u < 0 || w < 0 || u + w > 1) continue;
    return static_cast<double>(lights.density(0, Vec3(0), t, static_cast<float>(distance),
                                              static_cast<float>(det / glm::length(n))));
  }
  return 0;
}

Scene lamp(int kind, float height) {
  Scene scene;
  add_lamp(scene, 1, 1.5f, height, false, Rgb(100));
  if (kind == 1) scene.position[3] = Vec3(-2.5f, 1.2f, height);  // two unequal triangles
  if (kind == 2) {
    Texture t;
    t.width = t.height = 2;
    t.texels = {Vec4(0.1f), Vec4(1), Vec4(0.3f), Vec4(0)};
    scene.texture = {t};
    scene.material[0].emissive.texture = 0;
  }
  return scene;
}

}  // namespace

TEST(LightSamples, FollowTheirDensity) {
  constexpr int kKinds = 3;
  const float heights[] = {0.05f, 0.8f, 6};  // the last is far from it
  for (int trial = 0; trial < 3 * kKinds; ++trial) {
    const int kind = trial % kKinds;
    const float height = heights[trial / kKinds];
    const Scene scene = lamp(kind, height);
    const Luminaires lights(scene);
    const Chi2 result = chi2_directions(
        SphereGrid{24, 48, 60}, 7, 60000,
        [&](RandomStream& random, Vec3& d) {
          const float u_triangle = random.uniform();
          Illumination light;
          const bool ok = lights.illuminate(0, Vec3(0), u_triangle, random.uniform2(), light);
          d = light.direction;
          return ok;
        },
        [&](const Vec3& d) { return density(scene, lights, d); });
    EXPECT_GT(result.p, least_p(0.01, 3 * kKinds))
        << "kind " << kind << " at " << height << " m: " << result.statistic << " for " << result.degrees
        << " degrees of freedom";
  }
}

/// A near window, a far one, two that are one behind the other, a triangle that lets light both ways, and one
/// seen from behind; with a wide sun before one of them or beside all, or with a bright spot in the map.
TEST(PortalSamples, FollowTheirDensity) {
  const std::vector<Portal> all = {
      {{-1, 0.2f, -1}, {{2, 0, 0}, {0, 1, 0}}, false, {0, 0, 1}},
      {{-1.5f, 0.5f, -2}, {{2, 0, 0}, {0, 2, 0}}, false, {0, 0, 1}},
      {{20, 5, 3}, {{0, 6, 0}, {0, 0, 8}}, false, {-1, 0, 0}},
      {{-3, -1, 0}, {{0, 2, 0.5f}, {0, 0, 2}}, true, Vec3(0)},
      {{-9, 3, -9}, {{18, 0, 0}, {0, 0, 18}}, false, {0, 1, 0}},
  };
  for (int trial = 0; trial < 4; ++trial) {
    Scene scene = open_floor();
    scene.portal = all;
    Environment light = gradient_map(16);
    if (trial == 1 || trial == 2) {
      const DVec3 towards = glm::normalize(trial == 1 ? DVec3(0.1, 0.5, -1) : DVec3(1, 3, 3));
      light = Environment(32, 16, light.texels(), 0, Environment::Sun{towards, 0.2, Rgb(5)});
    }
    if (trial == 3) light = map_of(16, [](int x, int y) { return Rgb(x == 20 && y == 5 ? 60.f : 1.f); });
    EXPECT_EQ(light.has_spots(), trial == 3);
    surround(scene, light);
    const Luminaires lights(scene);
    const Vec3 from(0);
    const auto place = static_cast<std::size_t>(lights.environment());
    const Chi2 result = chi2_directions(
        SphereGrid{24, 48, 60}, 7, 60000,
        [&](RandomStream& random, Vec3& d) {
          Illumination arriving;
          const bool ok = lights.illuminate(place, from, 0, random.uniform2(), arriving);
          d = arriving.direction;
          EXPECT_NEAR(arriving.density, lights.density_beyond(from, d), 1e-4f * arriving.density);
          return ok;
        },
        [&](const Vec3& d) { return static_cast<double>(lights.density_beyond(from, d)); });
    EXPECT_GT(result.p, least_p(0.01, 4)) << "trial " << trial << ": " << result.statistic << " for "
                                          << result.degrees << " degrees of freedom";
  }
}
