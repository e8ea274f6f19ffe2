// The noise of the light that gathered rays read.
#pragma once

#include <numbers>

#include "core/vector.h"
#include "estimate/gather_source.h"
#include "estimate/hit_light.h"

namespace phos::inline estimate {

/// Noise of the light that a hemisphere's rays read from the source.
class ReadNoise {
 public:
  explicit ReadNoise(const GatherSource& source)
      : photon_lm_(source.photon_lm),
        half_zone_(source.zone_photons * source.photon_lm / (2 * std::numbers::pi)),
        common_(source.common) {}

  /// What was read along one ray.
  void add(const HitLight::Worker::Read& read, float projected_sr, float cosine) {
    told_ += static_cast<double>(projected_sr * read.told);
    told_error_ += static_cast<double>(projected_sr * read.told_error);
    const auto lux = static_cast<double>(read.lux), d = static_cast<double>(read.distance_m);
    const auto projected = static_cast<double>(projected_sr), c = static_cast<double>(cosine);
    const double spread = c * (d * d * lux + half_zone_);
    if (!(lux > 0) || !(spread > 0)) return;  // of a source without noise
    irradiance_ += projected * DVec3(read.radiance);
    const DVec3 white =
        photon_lm_ * lux * static_cast<double>(read.cosine) * projected / spread * DVec3(read.noise);
    variance_ += c * c * white, white_ += white;
  }
  SourceNoise all() const {
    const double common = told_ > 0 ? told_error_ * told_error_ / (told_ * told_) : common_;
    return {irradiance_, variance_, white_ / (2 * std::numbers::pi), common};
  }

 private:
  double photon_lm_, half_zone_;  // m2 lx
  double common_;
  double told_ = 0, told_error_ = 0;  // of the rays that tell it
  DVec3 irradiance_{0}, variance_{0}, white_{0};
};

}  // namespace phos::inline estimate
