// Radiance records from photons: a record of a zone of about 1,000 photons, and what of that is projection.
#include <benchmark/benchmark.h>

#include "core/sampling.h"
#include "estimate/radiance_density.h"
#include "support/photon_lobes.h"
#include "support/records.h"

namespace phos {
namespace {

struct Ground {
  test::Lit lit = test::light_up(test::cornell(), 1'000'000);
  RecordOptions options;
  std::vector<RecordSite> sites;
  Ground() {
    options.min_photons = options.max_photons = 1000;
    options.resolve(lit.scene->bounds.diagonal_m() / 4);
    for (std::uint64_t i = 0; sites.size() < 16; ++i) {
      RandomStream random(1, Stage::test, i);
      SurfacePoint point;
      const Vec3 along = sample_uniform_sphere(random.uniform2());
      if (trace(*lit.rays, {{0.28f, 0.45f, 0.28f}, along}, point))
        sites.push_back({point.position, point.smooth_normal, i});
    }
  }
};

/// Order 0: the irradiance record of the same zone.
void record(benchmark::State& state) {
  static const Ground g;
  const auto order = static_cast<int>(state.range(0));
  std::unique_ptr<Estimator> estimator;
  if (order == 0) {
    estimator = std::make_unique<DensityEstimator>(g.lit.photons, *g.lit.rays, g.options, 1);
  } else {
    estimator = std::make_unique<RadianceDensityEstimator>(g.lit.photons, *g.lit.rays, g.options, order,
                                                           RadianceGradient::analytic, 1);
  }
  const auto worker = estimator->make_worker();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(estimator->make(g.sites[i++ % g.sites.size()], *worker));
}
BENCHMARK(record)->Arg(0)->Arg(5)->Arg(7)->Arg(10)->Unit(benchmark::kMillisecond);

/// Of photons that are already there.
void projection(benchmark::State& state) {
  const test::PhotonSource source(test::gradient_scene("closed_box_5L"), 0.1);
  RandomStream random(1, Stage::test, 0);
  ZonePhotons zone;
  source.draw(1000, 1000, random, zone);
  const std::vector<std::uint8_t> used(zone.size(), 1);
  PhotonProjector projector(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        projector.project(zone, used, source.area_m2(), 0, Vec2(0), Frame(), RadianceGradient::analytic));
}
BENCHMARK(projection)->Arg(5)->Arg(7)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phos
