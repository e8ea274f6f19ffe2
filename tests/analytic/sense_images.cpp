// A room with a flat mirror for a wall is half of the doubled room, that has a second lamp and no mirror:
// what gathered rays and gloss show of lamps' images, against the doubled room.
#include <gtest/gtest.h>

#include "estimate/shading.h"
#include "record/tree.h"
#include "sense/sensors.h"
#include "support/gathered.h"
#include "support/one_material.h"

namespace phos::test {
namespace {

enum class Lamp { point, area };

/// Grey walls about 0..2 m, a lamp at x = 0.6 and a mirror at x = 2; doubled: 0..4 m, a second lamp instead.
Scene room(Lamp lamp, bool doubled,
           const Material& floor = make_material(Model::lambert, Rgb(0.5f), Rgb(0))) {
  Scene scene;
  const float end = doubled ? 4 : 2;
  const Vec3 x(end, 0, 0), y(0, 2, 0), z(0, 0, 2), lo(0);
  begin_instance(scene, "walls", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, lo + y, x, z), add_quad(scene, lo, y, z), add_quad(scene, lo, x, y);
  add_quad(scene, lo + z, y, x);
  if (doubled) add_quad(scene, lo + x, z, y);
  scene.material.push_back(floor);
  begin_instance(scene, "floor", 1);
  add_quad(scene, lo, z, x);
  const std::uint32_t bright = add_lambert(scene, "lamp", 0, 500);
  for (const float at : doubled ? std::vector<float>{0.6f, 3.4f} : std::vector<float>{0.6f}) {
    if (lamp == Lamp::point) {
      add_point_light(scene, {at, 1.4f, 0.9f}, 100);
    } else {
      begin_instance(scene, "lamp", bright);
      add_quad(scene, {at - 0.1f, 1.9f, 0.8f}, {0.2f, 0, 0}, {0, 0, 0.2f});
    }
  }
  if (!doubled) {
    scene.material.push_back(make_material(Model::mirror, Rgb(0), Rgb(1)));
    begin_instance(scene, "mirror", static_cast<std::uint32_t>(scene.material.size() - 1));
    add_quad(scene, lo + x, z, y);
  }
  finalize(scene);
  return scene;
}

class Images : public testing::TestWithParam<Lamp> {};

/// The first bounce: every surface that rays find is lit by lamp and image. A source that lacks the images
/// and is dark else changes nothing.
TEST_P(Images, LightWhatGatheredRaysFind) {
  const Scene half = room(GetParam(), false), whole = room(GetParam(), true);
  Gathered mirrored(half), doubled(whole);
  const RecordOptions options = gather_options(half, Quantity::indirect, -1, 512);
  const RecordTree dark = uniform_tree(Vec3(0), Vec3(2), 0);
  for (const Vec3& p : {Vec3(0.3f, 0, 1), Vec3(1.7f, 0, 1.2f)}) {
    const Trial truth = doubled.trial(p, {0, 1, 0}, options, {}, 1, 200);
    for (const GatherSource& source :
         {GatherSource{}, GatherSource{.indirect = &dark, .lacks_images = true}}) {
      const Trial t = mirrored.trial(p, {0, 1, 0}, options, source, truth.mean, 200);
      EXPECT_NEAR(t.mean, truth.mean, 4 * std::hypot(t.stderr_of_mean, truth.stderr_of_mean))
          << p.x << (source.indirect ? ", dark source" : "");
    }
    const Trial without = mirrored.trial(p, {0, 1, 0}, options, {.indirect = &dark}, 1, 200);
    EXPECT_LT(without.mean, 0.95 * truth.mean) << "a source that has the images, and says 0";
  }
}

/// Sensors in mid-air get records of rays that read the caches, which here are dark.
TEST_P(Images, LightWhatSensorsInMidAirSee) {
  const auto read = [](const Scene& scene) {
    IrradianceCache cache;
    cache.quantity = Quantity::indirect, cache.accuracy = 0.2;
    IrradianceRecord dark;
    dark.position = {0.05f, 0, 0.05f}, dark.normal = {0, 1, 0};
    dark.distance_m = dark.radius_m = 0.01f;
    cache.records.push_back(dark);
    SensorCaches caches({}, nullptr);
    caches.add(cache, "dark");
    const RayScene rays(scene);
    const Luminaires lights(scene);
    Sensors sensors;
    for (const float x : {0.7f, 1.5f}) sensors.points.push_back({{x, 1, 1}, {0, 1, 0}});
    SensorOptions options;
    options.rays = 16384;
    SensorReport report;
    std::vector<Reading> readings = read_light(sensors, rays, lights, caches, options, report);
    EXPECT_EQ(report.uncovered, 2u);
    return readings;
  };
  const std::vector<Reading> mirrored = read(room(GetParam(), false)), truth = read(room(GetParam(), true));
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_NEAR(mirrored[i].indirect_lx, truth[i].indirect_lx, 0.015f * truth[i].indirect_lx) << i;
}

/// Glossy walls: what their lobes show of the image, whether rays look for it or radiance records know the
/// rest.
TEST_P(Images, ShineInGloss) {
  Material floor = make_material(Model::ward, Rgb(0.2f), Rgb(0.5f));
  floor.alpha_x = floor.alpha_y = 0.3f;
  const Scene half = room(GetParam(), false, floor), whole = room(GetParam(), true, floor);
  const RayScene rays(half), all_rays(whole);
  const Luminaires lights(half), all_lights(whole);
  const RecordTree no_records(half.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {}), all(all_rays, all_lights, no_records, {});
  const Vec3 wo = glm::normalize(Vec3(-0.5f, 1, 0.1f));
  SurfacePoint point, same;
  ASSERT_TRUE(trace(rays, {Vec3(1, 0, 1) + 0.3f * wo, -wo}, point));
  ASSERT_TRUE(trace(all_rays, {Vec3(1, 0, 1) + 0.3f * wo, -wo}, same));
  const Bsdf bsdf(half, point), bsdf_there(whole, same);
  double by_both = 0, by_records = 0, by_rays = 0, by_one = 0;
  constexpr int kTimes = 4000;
  for (int k = 0; k < kTimes; ++k) {
    RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
    by_both += static_cast<double>(all.direct(same, bsdf_there, wo, 1, 0, random).radiance.y) / kTimes;
    by_records += static_cast<double>((shading.direct(point, bsdf, wo, 1, 0, random).radiance +
                                       shading.mirrored(point, bsdf, wo, false, 1, random).radiance)
                                          .y) /
                  kTimes;
    by_one += static_cast<double>(shading.from_one_lamp(point, bsdf, wo, false, random).y) / kTimes;
    by_rays += static_cast<double>(shading.mirrored(point, bsdf, wo, true, 1, random).radiance.y -
                                   shading.mirrored(point, bsdf, wo, false, 1, random).radiance.y) /
               kTimes;
  }
  EXPECT_NEAR(by_records, by_both, 0.01 * by_both);
  EXPECT_NEAR(by_one, by_both, 0.02 * by_both) << "one lamp or image at a time";
  if (GetParam() == Lamp::point) {
    EXPECT_NEAR(by_rays, 0, 1e-3 * by_both) << "no ray finds a point";
  } else {
    EXPECT_LT(by_rays, -0.02 * by_both) << "left to rays";
  }
}

INSTANTIATE_TEST_SUITE_P(Lamps, Images, testing::Values(Lamp::point, Lamp::area),
                         [](const auto& info) { return info.param == Lamp::point ? "Point" : "Area"; });

}  // namespace
}  // namespace phos::test
