#include "reference/map/photon_discs.h"

#include <algorithm>

namespace phos::inline reference {
namespace {

bool comes_straight(PhotonPath path) { return path == PhotonPath::direct || path == PhotonPath::mirrored; }

}  // namespace

PhotonDiscs::Disc PhotonDiscs::about(const SurfacePoint& point) const {
  Disc disc;
  std::vector<float> distance2_m2;
  photons_->nearest(point.position, k_, disc.row, distance2_m2);
  if (disc.row.size() < 2) return {};
  const float r2 = std::max(distance2_m2.back(), point.error_m * point.error_m);
  disc.row.pop_back();
  disc.per_m2 = 1 / (kPi * r2);
  return disc;
}

DiscRadiance PhotonDiscs::reflected(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo) const {
  DiscRadiance sum;
  Rgb squares(0);
  const Disc disc = about(point);
  for (const std::uint32_t row : disc.row) {
    const Vec3 wi = decode_octahedral(photons_->direction[row]);
    const Rgb f = bsdf.evaluate(wo, wi);
    if (f == Rgb(0)) continue;
    const Rgb flux = disc.per_m2 * photons_->flux[row], light = f * flux;
    squares += light * light;
    if (comes_straight(static_cast<PhotonPath>(photons_->path[row]))) {
      sum.direct += light;
      continue;
    }
    const Rgb gloss = bsdf.has_gloss() ? bsdf.evaluate_gloss(wo, wi) * flux : Rgb(0);
    sum.glossy += gloss, sum.indirect += light - gloss;
  }
  sum.noise = glm::sqrt(squares);
  return sum;
}

DiscIrradiance PhotonDiscs::irradiance(const SurfacePoint& point) const {
  DiscIrradiance sum;
  Rgb squares(0);
  const Disc disc = about(point);
  for (const std::uint32_t row : disc.row) {
    const Vec3 wi = decode_octahedral(photons_->direction[row]);
    if (!(glm::dot(wi, point.geometric_normal) > 0)) continue;
    const Rgb lux = disc.per_m2 * photons_->flux[row];
    sum.irradiance_lx += lux, squares += lux * lux;
  }
  sum.noise_lx = glm::sqrt(squares);
  return sum;
}

float PhotonDiscs::radius_m(const Vec3& p) const {
  std::vector<std::uint32_t> row;
  std::vector<float> distance2_m2;
  photons_->nearest(p, k_, row, distance2_m2);
  return distance2_m2.empty() ? kInfinity : std::sqrt(distance2_m2.back());
}

}  // namespace phos::inline reference
