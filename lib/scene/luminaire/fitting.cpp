#include "scene/luminaire/fitting.h"

#include <algorithm>

#include "core/error.h"
#include "core/sampling.h"
#include "file/hash.h"
#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {
namespace {

constexpr int kDirections = 512;  // by which the light of facets is shared out
constexpr float kSameNormal = 1e-6f;

}  // namespace

Fitting::Fitting(std::shared_ptr<const PhotometricFile> file, const Mat3& axes, const Rgb& colour)
    : file_(std::move(file)), photometry_(file_->photometry.get()), axes_(axes), colour_(colour) {}

Rgb Fitting::flux_lm() const { return Rgb(DVec3(colour_) * photometry_->flux_lm()); }
Rgb Fitting::peak_cd() const { return colour_ * photometry_->peak_cd(); }
Rgb Fitting::intensity_cd(const Vec3& direction) const {
  return colour_ * photometry_->candela(to_local(direction));
}

float Fitting::share(const Vec3& direction) const {
  const float peak = photometry_->peak_cd();
  return peak > 0 ? photometry_->candela(to_local(direction)) / peak : 0.f;
}

Vec3 Fitting::sample_direction(const Vec2& u) const {
  return normalized_or_zero(axes_ * photometry_->sample(u));
}

float Fitting::seen(const Vec3& normal, const Vec3& direction) const {
  const float cosine = glm::dot(normal, direction);
  return both_sides_ ? std::fabs(cosine) : std::max(cosine, 0.f);
}

void Fitting::set_surface(const std::vector<Vec4>& facets, bool both_sides) {
  both_sides_ = both_sides;
  facet_.clear(), plane_.clear();
  for (const Vec4& f : facets) {
    facet_.push_back({Vec3(f), f.w, 0});
    if (!plane_.empty() && glm::length(Vec3(plane_.back()) - Vec3(f)) < kSameNormal)
      plane_.back().w += f.w;
    else
      plane_.push_back(f);
  }
  if (!(photometry_->flux_lm() > 0)) return;
  std::vector<bool> dark;
  for (const Facet& f : facet_) {
    const Vec3 local = to_local(f.normal);
    dark.push_back(!photometry_->shines_towards(local) &&
                   !(both_sides && photometry_->shines_towards(-local)));
  }
  for (int i = 0; i < kDirections; ++i) {
    const Vec3 direction = sample_direction(r2_point(i, Vec2(0.5f)));
    const float area_m2 = projected_area_m2(direction);
    if (!(area_m2 > 0)) continue;
    for (Facet& f : facet_)
      f.lm_per_m2 +=
          photometry_->flux_lm() / kDirections * static_cast<double>(seen(f.normal, direction) / area_m2);
  }
  double lm = 0, m2 = 0;
  for (const Facet& f : facet_)
    lm += f.lm_per_m2 * static_cast<double>(f.area_m2), m2 += static_cast<double>(f.area_m2);
  // What so few directions miss may still be lit.
  for (std::size_t k = 0; k < facet_.size(); ++k)
    facet_[k].lm_per_m2 = dark[k] || !(m2 > 0) ? 0 : std::max(facet_[k].lm_per_m2, 0.01 * lm / m2);
}

float Fitting::projected_area_m2(const Vec3& direction) const {
  float sum = 0;
  for (const Vec4& plane : plane_) sum += plane.w * seen(Vec3(plane), direction);
  return sum;
}

Rgb Fitting::luminance(const Vec3& direction) const {
  const float area_m2 = projected_area_m2(direction);
  return area_m2 > 0 ? intensity_cd(direction) / area_m2 : Rgb(0);
}

std::size_t Fitting::seen_facet(const Vec3& direction, float u) const {
  PHOS_CHECK(!facet_.empty(), "an opening without surface");
  float rest = u * projected_area_m2(direction);
  std::size_t last = 0;
  for (std::size_t k = 0; k < facet_.size(); ++k) {
    const float area_m2 = facet_[k].area_m2 * seen(facet_[k].normal, direction);
    if (!(area_m2 > 0)) continue;
    last = k;
    if (rest < area_m2) break;
    rest -= area_m2;
  }
  return last;
}

void Fitting::add_to(Hasher& hasher) const {
  hasher.add(photometry_->hash());
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) hasher.add(axes_[c][r]);
  for (int c = 0; c < 3; ++c) hasher.add(colour_[c]);
}

}  // namespace phos::inline scene
