// Zones that are no zones: no photon, few, collinear or coincident ones, edges, corners, opposing normals.
// Each gives a finite record, right where there is a right answer, and is counted.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "support/records.h"

namespace phos {
namespace {

/// A floor of 16 m, and photons of 1 lm put on it by hand, all from above.
class Zones : public ::testing::TestWithParam<Estimate> {
 protected:
  Zones() : scene_(test::point_light_over_plane()), rays_(scene_.scene) {}

  struct Landed {
    Vec3 position, normal{0, 1, 0}, direction{0, 1, 0};
    float distance_m = 2;
  };

  PhotonMap map_of(const std::vector<Landed>& landed) {
    Photons photons;
    for (const Landed& l : landed) {
      photons.position.push_back(l.position), photons.flux.push_back(Rgb(1));
      photons.direction.push_back(encode_octahedral(l.direction));
      photons.normal.push_back(encode_octahedral(l.normal));
      photons.distance.push_back(l.distance_m),
          photons.source_normal.push_back(encode_octahedral(-l.direction));
      photons.path.push_back(static_cast<std::uint8_t>(PhotonPath::indirect)), photons.bounce.push_back(1);
    }
    PhotonTotals totals;
    totals.emitted = totals.stored = landed.size();
    totals.emitted_flux_lm = totals.stored_flux_lm = Rgb(static_cast<float>(landed.size()));
    return PhotonMap::build(std::move(photons), totals);
  }
  PhotonMap map_at(const std::vector<Vec3>& places) {
    std::vector<Landed> landed;
    for (const Vec3& p : places) landed.push_back({p});
    return map_of(landed);
  }

  /// Photons 1/m2 apart from each other by chance, over the disc of radius 2 m about the origin.
  static std::vector<Vec3> scattered(int n) {
    RandomStream random(22, Stage::test, 0);
    std::vector<Vec3> places;
    for (int i = 0; i < n; ++i) {
      const Vec2 p = 2.f * sample_disc(random.uniform2());
      places.push_back({p.x, 0, p.y});
    }
    return places;
  }

  IrradianceRecord record_of(const PhotonMap& map, const RecordSite& site, RecordOptions options = {}) {
    options.estimate = GetParam();
    options.resolve(scene_.scene.bounds.diagonal_m() / 4);
    const DensityEstimator maker(map, rays_, options, 1);
    const auto worker = maker.make_worker();
    const Made made = maker.make(site, *worker);
    counters_.merge(worker->counters);
    const IrradianceRecord& r = made.record;
    EXPECT_TRUE(is_finite(r.irradiance) && is_finite(r.stderr_lx));
    EXPECT_TRUE(r.radius_m > 0 && std::isfinite(r.radius_m));
    EXPECT_LE(made.least_radius_m, r.radius_m);
    EXPECT_GE(std::min({r.irradiance.x, r.irradiance.y, r.irradiance.z}), 0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]));
    }
    return r;
  }
  IrradianceRecord record(const PhotonMap& map, const Vec3& p = Vec3(0)) {
    return record_of(map, {p, {0, 1, 0}, 0});
  }
  bool hull() const { return GetParam() == Estimate::hull; }

  test::AnalyticScene scene_;
  RayScene rays_;
  Counters counters_;
};

INSTANTIATE_TEST_SUITE_P(Estimates, Zones, ::testing::Values(Estimate::hull, Estimate::kernel),
                         [](const auto& info) { return info.param == Estimate::hull ? "hull" : "kernel"; });

TEST_P(Zones, WithoutAPhotonThereIsZeroThatIsCounted) {
  EXPECT_EQ(record(map_of({})).irradiance, Rgb(0));
  EXPECT_EQ(record(map_of({})).stderr_lx, Rgb(0)) << "nothing is known of what a photon carries";
  const IrradianceRecord r = record(map_at({{-7, 0, -7}}));
  EXPECT_EQ(r.irradiance, Rgb(0));
  EXPECT_GT(r.stderr_lx.y, 0) << "one photon could have come";
  EXPECT_EQ(counters_["records without photons"], 3u);
}

TEST_P(Zones, OneTwoThreePhotonsAreTheirFluxOverTheZone) {
  const std::vector<Vec3> places{{0.3f, 0, 0}, {0, 0, 0.3f}, {-0.2f, 0, -0.2f}};
  float last = 0;
  for (std::size_t n = 1; n <= 3; ++n) {
    std::vector<Landed> from_afar;  // light of a lamp nearby would not be even
    for (std::size_t i = 0; i < n; ++i) from_afar.push_back({.position = places[i], .distance_m = 1e4f});
    const IrradianceRecord r = record(map_of(from_afar));
    EXPECT_GT(r.irradiance.y, last) << n;
    EXPECT_NEAR(std::sqrt(static_cast<float>(n)) * r.stderr_lx.y / r.irradiance.y, 1, 0.01f) << n;
    last = r.irradiance.y;
  }
  if (hull()) {
    EXPECT_EQ(counters_["records with too few photons"], 3u);
  }
}

