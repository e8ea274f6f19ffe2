#include "scene/portal_light.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/near.h"

namespace phos {
namespace {

constexpr float kStray = 0.1f, kStrayOfSpots = 0.5f;
/// A piece is not taken for darker than this part of what the environment is on the mean: its middle may be.
constexpr float kLeastLuminance = 0.05f;

Vec3 corner_of(const Portal& p, int k) { return p.at(Vec2(k == 1 || k == 3, k >= 2)); }

SphericalPatch seen(const Portal& p, const Vec3& from) {
  const Vec3 corner[] = {corner_of(p, 0), corner_of(p, 1), corner_of(p, 2)};
  return p.triangle ? SphericalPatch(corner, from) : SphericalPatch(corner, corner_of(p, 3), from);
}

/// Distance from the plane of the piece, above 0 where it lets light through to that place.
float before_m(const Portal& p, const Vec3& normal, const Vec3& from) {
  const float height_m = glm::dot(from - p.corner, p.inwards == Vec3(0) ? normal : p.inwards);
  return p.inwards == Vec3(0) ? std::fabs(height_m) : height_m;
}

}  // namespace

PortalLight::PortalLight(const Environment& light, std::span<const Portal> portals,
                         std::shared_ptr<const PortalSight> sight)
    : light_(&light), sight_(std::move(sight)) {
  for (const Portal& p : portals) {
    Piece piece{p, Vec3(0), p.at(Vec2(p.triangle ? 1.f / 3 : 0.5f)), 0, 0};
    const DVec3 cross = glm::cross(DVec3(p.edge[0]), DVec3(p.edge[1]));
    piece.normal = Vec3(glm::normalize(cross));
    piece.area_m2 = static_cast<float>(p.area_m2());
    float radius_m = 0;
    for (int k = 0; k < (p.triangle ? 3 : 4); ++k)
      radius_m = std::max(radius_m, glm::length(corner_of(p, k) - piece.middle));
    piece.near2_m2 = kNearRadii * radius_m * (kNearRadii * radius_m);
    piece_.push_back(piece);
  }
  least_cd_m2_ = kLeastLuminance * static_cast<float>(light.map_lx()) / (4 * kPi);
  stray_ = light.has_spots() ? kStrayOfSpots : kStray;
}

float PortalLight::promise_lx(const Piece& piece, const Vec3& from) const {
  const float height_m = before_m(piece.portal, piece.normal, from);
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
    const Piece& piece = piece_[k];
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

/// The piece as it is seen, where that is so wide that it is sampled by solid angle.
std::optional<SphericalPatch> PortalLight::near(const Piece& piece, const Vec3& from) {
  const Vec3 way = piece.middle - from;
  if (!(glm::dot(way, way) < piece.near2_m2)) return {};
  const SphericalPatch patch = seen(piece.portal, from);
  if (!(patch.solid_angle_sr() > kLeastNear_sr)) return {};
  return patch;
}

double PortalLight::density_through(const Piece& piece, const Vec3& from, const Vec3& direction) {
  if (const auto patch = near(piece, from)) return 1 / patch->solid_angle_sr();
  const double height_m = std::fabs(glm::dot(DVec3(piece.portal.corner) - DVec3(from), DVec3(piece.normal)));
  const double cosine = std::fabs(glm::dot(DVec3(direction), DVec3(piece.normal)));
  const double distance_m = height_m / cosine;
  return distance_m * distance_m / (cosine * static_cast<double>(piece.area_m2));
}

float PortalLight::density(const Vec3& from, const Vec3& direction, const Chances& c,
                           const Piece* certain) const {
  const double rest = 1 - static_cast<double>(c.sun), stray = static_cast<double>(c.stray);
  double density = stray * rest * static_cast<double>(light_->density(direction));
  if (c.sun > 0 && light_->in_sun(direction)) density += static_cast<double>(c.sun) / light_->sun_sr();
  if (!(c.portals > 0)) return static_cast<float>(density);
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    const Piece& piece = piece_[k];
    const float promise = c.promise[k];
    if (!(promise > 0)) continue;
    // Light travels against the direction, from the other side of the piece.
    const Vec3 way = piece.portal.corner - from;
    const bool through = glm::dot(way, piece.normal) * glm::dot(direction, piece.normal) > 0 &&
                         crosses(piece.portal, DVec3(from), DVec3(direction));
    if (through || &piece == certain)
      density += (1 - stray) * rest * static_cast<double>(promise / c.portals) *
                 density_through(piece, from, direction);
  }
  return static_cast<float>(density);
}

float PortalLight::density(const Vec3& from, const Vec3& direction) const {
  return density(from, direction, chances(from), nullptr);
}

Environment::Sample PortalLight::sample_of(const Vec3& from, const Vec3& direction, const Chances& c,
                                           const Piece* certain) const {
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
  const Piece* piece = &piece_[choose(c, y, rest)];
  const Portal& portal = piece->portal;
  Vec3 place;
  if (const auto patch = near(*piece, from)) {
    const SphericalPatch::Place at = patch->sample({u.x, rest});
    place = portal.at(at.second ? Vec2(at.weights.x + at.weights.y, 1 - at.weights.x) : at.weights);
  } else {
    place = portal.at(portal.triangle ? sample_triangle({u.x, rest}) : Vec2(u.x, rest));
  }
  const Vec3 direction = normalized_or_zero(place - from);
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
