// Shadow rays cover lamps evenly, whatever their patches.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/sampling.h"
#include "scene/load.h"
#include "splat/direct/lamp_rays.h"

using namespace phos;

namespace {

/// The Cornell box about its lamp, where coordinates are finest; a corner of that moved by this part of its
/// size.
Scene with_lamp_bent_by(float part) {
  Scene scene = load_scene(std::string(PHOS_SOURCE) + "/data/cornell-measured.glb");
  const Instance& lamp = scene.instance[scene.light[0].instance];
  const auto &first = scene.triangle[lamp.first_triangle].v,
             &second = scene.triangle[lamp.first_triangle + 1].v;
  const Vec3 edge = scene.position[first[1]] - scene.position[first[0]];
  for (const std::uint32_t v : second) {
    const auto there = [&](std::uint32_t other) { return scene.position[other] == scene.position[v]; };
    if (!std::any_of(std::begin(first), std::end(first), there)) scene.position[v] += part * edge;
  }
  const Vec3 middle = 0.5f * (scene.position[first[1]] + scene.position[first[2]]);
  for (Vec3& p : scene.position) p -= middle;
  scene.bounds.lo -= middle, scene.bounds.hi -= middle;
  return scene;
}

}  // namespace

TEST(LampRays, CoverAllPatchesOfALampThatIsNearlyAParallelogram) {
  constexpr int kSide = 32;
  for (const float part : {0.f, 1e-7f, 1e-6f, 3e-6f, 6e-6f, 1e-5f, 1e-4f, 0.1f}) {
    const Scene scene = with_lamp_bent_by(part);
    const RayScene rays(scene);
    const Luminaires lights(scene);
    const AimedLamps lamps(rays, lights);
    ASSERT_TRUE(lamps.form[0].closed());
    SurfacePoint p;
    p.position = scene.bounds.centre() + Vec3(0.3f, 0.3f, 0.1f) * scene.bounds.size();
    p.normal = p.geometric_normal = Vec3(0, 1, 0);
    LampRays lamp_rays(lamps);
    LampVisibility sight;
    for (int k = 0; k < kSide * kSide; ++k) {
      const Vec2 u((static_cast<float>(k % kSide) + 0.5f) / kSide,
                   (static_cast<float>(k / kSide) + 0.5f) / kSide);
      const float u_triangle = lights.by_u_alone(0) ? 0 : golden_point(k, 0);
      lamp_rays.aim(0, p, u_triangle, u, sight, nullptr);
    }
    lamp_rays.send();
    const float exact = lamps.form[0].projected_solid_angle(p.position, p.normal);
    ASSERT_GT(exact, 0);
    EXPECT_NEAR(sight.sent / static_cast<float>(sight.rays), exact, 0.01f * exact) << part;
    EXPECT_EQ(sight.seen, sight.sent) << part << ": the lamp stands in its own way";
  }
}
