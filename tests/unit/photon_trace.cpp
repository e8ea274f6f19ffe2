// What a traced photon says of itself, and that threads and shards change nothing.
#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "core/parallel.h"
#include "photon/events.h"
#include "photon/photon_file.h"
#include "photon/trace.h"
#include "scene/opening/find_portals.h"
#include "support/daylight.h"
#include "support/scenes.h"

namespace phos {
namespace {

struct Traced {
  Photons photons;
  PhotonTotals totals;
  Counters counters;
};

Traced traced(const Scene& scene, std::int64_t paths, const std::string& shard = "", std::uint64_t seed = 5) {
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = paths, options.shard = shard;
  Traced t;
  t.photons = trace_photons(rays, options, seed, t.totals, t.counters);
  return t;
}

std::string bytes(const Photons& p) {
  std::string all;
  const auto add = [&](const auto& v) {
    all.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof v[0]);
  };
  add(p.position), add(p.flux), add(p.direction), add(p.normal), add(p.distance), add(p.source_normal),
      add(p.path);
  add(p.bounce), add(p.family);
  return all;
}

TEST(Trace, SamePhotonsOnAnyNumberOfThreads) {
  const Scene scene = test::uniform_box(0.7f).scene;
  set_threads(1);
  const Traced one = traced(scene, 20'000);
  set_threads(2);
  const Traced two = traced(scene, 20'000);
  set_threads(0);
  EXPECT_EQ(bytes(one.photons), bytes(two.photons));
  EXPECT_EQ(totals_to_json(one.totals), totals_to_json(two.totals));
  EXPECT_NE(bytes(one.photons), bytes(traced(scene, 20'000, "", 6).photons)) << "the seed has no effect";
}

TEST(Trace, ShardsAreThePartsOfTheWhole) {
  const Scene scene = test::uniform_box(0.7f).scene;
  const Traced whole = traced(scene, 5'001);
  for (const int n : {1, 2, 3, 7}) {
    Photons photons;
    PhotonTotals totals;
    totals.emitted = whole.totals.emitted, totals.flux_exponent = whole.totals.flux_exponent;
    for (int i = 1; i <= n; ++i) {
      const Traced part = traced(scene, 5'001, text(i, "/", n));
      EXPECT_EQ(part.totals.first_path, totals.paths);
      append(photons, part.photons);
      add_totals(totals, part.totals);
    }
    EXPECT_EQ(bytes(photons), bytes(whole.photons)) << n << " shards";
    EXPECT_EQ(totals_to_json(totals), totals_to_json(whole.totals)) << n << " shards";
  }
}

/// Where the ground sends light through a window, by many photons of one path.
TEST(Trace, PhotonsTellTheirPathWherePathsPart) {
  Scene scene = test::room_with_window(0.5f);
  test::begin_instance(scene, "ground", 0);
  test::add_quad(scene, {-2, -0.01f, 4.01f}, {0, 0, 8}, {9, 0, 0});
  test::surround(scene, test::sky_of("overcast", ""));
  EXPECT_TRUE(traced(scene, 1000).photons.family.empty());
  scene.portal = find_portals(RayScene(scene), "auto");
  ASSERT_FALSE(scene.portal.empty());
  set_threads(1);
  const Traced one = traced(scene, 5'001);
  set_threads(2);
  const Traced two = traced(scene, 5'001);
  set_threads(0);
  EXPECT_EQ(bytes(one.photons), bytes(two.photons));
  ASSERT_EQ(one.photons.family.size(), one.photons.size());
  std::map<std::uint32_t, std::size_t> photons_of;
  std::size_t most = 0;
  for (const std::uint32_t path : one.photons.family) {
    EXPECT_LT(path, 5'001u);
    most = std::max(most, ++photons_of[path]);
  }
  EXPECT_GT(most, 50u);
  Photons joined;
  for (int i = 1; i <= 3; ++i) append(joined, traced(scene, 5'001, text(i, "/3")).photons);
  EXPECT_EQ(bytes(joined), bytes(one.photons));
}

TEST(Trace, MoreShardsThanPaths) {
  std::uint64_t next = 0;
  for (int i = 1; i <= 7; ++i) {
    const ItemRange range = path_range(text(i, "/7"), 3);
    EXPECT_EQ(range.first, next);
    next += range.count;
  }
  EXPECT_EQ(next, 3u);
}

TEST(Trace, BadShardsAreUsageErrors) {
  for (const char* bad :
       {"0/2", "3/2", "1", "/", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/0", "1/2 ", "99999999999999999999/1"})
    try {
      path_range(bad, 10);
      FAIL() << bad;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage) << bad;
    }
}

TEST(Trace, EnergyAccountClosesExactly) {
  for (const float albedo : {0.0f, 0.5f, 0.99f}) {
    const Traced t = traced(test::two_sided_sheet(1000, 10, albedo).scene, 3'000);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(t.totals.emitted_sum.units[c],
                t.totals.escaped_sum.units[c] + t.totals.absorbed_sum.units[c]);
    EXPECT_NEAR(double(t.totals.emitted_flux_lm.x), 4 * std::numbers::pi * 1010, 15) << "a few paths of 3000";
    EXPECT_GT(t.counters[kEscapedEvent], 0u);
    double sum = 0;
    for (const Rgb& f : t.photons.flux) sum += double(f.x);
    EXPECT_NEAR(double(t.totals.stored_flux_lm.x), sum, 1e-5 * sum);
    EXPECT_EQ(t.totals.stored, t.photons.size());
  }
}

/// A lamp at height 1 between a floor (y = 0) and a ceiling (y = 2), both 20 m wide.
Scene two_plates(const Material& floor, const Material& ceiling) {
  Scene scene;
  scene.material = {floor, ceiling};
  test::begin_instance(scene, "floor", 0);
  test::add_quad(scene, {-10, 0, -10}, {0, 0, 20}, {20, 0, 0});
  test::begin_instance(scene, "ceiling", 1);
  test::add_quad(scene, {-10, 2, -10}, {20, 0, 0}, {0, 0, 20});
  test::add_point_light(scene, {0, 1, 0}, 100);
  finalize(scene);
  return scene;
}

Material lambert(float albedo) {
  Material m;
  m.kd = Rgb(albedo);
  return m;
}

Material mirror(float reflectance) {
  Material m;
  m.model = Model::mirror;
  m.ks = Rgb(reflectance);
  return m;
}

TEST(Trace, PathFlagsBouncesAndDistances) {
  // Mirror floor, grey ceiling: the ceiling sees the lamp (direct), its mirror image (caustic), and itself
  // (indirect).
  const Traced t = traced(two_plates(mirror(1), lambert(0.5f)), 20'000);
  std::size_t count[4] = {0, 0, 0, 0};
  for (std::size_t i = 0; i < t.photons.size(); ++i) {
    const Photons& p = t.photons;
    ASSERT_NEAR(p.position[i].y, 2, 1e-5) << "stored on the mirror";
    EXPECT_NEAR(decode_octahedral(p.normal[i]).y, -1, 1e-4);
    const Vec3 direction = decode_octahedral(p.direction[i]), source = decode_octahedral(p.source_normal[i]);
    EXPECT_LT(direction.y, 0);
    ++count[p.path[i]];
    switch (static_cast<PhotonPath>(p.path[i])) {
      case PhotonPath::direct:
        EXPECT_EQ(p.bounce[i], 0);
        EXPECT_NEAR(glm::length(p.position[i] - Vec3(0, 1, 0)), p.distance[i], 1e-4 * double(p.distance[i]));
        EXPECT_NEAR(glm::dot(source, -direction), 1, 1e-6)
            << "a point light has no normal but the flight itself";
        break;
      case PhotonPath::caustic:
        ADD_FAILURE() << "the mirror is flat, and the lamp has an image in it";
        break;
      case PhotonPath::mirrored:
        EXPECT_EQ(p.bounce[i], 1);
        EXPECT_NEAR(source.y, 1, 1e-4) << "it left the floor";
        EXPECT_NEAR(p.distance[i] * -direction.y, 2, 1e-3);
        EXPECT_NEAR(glm::length(p.position[i] - Vec3(0, -1, 0)), 1.5 * double(p.distance[i]),
                    1e-3 * double(p.distance[i]));
        break;
      case PhotonPath::indirect:
        EXPECT_GE(p.bounce[i], 2);
        EXPECT_NEAR(source.y, 1, 1e-4);
        break;
    }
  }
  for (const PhotonPath path : {PhotonPath::direct, PhotonPath::indirect, PhotonPath::mirrored})
    EXPECT_GT(count[static_cast<std::size_t>(path)], 100u);
}

TEST(Trace, BlackSurfacesAreStoredOn) {
  const Traced t = traced(two_plates(lambert(0), lambert(0)), 2'000);
  EXPECT_GT(t.photons.size(), 1'000u);
  for (const std::uint8_t path : t.photons.path)
    EXPECT_EQ(path, static_cast<std::uint8_t>(PhotonPath::direct));
}

TEST(Trace, BetweenMirrorsNothingIsStored) {
  const Traced t = traced(two_plates(mirror(0.9f), mirror(0.9f)), 500);
  EXPECT_EQ(t.photons.size(), 0u);
  EXPECT_EQ(t.totals.emitted, 500u);
}

/// Passing a pane is no event: light behind it is direct, and comes from the lamp. What the pane reflects is
/// light by way of a flat mirror, in which a point lamp has an image.
TEST(Trace, PassesPanesStraight) {
  Material glass;
  glass.model = Model::thin_dielectric;
  Scene scene = two_plates(lambert(0.5f), lambert(0.5f));
  scene.material.push_back(glass);
  test::begin_instance(scene, "pane", 2);
  test::add_quad(scene, {-10, 0.5f, -10}, {0, 0, 20}, {20, 0, 0});
  std::erase_if(scene.light, [](const Light& l) { return l.kind == Light::Kind::area; });
  scene.bounds = {};
  finalize(scene);
  ASSERT_EQ(scene.light.size(), 1u);
  const float lamp_m = scene.light[0].position.y;
  const Traced t = traced(scene, 5'000);
  std::size_t direct = 0, mirrored = 0;
  for (std::size_t i = 0; i < t.photons.size(); ++i) {
    EXPECT_GT(std::fabs(t.photons.position[i].y - 0.5f), 0.4f) << "stored on glass";
    EXPECT_NE(t.photons.path[i], static_cast<std::uint8_t>(PhotonPath::caustic));
    mirrored += t.photons.path[i] == static_cast<std::uint8_t>(PhotonPath::mirrored);
    if (t.photons.position[i].y > 0.1f) continue;
    if (t.photons.path[i] == static_cast<std::uint8_t>(PhotonPath::direct)) {
      ++direct;
      EXPECT_EQ(t.photons.bounce[i], 0);
      const float up = decode_octahedral(t.photons.direction[i]).y;
      EXPECT_NEAR(t.photons.distance[i] * up, lamp_m, 1e-3f) << "all the way from the lamp";
    }
  }
  EXPECT_GT(direct, 500u);
  EXPECT_GT(mirrored, 20u);
}

TEST(Trace, DirectionalLightComesFromInfinity) {
  Scene scene = two_plates(lambert(0.5f), lambert(0.5f));
  scene.light.clear();
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(Vec3(1, -0.1f, 0));
  sun.intensity = Rgb(1000);
  scene.light.push_back(sun);
  finalize(scene);
  const Traced t = traced(scene, 20'000);
  std::size_t direct = 0;
  for (std::size_t i = 0; i < t.photons.size(); ++i)
    if (t.photons.bounce[i] == 0) {
      ++direct;
      EXPECT_EQ(t.photons.distance[i], kInfinity);
    } else {
      EXPECT_LT(t.photons.distance[i], 100);
    }
  EXPECT_GT(direct, 100u);
}

TEST(Trace, NoPathsNoPhotons) {
  Scene scene = two_plates(lambert(0.5f), lambert(0.5f));
  EXPECT_EQ(traced(scene, 0).photons.size(), 0u);
  scene.light.clear();
  finalize(scene);
  EXPECT_EQ(traced(scene, 0).photons.size(), 0u) << "nobody asked for light";
  EXPECT_THROW(traced(scene, 1), Error);
}

TEST(Trace, EverythingEscapesFromAnEmptyScene) {
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "grey", 0.5f));
  test::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  Light spot;
  spot.kind = Light::Kind::spot;
  spot.position = {0, 1, 0};
  spot.direction = {0, 1, 0};
  spot.intensity = Rgb(10);
  spot.cos_inner = 0.9f, spot.cos_outer = 0.8f;
  scene.light.push_back(spot);
  finalize(scene);
  const Traced t = traced(scene, 1'000);
  EXPECT_EQ(t.photons.size(), 0u);
  EXPECT_EQ(t.counters[kEscapedEvent], 1'000u);
  EXPECT_EQ(t.totals.escaped_sum.units, t.totals.emitted_sum.units);
}

TEST(Trace, LogHoldsEveryRay) {
  const Scene scene = test::uniform_box(0.5f).scene;
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = 1'000;
  PhotonTotals totals;
  Counters counters;
  std::vector<Ray> log;
  const Photons photons = trace_photons(rays, options, 1, totals, counters, &log);
  EXPECT_EQ(log.size(), photons.size()) << "a closed box stores at the end of every ray";
}

}  // namespace
}  // namespace phos
