#include "photon/portal_split.h"

#include <algorithm>
#include <cmath>

namespace phos::inline photon {
namespace {

/// Of one scattering.
constexpr double kMostChildren = 256;
/// A surface is not taken for turned away from a portal of which it sees a part.
constexpr float kLeastCosine = 0.05f;

/// About the share of a Lambert surface's light that goes through, were nothing in its way.
double promise(const PortalPiece& piece, const SurfacePoint& point) {
  const float height_m = piece.behind_m(point.position);
  if (!(height_m > 0)) return 0;
  const Vec3 way = piece.middle - point.position;
  const float d2 = glm::dot(way, way), d = std::sqrt(d2);
  const float cosine = std::max(kLeastCosine, std::fabs(glm::dot(way, point.normal)) / d);
  return static_cast<double>(cosine * piece.area_m2 * height_m / (kPi * d * (d2 + piece.area_m2)));
}

}  // namespace

PortalSplit::PortalSplit(std::span<const Portal> portals, double unit_lm)
    : piece_(portals.begin(), portals.end()), unit_lm_(unit_lm) {}

float PortalSplit::first_crossing_m(const Vec3& origin, const Vec3& direction) const {
  float first_m = kInfinity;
  for (const PortalPiece& piece : piece_) {
    const Portal& p = piece.portal;
    const float along = glm::dot(direction, p.inwards == Vec3(0) ? piece.normal : p.inwards);
    if (along == 0 || (p.inwards != Vec3(0) && along < 0)) continue;
    const float distance_m =
        glm::dot(p.corner - origin, p.inwards == Vec3(0) ? piece.normal : p.inwards) / along;
    if (!(distance_m > 0) || !(distance_m < first_m)) continue;
    if (crosses(p, DVec3(origin), DVec3(direction))) first_m = distance_m;
  }
  return first_m;
}

void PortalSplit::children(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const Rgb& flux_lm,
                           RandomStream& random, std::vector<Child>& out) const {
  out.clear();
  const float landed = std::fabs(glm::dot(wo, point.geometric_normal));
  if (!bsdf.scatters() || !(landed > 0)) return;
  static thread_local std::vector<double> promises;
  promises.resize(piece_.size());
  double all = 0;
  for (std::size_t k = 0; k < piece_.size(); ++k) all += promises[k] = promise(piece_[k], point);
  const double expected = all * static_cast<double>(luminance(flux_lm)) / unit_lm_;
  if (!(expected > 0) || !std::isfinite(expected)) return;
  const double mean = std::min(expected, kMostChildren);
  const auto count = static_cast<int>(mean + random.uniform_double());
  for (int i = 0; i < count; ++i) {
    double rest = random.uniform_double() * all;
    const Vec2 u = random.uniform2();
    std::size_t k = 0, chosen = 0;
    for (; k < piece_.size(); ++k) {
      if (!(promises[k] > 0)) continue;
      chosen = k;
      if (rest < promises[k]) break;
      rest -= promises[k];
    }
    const Vec3 direction = normalized_or_zero(piece_[chosen].sample(point.position, u) - point.position);
    const Rgb f = direction == Vec3(0) ? Rgb(0) : bsdf.evaluate(wo, direction);
    if (f == Rgb(0)) continue;
    // Of this direction by any of the pieces.
    double density = 0;
    for (std::size_t j = 0; j < piece_.size(); ++j)
      if (promises[j] > 0 &&
          (j == chosen || crosses(piece_[j].portal, DVec3(point.position), DVec3(direction))))
        density += promises[j] / all * piece_[j].density(point.position, direction);
    // Flux crosses the surface by the geometric normal, and is scattered by the shading one (Veach
    // 1997, 5.3).
    const float cosine = std::fabs(glm::dot(direction, point.geometric_normal)) / landed *
                         std::fabs(glm::dot(wo, point.normal));
    if (density > 0)
      out.push_back({direction, f * static_cast<float>(static_cast<double>(cosine) / (density * mean))});
  }
}

}  // namespace phos::inline photon
