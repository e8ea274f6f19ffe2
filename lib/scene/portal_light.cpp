#include "scene/portal_light.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"

namespace phos {
namespace {

constexpr float kStray = 0.1f, kStrayOfSpots = 0.5f;
/// A piece is not taken for darker than this part of what the environment is on the mean: its middle may be.
constexpr float kLeastLuminance = 0.05f;

}  // namespace

PortalLight::PortalLight(const Environment& light, std::span<const Portal> portals,
                         std::shared_ptr<const PortalSight> sight)
    : light_(&light), sight_(std::move(sight)) {
  for (const Portal& p : portals) piece_.emplace_back(p);
  least_cd_m2_ = kLeastLuminance * static_cast<float>(light.map_lx()) / (4 * kPi);
  stray_ = light.has_spots() ? kStrayOfSpots : kStray;
}

float PortalLight::promise_lx(const PortalPiece& piece, const Vec3& from) const {
  const float height_m = piece.before_m(from);
  if (!(height_m > 0)) return 0;
  const Vec3 way = piece.middle - from;
  const float d2 = glm::dot(way, way), d = std::sqrt(d2);
  const float cd_m2 = std::max(luminance(light_->map_luminance(way / d)), least_cd_m2_);
  return cd_m2 * piece.area_m2 * height_m / (d * (d2 + piece.area_m2));
}

PortalLight::Chances PortalLight::chances(const Vec3& from) const {
  static thread_local std::vector<float> promise;
  promise.resize(piece_.size());
  const std::span<const float> seen = sight_ ? sight_->from(from) : std::span<const float>();
  Chances c;
  for (std::size_t k = 0; k < piece_.size(); ++k)
    c.portals += promise[k] = promise_lx(piece_[k], from) * (seen.empty() ? 1.f : std::sqrt(seen[k]));
  if (!(c.portals > 0) || !std::isfinite(c.portals)) return {};
  c.promise = promise;
  c.stray = stray_;
  if (!light_->sun() || !(light_->sun_chance() > 0)) return c;
  const DVec3& towards = light_->sun()->towards;
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    const PortalPiece& piece = piece_[k];
    if (!(promise[k] > 0) || !crosses(piece.portal, DVec3(from), towards)) continue;
    const double side = glm::dot(DVec3(piece.portal.corner) - DVec3(from), DVec3(piece.normal));
    if (side * glm::dot(towards, DVec3(piece.normal)) > 0) c.sun = static_cast<float>(light_->sun_chance());
  }
  return c;
}

std::size_t PortalLight::choose(const Chances& c, float u, float& rest) {
  float beyond = u * c.portals;
  std::size_t last = 0;
  rest = kBelowOne;
  for (std::size_t k = 0; k < c.promise.size(); ++k) {
    if (!(c.promise[k] > 0)) continue;
    last = k;
    if (beyond < c.promise[k]) {
      rest = std::min(beyond / c.promise[k], kBelowOne);
      break;
    }
    beyond -= c.promise[k];
  }
  return last;
}

float PortalLight::density(const Vec3& from, const Vec3& direction, const Chances& c,
                           const PortalPiece* certain) const {
  const double rest = 1 - static_cast<double>(c.sun), stray = static_cast<double>(c.stray);
  double density = stray * rest * static_cast<double>(light_->density(direction));
  if (c.sun > 0 && light_->in_sun(direction)) density += static_cast<double>(c.sun) / light_->sun_sr();
  if (!(c.portals > 0)) return static_cast<float>(density);
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    const PortalPiece& piece = piece_[k];
    const float promise = c.promise[k];
    if (!(promise > 0)) continue;
    // Light travels against the direction, from the other side of the piece.
    const Vec3 way = piece.portal.corner - from;
    const bool through = glm::dot(way, piece.normal) * glm::dot(direction, piece.normal) > 0 &&
                         crosses(piece.portal, DVec3(from), DVec3(direction));
    if (through || &piece == certain)
      density +=
          (1 - stray) * rest * static_cast<double>(promise / c.portals) * piece.density(from, direction);
  }
  return static_cast<float>(density);
}

float PortalLight::density(const Vec3& from, const Vec3& direction) const {
  return density(from, direction, chances(from), nullptr);
}

Environment::Sample PortalLight::sample_of(const Vec3& from, const Vec3& direction, const Chances& c,
                                           const PortalPiece* certain) const {
  return {direction, light_->luminance(direction), density(from, direction, c, certain)};
}

Environment::Sample PortalLight::sample(const Vec3& from, const Vec2& u) const {
  const Chances c = chances(from);
  if (!(c.portals > 0)) return light_->sample(u);
  float y = u.y;
  if (y < c.sun) return sample_of(from, light_->sample_sun({u.x, y / c.sun}), c, nullptr);
  y = std::min((y - c.sun) / (1 - c.sun), kBelowOne);
  if (y < c.stray) {
    const Environment::Sample any = light_->sample({u.x, y / c.stray});
    return any.density > 0 ? sample_of(from, any.direction, c, nullptr) : any;
  }
  y = std::min((y - c.stray) / (1 - c.stray), kBelowOne);
  float rest = 0;
  const PortalPiece* piece = &piece_[choose(c, y, rest)];
  const Vec3 direction = normalized_or_zero(piece->sample(from, {u.x, rest}) - from);
  if (direction == Vec3(0)) return {};
  return sample_of(from, direction, c, piece);
}

float PortalLight::promise_lx(const Vec3& from) const {
  const Chances c = chances(from);
  // A surface turned any way receives a quarter of what comes from all sides.
  if (!(c.portals > 0)) return 0.25f * luminance(Rgb(light_->integral_lx()));
  const float sun_lx = c.sun > 0 ? luminance(light_->sun()->illuminance_lx) : 0.f;
  return c.portals + sun_lx;
}

}  // namespace phos
