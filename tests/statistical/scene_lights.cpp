// Directions towards area lights follow the density that is stated for them.
#include <gtest/gtest.h>

#include "scene/luminaires.h"
#include "support/chi2.h"
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
