#include "scene/material/oren_nayar.h"

#include <algorithm>
#include <cmath>

#include "scene/material/models.h"

namespace phos::inline scene {
namespace {

constexpr float kLeastCosine = 1e-6f;
/// Of roughness r, A = 1 / (1 + kLost r), and the mean albedo of single reflection at kd 1 is A (1 + kMean
/// r).
constexpr float kLost = 0.5f - 2 / (3 * kPi);
constexpr float kMean = 2 / 3.f - 28 / (15 * kPi);

/// G / pi: single reflection at kd 1 has the albedo A (1 + r G / pi).
float gain(float cosine) {
  const float c = std::clamp(cosine, 0.f, 1.f), s = std::sqrt(std::max(0.f, 1 - c * c));
  // tan (1 - sin^3), without its pole at grazing angles
  const float bent = s * c * (1 + s + s * s) / (1 + s);
  return (s * (std::acos(c) - s * c) + 2 / 3.f * (bent - s)) / kPi;
}

/// Albedo that single reflection lacks at kd 1, over A r. Its cosine-weighted mean is kLost - kMean.
float lacking(float cosine) { return std::max(kLost - gain(cosine), 0.f); }

}  // namespace

float OrenNayar::roughness(float sigma_rad) {
  const float s2 = sigma_rad * sigma_rad;
  if (!(s2 > 0)) return 0;
  const float a = 1 - 0.5f / (1 + 0.33f / s2), b = 0.45f / (1 + 0.09f / s2);  // of the qualitative model
  return b / a;
}

OrenNayar::OrenNayar(const Rgb& kd, float sigma_rad) : roughness_(roughness(sigma_rad)) {
  const float a = 1 / (1 + kLost * roughness_), mean = a * (1 + kMean * roughness_);
  const Rgb most_one = glm::min(kd, Rgb(1));
  const Rgb further = kd * most_one * mean / (Rgb(1) - most_one * (1 - mean));
  single_ = kd * (a / kPi);
  multiple_ = further * (a * roughness_ / (kPi * (kLost - kMean)));
}

Rgb OrenNayar::value(const Vec3& o, const Vec3& i) const {
  const float s = o.x * i.x + o.y * i.y;
  const float contrast = s > 0 ? s / std::max(std::max(o.z, i.z), kLeastCosine) : s;
  return (1 + roughness_ * contrast) * single_ + (lacking(o.z) * lacking(i.z)) * multiple_;
}

Rgb OrenNayar::albedo(float cosine) const {
  return kPi * ((1 + roughness_ * gain(cosine)) * single_ + (kLost - kMean) * lacking(cosine) * multiple_);
}

Rgb OrenNayar::mean_albedo() const {
  return kPi * ((1 + roughness_ * kMean) * single_ + (kLost - kMean) * (kLost - kMean) * multiple_);
}

ReflectionSummary summarise_oren_nayar(const SummaryInput& in) {
  const Material& m = in.material;
  const OrenNayar surface(m.kd * static_cast<float>(in.base), m.sigma_rad);
  return {luminance(surface.mean_albedo()), in.kd > 0, in.kd > 0 && surface.rough()};
}

}  // namespace phos::inline scene
