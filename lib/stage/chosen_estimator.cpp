#include "stage/chosen_estimator.h"

#include "core/error.h"
#include "radiance/gloss_cache.h"
#include "splat/raster/hemisphere_raster.h"

namespace phos::stage {
namespace {

GlossCache gloss_cache(const RayScene& rays, const RecordInputs& inputs, const RecordOptions& options) {
  const RadianceCache& radiance = *inputs.radiance;
  Counters told_by_phos_brdf;
  GlossTables tables(rays.scene(), inputs.brdf, GlossBy::automatic, {}, told_by_phos_brdf);
  GlossCache gloss(rays.scene().bounds, reading_accuracy(radiance.accuracy), std::move(tables),
                   options.leak_test == LeakTest::ray ? &rays : nullptr);
  for (const RadianceRecord& r : radiance.records) gloss.insert(r);
  if (gloss.size() == 0 && !radiance.records.empty() && !gloss.tables().orders().empty())
    throw Error(ExitCode::mismatch, "",
                text("radiance records of order ", radiance.order(),
                     " fit no lobe of the scene, as they were made with other lobes; give the .brdf file "
                     "that phos-radiance read, or rerun phos-radiance"));
  return gloss;
}

CoarseLevel coarse_of_diffuse(const RayScene& rays, const RecordInputs& inputs, const RecordOptions& options,
                              std::uint64_t seed) {
  const bool photons_only = of_photons_alone(options);
  if (photons_only && !inputs.photons) {
    throw Error(ExitCode::usage, "--estimate",
                "hull and kernel count photons; give the output of phos-photons too, or --estimate gather");
  }
  if (photons_only || options.gather_bounces == 1) return CoarseLevel();
  if (inputs.source)
    return CoarseLevel(rays, *inputs.source, inputs.photons ? &*inputs.photons : nullptr, options, seed);
  if (inputs.photons) return CoarseLevel(rays, *inputs.photons, options, seed);
  throw Error(ExitCode::usage, "--gather-bounces",
              "more than the first bounce needs photons or an earlier cache; give one of them, or "
              "--gather-bounces 1");
}

CoarseLevel coarse_level(const RayScene& rays, const RecordInputs& inputs, const RecordOptions& options,
                         std::uint64_t seed) {
  CoarseLevel level = coarse_of_diffuse(rays, inputs, options, seed);
  if (inputs.radiance && options.gather_bounces != 1)
    level.add(gloss_cache(rays, inputs, options), rays, inputs.radiance->caustics);
  return level;
}

EstimatorParts parts_of(const RayScene& rays, const Luminaires& lights, const RecordInputs& inputs,
                        const CoarseLevel& coarse, const RecordOptions& options, std::uint64_t seed) {
  return {rays,
          lights,
          [&inputs]() -> const PhotonMap& { return *inputs.photons; },
          [&coarse] { return coarse.source(); },
          options,
          seed};
}

}  // namespace

ChosenEstimator::ChosenEstimator(const RayScene& rays, const RecordInputs& inputs,
                                 const RecordOptions& options, std::uint64_t seed)
    : lights_(rays.scene()), coarse_(coarse_level(rays, inputs, options, seed)) {
  register_raster_estimator();
  estimator_ = make_estimator(parts_of(rays, lights_, inputs, coarse_, options, seed));
}
ChosenEstimator::~ChosenEstimator() = default;

ChosenRadianceEstimators::ChosenRadianceEstimators(const RayScene& rays, const RecordInputs& inputs,
                                                   const RadianceOptions& options, std::uint64_t seed)
    : rays_(rays),
      inputs_(inputs),
      options_(options),
      seed_(seed),
      lights_(rays.scene()),
      coarse_(coarse_level(rays, inputs, options.records, seed)) {
  register_raster_estimator();
}

std::unique_ptr<Estimator> ChosenRadianceEstimators::operator()(int order) const {
  return make_radiance_estimator(parts_of(rays_, lights_, inputs_, coarse_, options_.records, seed_), order,
                                 options_.gradients);
}

}  // namespace phos::stage