/// Photons on a line have no hull: flux over the zone.
TEST_P(Zones, CollinearPhotons) {
  for (const bool through_the_record : {true, false}) {
    std::vector<Vec3> line;
    for (int i = -200; i < 200; ++i) {
      line.push_back({0.002f * static_cast<float>(i), 0, through_the_record ? 0.f : 0.1f});
    }
    const std::uint64_t before = counters_["records with degenerate hull"];
    const IrradianceRecord r = record(map_at(line));
    EXPECT_GT(r.irradiance.y, 0);
    if (hull()) {
      EXPECT_GT(counters_["records with degenerate hull"], before);
    }
  }
}

/// All at one point, beside the record or where it is; also where the record sits on one of them.
TEST_P(Zones, CoincidentPhotons) {
  for (const Vec3& place : {Vec3(0.05f, 0, 0.02f), Vec3(0)}) {
    const PhotonMap map = map_at(std::vector<Vec3>(500, place));
    for (const std::uint32_t seat : {kNoPhoton, 0u}) {
      EXPECT_GT(record_of(map, {Vec3(0), {0, 1, 0}, 0, seat}).irradiance.y, 0);
    }
  }
  if (hull()) {
    EXPECT_EQ(counters_["records with degenerate hull"], 4u);
  }
}

/// Two photons where the record sits: its own does not count where it was the one candidate far and wide, and
/// in full where there were many.
TEST_P(Zones, TheRecordsOwnPhotonCountsAsItsCandidatesAreMany) {
  const PhotonMap map = map_at({Vec3(0), Vec3(0)});
  const float both = record(map).irradiance.y;
  const auto seated = [&](float tried) {
    return record_of(map, {Vec3(0), {0, 1, 0}, 0, 1, tried}).irradiance.y / both;
  };
  EXPECT_NEAR(seated(0), 0.5f, 1e-5f);
  EXPECT_NEAR(seated(1e6f), 1.f, 1e-5f);
  EXPECT_GT(seated(1), 0.5f);
  EXPECT_LT(seated(1), 1.f);
  EXPECT_EQ(record_of(map_at({Vec3(0)}), {Vec3(0), {0, 1, 0}, 0, 0, 0}).irradiance, Rgb(0));
}

/// Alone with its own photon a record knows no more than that one could have come, however little of it
/// counts.
TEST_P(Zones, ItsOwnPhotonAloneTellsLittle) {
  for (const float tried : {0.f, 1e-3f, 1.f, 1e6f}) {
    const IrradianceRecord r = record_of(map_at({Vec3(0)}), {Vec3(0), {0, 1, 0}, 0, 0, tried});
    const IrradianceRecord whole = record(map_at({Vec3(0)}));
    EXPECT_GE(r.stderr_lx.y, 0.99f * whole.irradiance.y) << tried;
    EXPECT_LE(r.irradiance.y, whole.irradiance.y * 1.0001f) << tried;
  }
}

/// Half of the photons stand twice in the same place: the same irradiance as with all apart.
TEST_P(Zones, PairsOfPhotonsCountTwice) {
  std::vector<Vec3> places = scattered(3000), twice(places.begin(), places.begin() + 1500);
  twice.insert(twice.end(), places.begin(), places.begin() + 1500);
  const double density = 3000 / (4 * std::numbers::pi);
  EXPECT_NEAR(record(map_at(places)).irradiance.y, density,
              4 * static_cast<double>(record(map_at(places)).stderr_lx.y));
  const IrradianceRecord r = record(map_at(twice));
  EXPECT_NEAR(r.irradiance.y, density, 4 * std::sqrt(2.0) * static_cast<double>(r.stderr_lx.y));
}

