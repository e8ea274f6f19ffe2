// Caustic photons: the local radius of their density, crossings of virtual discs, flights, files.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "photon/caustic_map.h"
#include "photon/local_density.h"
#include "photon/photon_file.h"
#include "photon/trace.h"
#include "support/mirrors.h"
#include "support/run.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;

/// A number of that mean.
int poisson(double mean, RandomStream& random) {
  int n = -1;
  for (double left = 1, least = std::exp(-mean); left > least; ++n) left *= random.uniform_double();
  return n;
}

/// Photons of 1/per_m2 lm each over a square of side 2 about the origin, E = `lx`(x, z).
struct Plane {
  std::vector<Vec2> place;
  double photon_lm;

  template <class Light>
  Plane(double per_m2, std::uint64_t seed, const Light& lx) : photon_lm(1 / per_m2) {
    constexpr int kSide = 400;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        RandomStream random(seed, Stage::test, static_cast<std::uint64_t>(i * kSide + j));
        const double cell = 2.0 / kSide, x = -1 + (i + 0.5) * cell, z = -1 + (j + 0.5) * cell;
        for (int n = poisson(lx(x, z) * per_m2 * cell * cell, random); n > 0; --n)
          place.emplace_back(x + (random.uniform_double() - 0.5) * cell,
                             z + (random.uniform_double() - 0.5) * cell);
      }
  }

  LocalDensity at(const Vec2& p, float radius_m, std::size_t most, const ShareOfDisc& share = {}) const {
    std::vector<float> distance2;
    for (const Vec2& q : place)
      if (glm::dot(q - p, q - p) < radius_m * radius_m) distance2.push_back(glm::dot(q - p, q - p));
    std::sort(distance2.begin(), distance2.end());
    if (distance2.size() > most) radius_m = std::sqrt(distance2[most]), distance2.resize(most);
    const std::vector<Rgb> flux(distance2.size(), Rgb(static_cast<float>(photon_lm)));
    return local_density(distance2, flux, radius_m, Rgb(static_cast<float>(photon_lm)), share);
  }
};

struct Calibrated {
  double within = 0, error2 = 0, value = 0, truth = 0;
};

template <class Light>
Calibrated calibrate(const Light& lx, int places) {
  const Plane plane(5000, 3, lx);
  Calibrated c;
  for (int i = 0; i < places; ++i) {
    RandomStream random(5, Stage::test, static_cast<std::uint64_t>(i));
    const Vec2 p = 0.8f * random.uniform2() - Vec2(0.4f);
    const LocalDensity e = plane.at(p, 0.5f, 512);
    const double truth = lx(double(p.x), double(p.y)), value = luminance(e.irradiance);
    c.within += std::fabs(value - truth) <= 2 * double(luminance(e.stderr_lx()));
    c.error2 += (value - truth) * (value - truth), c.value += value, c.truth += truth;
  }
  c.within /= places, c.error2 /= places, c.value /= places, c.truth /= places;
  return c;
}

TEST(LocalDensity, EvenLightIsReadFromManyPhotons) {
  const Calibrated c = calibrate([](double, double) { return 1.0; }, 300);
  EXPECT_NEAR(c.value, 1, 0.03);
  EXPECT_LT(std::sqrt(c.error2), 0.12);  // 256 photons: 0.06, and the few discs that shrank for nothing
  EXPECT_GT(c.within, 0.92);
}

TEST(LocalDensity, AnEdgeIsNotSmeared) {
  const auto edge = [](double x, double) { return x > 0 ? 2.0 : 0.0; };
  const Calibrated c = calibrate(edge, 300);
  EXPECT_NEAR(c.value, c.truth, 0.1 * c.truth);
  EXPECT_GT(c.within, 0.88);
  // A tenth of a metre into the dark, 2.2 photons of a disc of 512 would be there.
  const Plane plane(5000, 3, edge);
  double dark = 0;
  for (int i = 0; i < 50; ++i)
    dark += static_cast<double>(
                luminance(plane.at({-0.1f, -0.4f + 0.016f * static_cast<float>(i)}, 0.5f, 512).irradiance)) /
            50;
  EXPECT_LT(dark, 0.1);
}

TEST(LocalDensity, AFoldAndAFocusKeepTheirLight) {
  const Calibrated fold =
      calibrate([](double x, double) { return x > 0 ? 0.5 / std::sqrt(std::max(x, 1e-3)) : 0; }, 300);
  EXPECT_NEAR(fold.value, fold.truth, 0.15 * fold.truth);
  EXPECT_GT(fold.within, 0.88);
  const Calibrated focus =
      calibrate([](double x, double z) { return 0.3 / std::max(std::hypot(x, z), 1e-3); }, 300);
  EXPECT_NEAR(focus.value, focus.truth, 0.15 * focus.truth);
  EXPECT_GT(focus.within, 0.88);
}

