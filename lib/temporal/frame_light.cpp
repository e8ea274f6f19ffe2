#include "temporal/frame_light.h"

#include <algorithm>

#include "core/error.h"
#include "estimate/density.h"

namespace phos::inline temporal {

std::shared_ptr<const FrameScene> FrameScenes::at(std::int64_t frame) {
  const auto found =
      std::find_if(recent_.begin(), recent_.end(), [&](const auto& s) { return s->frame == frame; });
  if (found != recent_.end()) {
    std::rotate(found, found + 1, recent_.end());
    return recent_.back();
  }
  if (recent_.size() == kKept) recent_.erase(recent_.begin());
  recent_.push_back(std::make_shared<const FrameScene>(path_, options_, isa_, frame));
  ++loaded_;
  return recent_.back();
}

FrameLight::FrameLight(std::shared_ptr<const FrameScene> frame, const LightOptions& options,
                       const Film* source)
    : at_(std::move(frame)), options_(options), source_(source), lights_(at_->scene) {}
FrameLight::~FrameLight() = default;

const PhotonMap& FrameLight::photons(Counters& counters) {
  if (!photons_) {
    PhotonTotals totals;
    PhotonOptions options = options_.photons;
    // A frame in which every lamp is out is dark.
    const bool dark = std::none_of(scene().light.begin(), scene().light.end(),
                                   [](const Light& l) { return max_component(l.flux_lm) > 0; });
    if (dark) options.paths = 0;
    Photons traced = trace_photons(rays(), options, options_.seed, totals, counters);
    photons_ = std::make_unique<PhotonMap>(PhotonMap::build(std::move(traced), totals));
  }
  return *photons_;
}

const CoarseLevel& FrameLight::coarse(const RecordOptions& records, Counters& counters) {
  if (!coarse_) {
    if (records.gather_bounces == 1) {
      coarse_ = std::make_unique<CoarseLevel>();
    } else if (source_) {
      coarse_ = std::make_unique<CoarseLevel>(rays(), cache_at(*source_, frame(), scene()), nullptr, records,
                                              options_.seed);
    } else {
      coarse_ = std::make_unique<CoarseLevel>(rays(), photons(counters), records, options_.seed);
    }
  }
  return *coarse_;
}

EstimatorParts FrameLight::parts(const RecordOptions& records, Counters& counters) {
  return {rays(),
          lights_,
          [this, &counters]() -> const PhotonMap& { return photons(counters); },
          [this, &records, &counters] { return coarse(records, counters).source(); },
          records,
          options_.seed};
}

const Estimator& FrameLight::irradiance(Counters& counters) {
  if (!irradiance_) irradiance_ = make_estimator(parts(options_.records, counters));
  return *irradiance_;
}

const Estimator& FrameLight::source_records(Counters& counters) {
  if (!source_records_)
    source_records_ = std::make_unique<DensityEstimator>(photons(counters), rays(),
                                                         coarse_options(options_.records), options_.seed);
  return *source_records_;
}

const Estimator& FrameLight::radiance(int order, Counters& counters) {
  if (radiance_ && radiance_order_ == order) return *radiance_;
  radiance_order_ = order;
  radiance_ =
      make_radiance_estimator(parts(options_.radiance.records, counters), order, options_.radiance.gradients);
  return *radiance_;
}

}  // namespace phos::inline temporal
