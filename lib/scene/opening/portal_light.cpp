#include "scene/opening/portal_light.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"

namespace phos::inline scene {
namespace {

constexpr float kStray = 0.1f, kStrayOfSpots = 0.5f;
/// A piece is not taken for darker than this part of the environment's mean: its middle may be.
constexpr float kLeastLuminance = 0.05f;
/// A portal behind a blind is chosen so often for each time that a gap is: light may come beside the gaps.
constexpr float kBesideGaps = 0.1f;

}  // namespace

PortalLight::PortalLight(const Environment& light, std::span<const Portal> portals,
                         std::shared_ptr<const PortalSight> sight, std::span<const Blind> blinds)
    : light_(&light), sight_(std::move(sight)), blind_(blinds.begin(), blinds.end()) {
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

float PortalLight::promise_lx(const SeenGap& seen) const {
  const Vec3 middle = seen.blind->sample(seen.gap, Vec2(0.5f));
  const float cd_m2 = std::max(luminance(light_->map_luminance(middle)), least_cd_m2_);
  return cd_m2 * static_cast<float>(seen.gap.solid_angle_sr());
}

float PortalLight::share_behind_blinds(const PortalPiece& piece, const Vec3& from) const {
  constexpr float kLo = 0.2f, kHi = 0.8f;
  constexpr Vec2 kPlaces[] = {{0.4f, 0.4f}, {kLo, kLo}, {kHi, kLo}, {kLo, kHi}, {kHi, kHi}};
  int behind = 0;
  for (const Vec2& u : kPlaces) {
    const Vec2 place = piece.portal.triangle ? sample_triangle(u) : u;
    const Vec3 way = piece.portal.at(place) - from;
    behind +=
        std::any_of(blind_.begin(), blind_.end(), [&](const Blind& b) { return b.is_before(from, way); });
  }
  return static_cast<float>(behind) / static_cast<float>(std::size(kPlaces));
}

/// Portals behind blinds lose their promise to the gaps, but for a tenth of the gaps' promise.
void PortalLight::prefer_gaps(const Vec3& from, std::vector<float>& promise) const {
  float gaps = 0, behind = 0;
  for (std::size_t k = piece_.size(); k < promise.size(); ++k) gaps += promise[k];
  static thread_local std::vector<float> share;
  share.assign(piece_.size(), 0);
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    if (promise[k] > 0) share[k] = share_behind_blinds(piece_[k], from);
    behind += promise[k] * share[k];
  }
  const float left = behind > 0 ? std::min(kBesideGaps * gaps / behind, 1.f) : 1.f;
  for (std::size_t k = 0; k < piece_.size(); ++k) promise[k] *= 1 - share[k] * (1 - left);
}

PortalLight::Chances PortalLight::chances(const Vec3& from) const {
  static thread_local std::vector<float> promise;
  static thread_local std::vector<SeenGap> gap;
  static thread_local std::vector<Blind::Gap> seen_gap;
  promise.assign(piece_.size(), 0), gap.clear();
  for (const Blind& blind : blind_) {
    seen_gap.clear();
    blind.gaps_from(from, seen_gap);
    for (const Blind::Gap& g : seen_gap) gap.push_back({&blind, g});
  }
  const std::span<const float> seen = sight_ ? sight_->from(from) : std::span<const float>();
  Chances c;
  for (std::size_t k = 0; k < piece_.size(); ++k)
    promise[k] = promise_lx(piece_[k], from) * (seen.empty() ? 1.f : std::sqrt(seen[k]));
  for (const SeenGap& g : gap) promise.push_back(promise_lx(g));
  if (!gap.empty()) prefer_gaps(from, promise);
  for (const float p : promise) c.sum += p;
  if (!(c.sum > 0) || !std::isfinite(c.sum)) return {};
  c.promise = promise, c.gap = gap;
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
  float beyond = u * c.sum;
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
                           std::size_t certain) const {
  const double rest = 1 - static_cast<double>(c.sun), stray = static_cast<double>(c.stray);
  double density = stray * rest * static_cast<double>(light_->density(direction));
  if (c.sun > 0 && light_->in_sun(direction)) density += static_cast<double>(c.sun) / light_->sun_sr();
  if (!(c.sum > 0)) return static_cast<float>(density);
  double aimed = 0;
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    const PortalPiece& piece = piece_[k];
    if (!(c.promise[k] > 0)) continue;
    // Light travels against the direction, from the other side of the piece.
    const Vec3 way = piece.portal.corner - from;
    const bool through = glm::dot(way, piece.normal) * glm::dot(direction, piece.normal) > 0 &&
                         crosses(piece.portal, DVec3(from), DVec3(direction));
    if (through || k == certain) aimed += static_cast<double>(c.promise[k]) * piece.density(from, direction);
  }
  for (std::size_t k = 0; k < c.gap.size(); ++k) {
    const SeenGap& seen = c.gap[k];
    const std::size_t number = piece_.size() + k;
    if (c.promise[number] > 0)
      aimed += static_cast<double>(c.promise[number]) *
               seen.blind->density(seen.gap, direction, number == certain);
  }
  return static_cast<float>(density + (1 - stray) * rest * aimed / static_cast<double>(c.sum));
}

float PortalLight::density(const Vec3& from, const Vec3& direction) const {
  return density(from, direction, chances(from), kNone);
}

Environment::Sample PortalLight::sample_of(const Vec3& from, const Vec3& direction, const Chances& c,
                                           std::size_t certain) const {
  return {direction, light_->luminance(direction), density(from, direction, c, certain)};
}

Environment::Sample PortalLight::sample(const Vec3& from, const Vec2& u) const {
  const Chances c = chances(from);
  if (!(c.sum > 0)) return light_->sample(u);
  float y = u.y;
  if (y < c.sun) return sample_of(from, light_->sample_sun({u.x, y / c.sun}), c, kNone);
  y = std::min((y - c.sun) / (1 - c.sun), kBelowOne);
  if (y < c.stray) {
    const Environment::Sample any = light_->sample({u.x, y / c.stray});
    return any.density > 0 ? sample_of(from, any.direction, c, kNone) : any;
  }
  y = std::min((y - c.stray) / (1 - c.stray), kBelowOne);
  float rest = 0;
  const std::size_t chosen = choose(c, y, rest);
  if (chosen >= piece_.size()) {
    const SeenGap& seen = c.gap[chosen - piece_.size()];
    return sample_of(from, seen.blind->sample(seen.gap, {u.x, rest}), c, chosen);
  }
  const Vec3 direction = normalized_or_zero(piece_[chosen].sample(from, {u.x, rest}) - from);
  if (direction == Vec3(0)) return {};
  return sample_of(from, direction, c, chosen);
}

float PortalLight::promise_lx(const Vec3& from) const {
  const Chances c = chances(from);
  // A surface turned any way receives a quarter of the light from all sides.
  if (!(c.sum > 0)) return 0.25f * luminance(Rgb(light_->integral_lx()));
  const float sun_lx = c.sun > 0 ? luminance(light_->sun()->illuminance_lx) : 0.f;
  return c.sum + sun_lx;
}

}  // namespace phos::inline scene
