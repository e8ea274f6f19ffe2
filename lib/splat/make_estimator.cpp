#include "splat/make_estimator.h"

#include "core/error.h"
#include "estimate/density.h"
#include "estimate/gather.h"
#include "estimate/radiance_density.h"
#include "estimate/radiance_gather.h"
#include "splat/gl/hemisphere_raster.h"

namespace phos {
namespace {

GlossCache gloss_cache(const RayScene& rays, const EstimateInputs& inputs, const RecordOptions& options) {
  const RadianceCache& radiance = *inputs.radiance;
  Counters told_by_phos_brdf;
  GlossTables tables(rays.scene(), inputs.brdf, GlossBy::automatic, {}, told_by_phos_brdf);
  GlossCache gloss(rays.scene().bounds, reading_accuracy(radiance.accuracy), std::move(tables),
                   options.leak_test == LeakTest::ray ? &rays : nullptr);
  for (const RadianceRecord& r : radiance.records) gloss.insert(r);
  if (gloss.size() == 0 && !radiance.records.empty() && !gloss.tables().orders().empty())
    throw Error(
        ExitCode::mismatch, "",
        text("radiance records of order ", radiance.order(),
             " serve no lobe: they were made with other lobes; give the .brdf file that phos-radiance "
             "read, or rerun phos-radiance"));
  return gloss;
}

CoarseLevel coarse_of_diffuse(const RayScene& rays, const EstimateInputs& inputs,
                              const RecordOptions& options, std::uint64_t seed) {
  const bool photons_only = of_photons_alone(options);
  if (photons_only && !inputs.photons) {
    throw Error(ExitCode::usage, "--estimate",
                "hull and kernel count photons; give the output of phos-photons too, or --estimate gather");
  }
  if (photons_only || options.gather_bounces == 1) return CoarseLevel();
  if (inputs.source)
    return CoarseLevel(rays, *inputs.source, inputs.photons ? &*inputs.photons : nullptr, options, seed);
  if (inputs.photons) return CoarseLevel(rays, *inputs.photons, options, seed);
  throw Error(
      ExitCode::usage, "--gather-bounces",
      "for more than the first bounce, give photons or an earlier cache too; --gather-bounces 1 needs none");
}

CoarseLevel coarse_level(const RayScene& rays, const EstimateInputs& inputs, const RecordOptions& options,
                         std::uint64_t seed) {
  CoarseLevel level = coarse_of_diffuse(rays, inputs, options, seed);
  if (inputs.radiance && options.gather_bounces != 1)
    level.add(gloss_cache(rays, inputs, options), rays, inputs.radiance->caustics);
  return level;
}

}  // namespace

ChosenEstimator::ChosenEstimator(const RayScene& rays, const EstimateInputs& inputs,
                                 const RecordOptions& options, std::uint64_t seed)
    : lights_(rays.scene()), coarse_(coarse_level(rays, inputs, options, seed)) {
  switch (options.estimate) {
    case Estimate::hull:
    case Estimate::kernel:
      estimator_ = std::make_unique<DensityEstimator>(*inputs.photons, rays, options, seed);
      break;
    case Estimate::gather:
      estimator_ = std::make_unique<GatherEstimator>(rays, lights_, coarse_.source(), options, seed);
      break;
    case Estimate::raster:
      estimator_ = std::make_unique<RasterEstimator>(rays, lights_, coarse_.source(), options, seed);
      break;
  }
}
ChosenEstimator::~ChosenEstimator() = default;

ChosenRadianceEstimators::ChosenRadianceEstimators(const RayScene& rays, const EstimateInputs& inputs,
                                                   const RadianceOptions& options, std::uint64_t seed)
    : rays_(rays),
      inputs_(inputs),
      options_(options),
      seed_(seed),
      lights_(rays.scene()),
      coarse_(coarse_level(rays, inputs, options.records, seed)) {}

std::unique_ptr<Estimator> ChosenRadianceEstimators::operator()(int order) const {
  if (options_.records.estimate == Estimate::hull)
    return std::make_unique<RadianceDensityEstimator>(*inputs_.photons, rays_, options_.records, order,
                                                      options_.gradients, seed_);
  return std::make_unique<RadianceEstimator>(rays_, lights_, coarse_.source(), options_.records, order,
                                             options_.gradients, seed_);
}

}  // namespace phos