TEST(LocalDensity, NothingIsDarkToWithinOnePhoton) {
  const LocalDensity e = local_density({}, {}, 0.5f, Rgb(0.1f));
  EXPECT_EQ(e.irradiance, Rgb(0));
  EXPECT_FLOAT_EQ(e.stderr_lx().x, float(0.1 / (kPiD * 0.25)));
}

TEST(LocalDensity, WhatIsNoSurfaceDoesNotCount) {
  const Plane plane(20'000, 7, [](double x, double) { return x < 0 ? 1.0 : 0.0; });
  // Surface ends at x = 0, in the middle of the disc.
  const LocalDensity e = plane.at({0, 0}, 0.2f, 100'000, [](double) { return DiscShare{0.5, 0}; });
  EXPECT_NEAR(double(e.irradiance.x), 1, 4 * double(e.noise_lx.x));
  EXPECT_GT(e.photons, 500u);
}

TEST(LocalDensity, OnePhotonAndMany) {
  const float distance2[] = {0.01f};
  const Rgb flux[] = {Rgb(2)};
  const LocalDensity one = local_density(distance2, flux, 1, Rgb(2));
  EXPECT_TRUE(is_finite(one.irradiance) && is_finite(one.stderr_lx()));
  EXPECT_GT(one.stderr_lx().x, 0);
  const std::vector<float> same(1000, 0.f);
  const std::vector<Rgb> fluxes(1000, Rgb(1e-3f));
  const LocalDensity all_at_one_place = local_density(same, fluxes, 1, Rgb(1e-3f));
  EXPECT_TRUE(is_finite(all_at_one_place.irradiance) && is_finite(all_at_one_place.stderr_lx()));
}

/// docs/methods.md#g7-1: in light of radiance L from everywhere, E = pi L is the sum of flux over the disc's
/// area, without a cosine (with it: 2/3 of that).
TEST(CausticMap, CrossingsCountWithoutACosine) {
  CausticPhotons photons;
  constexpr int kFlights = 200'000;
  constexpr double kRadius = 1;
  // Chords of a sphere: from uniform points on it, directions by the cosine inwards; flux pi L 4 pi R2.
  for (int i = 0; i < kFlights; ++i) {
    RandomStream random(11, Stage::test, static_cast<std::uint64_t>(i));
    const double z = 2 * random.uniform_double() - 1, t = 2 * kPiD * random.uniform_double();
    const Vec3 on(std::sqrt(1 - z * z) * std::cos(t), std::sqrt(1 - z * z) * std::sin(t), z);
    const double c2 = random.uniform_double(), a = 2 * kPiD * random.uniform_double();
    const Vec3 inward = make_frame(-on).to_world(
        Vec3(std::sqrt(1 - c2) * std::cos(a), std::sqrt(1 - c2) * std::sin(a), std::sqrt(c2)));
    photons.flights.from.push_back(static_cast<float>(kRadius) * on);
    photons.flights.direction.push_back(encode_octahedral(inward));
    photons.flights.length.push_back(kInfinity);
    photons.flights.flux.push_back(Rgb(static_cast<float>(4 * kPiD * kPiD * kRadius * kRadius / kFlights)));
  }
  const CausticMap map(std::move(photons));
  std::vector<CausticHit> hits;
  float radius = 0.2f;
  map.crossing({0.1f, 0.2f, -0.1f}, glm::normalize(Vec3(1, 2, 3)), kFlights, radius, hits);
  EXPECT_EQ(radius, 0.2f);
  double sum = 0, squares = 0;
  for (const CausticHit& hit : hits)
    sum += static_cast<double>(hit.flux_lm.x),
        squares += static_cast<double>(hit.flux_lm.x) * static_cast<double>(hit.flux_lm.x);
  const double area = kPiD * 0.04;
  EXPECT_NEAR(sum / area, kPiD, 3 * std::sqrt(squares) / area);
  EXPECT_TRUE(std::is_sorted(hits.begin(), hits.end(), [](const CausticHit& a, const CausticHit& b) {
    return a.distance2_m2 < b.distance2_m2;
  }));
  const std::size_t all = hits.size();
  const float tenth = std::sqrt(hits[10].distance2_m2);
  map.crossing({0.1f, 0.2f, -0.1f}, glm::normalize(Vec3(1, 2, 3)), 10, radius, hits);
  EXPECT_GT(all, 10u);
  EXPECT_EQ(hits.size(), 10u);
  EXPECT_EQ(radius, tenth);
}

Photons traced(const Scene& scene, std::int64_t paths, const std::string& shard = "",
               std::int64_t aimed = -1) {
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = paths, options.shard = shard, options.caustic_paths = aimed;
  PhotonTotals totals;
  Counters counters;
  return trace_photons(rays, options, 2, totals, counters);
}

TEST(Flights, ThereAreNoneWithoutMirrorsAndGlass) {
  const Photons photons = traced(point_light_over_plane().scene, 5000);
  EXPECT_EQ(photons.flights.size(), 0u);
}

/// A mirror in the open: all that it reflects flies off, 0.9 of what falls on it.
TEST(Flights, LightThatAMirrorSendsToTheSkyIsThere) {
  Scene scene;
  begin_instance(scene, "mirror", add_mirror(scene, "mirror", 0.9f));
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  add_point_light(scene, {0, 1, 0}, 100);
  finalize(scene);
  const Photons photons = traced(scene, 60'000);
  EXPECT_EQ(photons.size(), 0u);
  double flux = 0;
  for (std::size_t i = 0; i < photons.flights.size(); ++i) {
    EXPECT_EQ(photons.flights.length[i], kInfinity);
    EXPECT_GT(decode_octahedral(photons.flights.direction[i]).y, 0);
    EXPECT_NEAR(photons.flights.from[i].y, 0, 1e-5);
    flux += static_cast<double>(photons.flights.flux[i].x);
  }
  // The lamp sees the square of half side = height under Omega = 4 asin(1/2) = 2 pi / 3 sr.
  const double reflected = 0.9 * 100 * 2 * kPiD / 3;
  EXPECT_NEAR(flux, reflected, 0.02 * reflected);
  // Not aimed, the same light.
  flux = 0;
  for (const Rgb& f : traced(scene, 60'000, "", 0).flights.flux) flux += static_cast<double>(f.x);
  EXPECT_NEAR(flux, reflected, 0.03 * reflected);
}

/// In a closed box of one mirror wall every caustic photon lands, and none is in flight.
TEST(Flights, WhatLandsIsAPhoton) {
  const Photons photons = traced(MirrorBox().scene, 20'000);
  EXPECT_EQ(photons.flights.size(), 0u);
  EXPECT_GT(
      std::count(photons.path.begin(), photons.path.end(), static_cast<std::uint8_t>(PhotonPath::caustic)),
      100);
}

TEST(Flights, ShardsHoldThemAll) {
  Scene scene;
  begin_instance(scene, "mirror", add_mirror(scene, "mirror", 0.9f));
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  add_point_light(scene, {0, 1, 0}, 100);
  finalize(scene);
  const Photons whole = traced(scene, 5001);
  Photons joined = traced(scene, 5001, "1/3");
  append(joined, traced(scene, 5001, "2/3")), append(joined, traced(scene, 5001, "3/3"));
  EXPECT_EQ(joined.flights.from, whole.flights.from);
  EXPECT_EQ(joined.flights.flux, whole.flights.flux);
  EXPECT_EQ(joined.flights.direction, whole.flights.direction);
}

/// What aimed paths bring is what all paths bring, on average: flux and its mean square place.
TEST(AimedPaths, BringTheLightOfOthers) {
  const MirrorBox box;
  double flux[2] = {0, 0}, moment[2] = {0, 0};
  for (const int aimed : {0, 1}) {
    const Photons photons = traced(box.scene, 200'000, "", aimed ? 150'000 : 0);
    for (std::size_t i = 0; i < photons.size(); ++i) {
      if (!is_caustic(static_cast<PhotonPath>(photons.path[i]))) continue;
      const auto f = static_cast<double>(photons.flux[i].x);
      flux[aimed] += f,
          moment[aimed] += f * static_cast<double>(glm::dot(photons.position[i], photons.position[i]));
    }
  }
  EXPECT_NEAR(flux[1], flux[0], 0.02 * flux[0]);
  EXPECT_NEAR(moment[1], moment[0], 0.03 * moment[0]);
}

TEST(CausticPhotons, AreTheSameFromAFile) {
  PhotonTotals totals;
  const MirrorBox box;
  const RayScene rays(box.scene);
  PhotonOptions options;
  options.paths = 2000;
  Counters counters;
  Photons photons = trace_photons(rays, options, 2, totals, counters);
  photons.flights = {{Vec3(1, 2, 3)}, {Rgb(4)}, {5u}, {kInfinity}};
  const PhotonMap map = PhotonMap::build(std::move(photons), totals);
  EXPECT_TRUE(map.has_caustics());
  const CausticPhotons c = caustics_of(map);
  const std::string path = scratch("caustic") + "/a.photons";
  TensorWriter writer(FileKind::irradiance);  // without records
  for (const char* name :
       {"position", "normal", "irradiance", "stderr", "rotation_gradient", "translation_gradient"})
    writer.add_vectors(name, {});
  for (const char* name : {"distance", "radius"}) writer.add<float>(name, {});
  add_columns(writer, c);
  const Provenance provenance;
  writer.write(path, provenance);
  const CausticPhotons read = read_caustics(Container::open(path));
  EXPECT_EQ(read.position, c.position);
  EXPECT_EQ(read.flux, c.flux);
  EXPECT_EQ(read.direction, c.direction);
  EXPECT_EQ(read.normal, c.normal);
  EXPECT_EQ(read.distance, c.distance);
  EXPECT_EQ(read.flights.from, c.flights.from);
  EXPECT_EQ(read.flights.length, c.flights.length);
  const std::string whole = scratch("caustic") + "/b.photons";
  map.write(whole, provenance);
  EXPECT_EQ(PhotonMap::open(whole).flights.size(), 1u);
}

}  // namespace
}  // namespace phos::test