/// On the edge and the corner of the floor the hull finds the light of the zone's surface; just off it there
/// is something finite. At a corner one in eighty zones leaves so large a corner empty that it is taken for
/// dark (DensityOptions::dark_photons), and counted.
TEST_P(Zones, OnAnEdgeAndOnAVertex) {
  const double density = 40000 / 16.0;
  int dark = 0;
  for (std::uint64_t item = 0; item < 20; ++item) {
    RandomStream random(23, Stage::test, item);
    std::vector<Vec3> places;
    for (int i = 0; i < 40000; ++i) {
      const Vec2 u = random.uniform2();
      places.push_back({8 - 4 * u.x, 0, 8 - 4 * u.y});
    }
    const PhotonMap map = map_at(places);
    const struct {
      Vec3 p;
      double part;  // of a disc about p that is surface
    } cases[] = {{{8, 0, 6}, 0.5}, {{6, 0, 8}, 0.5}, {{8, 0, 8}, 0.25}, {{6.5f, 0, 6.5f}, 1}};
    for (const auto& [p, part] : cases) {
      const IrradianceRecord r = record(map, p);
      if (hull() && r.irradiance.y == 0) {
        ++dark;
        continue;
      }
      EXPECT_NEAR(r.irradiance.y, hull() ? density : part * density,
                  4.5 * static_cast<double>(r.stderr_lx.y) + 0.03 * density)
          << p.x << " " << p.z;
    }
    record(map, Vec3(8.0001f, 0, 6));
    record(map, Vec3(8.3f, 0, 8.3f));
  }
  EXPECT_LE(dark, 2);
  EXPECT_GE(counters_["records in the dark"], static_cast<std::uint64_t>(dark));
}

/// What came to the other side, or landed on a surface that faces elsewhere, is not counted; nor is what came
/// from below the tangent plane though the surface faced it.
TEST_P(Zones, OpposingNormals) {
  std::vector<Landed> front, back, below;
  for (const Vec3& p : scattered(2000)) {
    front.push_back({p});
    back.push_back({p, {0, -1, 0}, {0, -1, 0}});
    below.push_back({p, {0, 1, 0}, glm::normalize(Vec3(1, -0.2f, 0))});
  }
  EXPECT_EQ(record(map_of(back)).irradiance, Rgb(0));
  EXPECT_EQ(record(map_of(below)).irradiance, Rgb(0));
  EXPECT_EQ(record_of(map_of(front), {Vec3(0), {0, -1, 0}, 0}).irradiance, Rgb(0)) << "from below";
  const float alone = record(map_of(front)).irradiance.y;
  std::vector<Landed> all = front;
  all.insert(all.end(), back.begin(), back.end()), all.insert(all.end(), below.begin(), below.end());
  EXPECT_NEAR(record(map_of(all)).irradiance.y / alone, 1, 0.15);
  EXPECT_GT(alone, 0);
}

/// A record whose normal is far from the surface's own (smooth shading gone wrong): photons of the surface do
/// not count, and the record says that it has none.
TEST_P(Zones, SmoothNormalAgainstTheGeometricOne) {
  const PhotonMap map = map_at(scattered(2000));
  for (const Vec3& n : {glm::normalize(Vec3(1, 0.05f, 0)), Vec3(1, 0, 0), glm::normalize(Vec3(1, -1, 0))}) {
    const IrradianceRecord r = record_of(map, {Vec3(0), n, 0});
    EXPECT_EQ(r.irradiance, Rgb(0));
  }
  EXPECT_EQ(counters_["records without photons"], 3u);
}

/// Light that all comes straight from above has no gradient by its photons' own account. If more of it lands
/// to one side, something unseen takes it away on the other: counted, and followed by the gradients that
/// look at places. E(x) = E(0) (1 + 0.4 x) over 20,000 photons; zones of 0.8 m tell it to 0.04 E/m.
TEST_P(Zones, AnUnseenOccluderIsCounted) {
  RandomStream random(24, Stage::test, 0);
  std::vector<Vec3> even = scattered(20000), sloped;
  for (const Vec3& p : scattered(36000)) {
    if (random.uniform() * 1.8f < 1 + 0.4f * p.x) sloped.push_back(p);
  }
  RecordOptions options;
  options.max_photons = 100000;
  for (const auto& [mode, slope] : {std::pair{GradientMode::analytic, 0.f},
                                    {GradientMode::positional, 0.4f},
                                    {GradientMode::blend, 0.4f}}) {
    options.gradients = mode;
    const IrradianceRecord r = record_of(map_at(sloped), {Vec3(0), {0, 1, 0}, 0}, options);
    EXPECT_NEAR(r.translation_gradient[1].x / r.irradiance.y, slope, 0.16f);
    EXPECT_NEAR(r.translation_gradient[1].z / r.irradiance.y, 0, 0.16f);
    record_of(map_at(even), {Vec3(0), {0, 1, 0}, 0}, options);
  }
  // A kernel does not know where its surface ends, and so cannot tell.
  EXPECT_EQ(counters_["records at an occlusion gradient"], hull() ? 3u : 0u);
}

}  // namespace
}  // namespace phos
