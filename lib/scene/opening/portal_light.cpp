#include "scene/opening/portal_light.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"

namespace phos::inline scene {
namespace {

constexpr float kStray = 0.1f, kStrayOfSpots = 0.5f;
/// A piece is not taken for darker than this part of what the environment is on the mean: its middle may be.
constexpr float kLeastLuminance = 0.05f;
/// A portal behind a blind is chosen so often for each time that a gap is: light may come beside the gaps.
constexpr float kBesideGaps = 0.1f;
/// Edges whose angle has no greater cosine are those of a rectangle.
constexpr double kSquare = 1e-4;
/// Rectangles of more orientations than this (2 MB each) are sampled by solid angle.
constexpr std::size_t kMostMaps = 16;

/// Do the axes show rectangles of the others as boxes?
bool alike(const RectifiedMap::Axes& a, const RectifiedMap::Axes& b) {
  const double along = std::fabs(glm::dot(a.x, b.x)), across = std::fabs(glm::dot(a.x, b.z));
  return glm::dot(a.y, b.y) > 1 - kSquare * kSquare && std::min(along, across) < kSquare;
}

}  // namespace

PortalLight::PortalLight(const Environment& light, std::span<const Portal> portals,
                         std::shared_ptr<const PortalSight> sight, std::span<const Blind> blinds)
    : light_(&light), sight_(std::move(sight)), blind_(blinds.begin(), blinds.end()) {
  for (const Portal& p : portals) piece_.emplace_back(p), add_maps(piece_.back());
  for (const Blind& blind : blind_) {
    const Frame& frame = blind.slats().frame;
    const DVec3 x(frame.x), y(frame.y), z(frame.z);
    blind_sides_.push_back({map_of({x, z, y}), map_of({x, -z, y})});
  }
  least_cd_m2_ = kLeastLuminance * static_cast<float>(light.map_lx()) / (4 * kPi);
  stray_ = light.has_spots() ? kStrayOfSpots : kStray;
}

const RectifiedMap* PortalLight::map_of(const RectifiedMap::Axes& axes) {
  for (const auto& known : map_)
    if (alike(known->axes(), axes)) return known.get();
  if (map_.size() == kMostMaps || !(light_->map_lx() > 0)) return nullptr;
  map_.push_back(std::make_unique<const RectifiedMap>(*light_, axes));
  return map_.back().get();
}

void PortalLight::add_maps(const PortalPiece& piece) {
  const DVec3 x(piece.portal.edge[0]), z(piece.portal.edge[1]), n(piece.normal);
  Sides sides;
  const double lengths = glm::length(x) * glm::length(z);
  if (!piece.portal.triangle && std::fabs(glm::dot(x, z)) <= kSquare * lengths) {
    const DVec3 first = glm::normalize(x), second = glm::normalize(glm::cross(n, first));
    const float inwards = glm::dot(piece.portal.inwards, piece.normal);  // 0: both ways
    if (inwards <= 0) sides.along = map_of({first, n, second});
    if (inwards >= 0) sides.against = map_of({first, -n, second});
  }
  sides_.push_back(sides);
}

PortalLight::SeenMap PortalLight::seen_map(std::size_t piece, const Vec3& from) const {
  const Portal& portal = piece_[piece].portal;
  const DVec3 to_corner = DVec3(portal.corner) - DVec3(from);
  const bool along = glm::dot(to_corner, DVec3(piece_[piece].normal)) > 0;
  const RectifiedMap* map = along ? sides_[piece].along : sides_[piece].against;
  if (!map) return {};
  return seen_map(map, map->box(to_corner, to_corner + DVec3(portal.edge[0]) + DVec3(portal.edge[1])));
}

/// A gap is a box of directions, by its slopes.
PortalLight::SeenMap PortalLight::seen_map(std::size_t blind, const Blind::Gap& gap) const {
  const RectifiedMap* map = gap.towards_z ? blind_sides_[blind].along : blind_sides_[blind].against;
  if (!map) return {};
  // The map's axes may be those of another rectangle of this orientation: turned by quarters.
  const Frame& frame = blind_[blind].slats().frame;
  const DVec3 across = DVec3(gap.towards_z ? frame.z : -frame.z);
  return seen_map(map, map->box(across + gap.u[0] * DVec3(frame.x) + gap.v[0] * DVec3(frame.y),
                                across + gap.u[1] * DVec3(frame.x) + gap.v[1] * DVec3(frame.y)));
}

PortalLight::SeenMap PortalLight::seen_map(const RectifiedMap* map, const RectifiedMap::Box& box) {
  const double light_lx = map->light_lx(box);
  if (!(light_lx > 0)) return {};
  return {map, box, light_lx};
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
  if (seen.seen.map) return static_cast<float>(seen.seen.light_lx);
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

/// Portals behind blinds lose their promise to the gaps, but for a tenth of what the gaps promise.
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
  static thread_local std::vector<SeenMap> map;
  static thread_local std::vector<Blind::Gap> seen_gap;
  promise.assign(piece_.size(), 0), map.resize(piece_.size()), gap.clear();
  for (std::size_t b = 0; b < blind_.size(); ++b) {
    seen_gap.clear();
    blind_[b].gaps_from(from, seen_gap);
    for (const Blind::Gap& g : seen_gap) gap.push_back({&blind_[b], g, seen_map(b, g)});
  }
  const std::span<const float> seen = sight_ ? sight_->from(from) : std::span<const float>();
  Chances c;
  for (std::size_t k = 0; k < piece_.size(); ++k) {
    map[k] = seen_map(k, from);
    const float light_lx = map[k].map ? static_cast<float>(map[k].light_lx) : promise_lx(piece_[k], from);
    promise[k] = light_lx * (seen.empty() ? 1.f : std::sqrt(seen[k]));
  }
  for (const SeenGap& g : gap) promise.push_back(promise_lx(g));
  if (!gap.empty()) prefer_gaps(from, promise);
  for (const float p : promise) c.sum += p;
  if (!(c.sum > 0) || !std::isfinite(c.sum)) return {};
  c.promise = promise, c.map = map, c.gap = gap;
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

/// Of one gap, per sr.
double PortalLight::density(const SeenGap& seen, const Vec3& direction, bool certain) {
  if (!seen.seen.map) return seen.blind->density(seen.gap, direction, certain);
  return certain || seen.seen.map->holds(seen.seen.box, direction)
             ? seen.seen.map->density(seen.seen.light_lx, direction)
             : 0;
}

/// Of one piece, per sr.
double PortalLight::density(std::size_t k, const Vec3& from, const Vec3& direction, const Chances& c,
                            bool certain) const {
  const SeenMap& seen = c.map[k];
  if (seen.map)
    return certain || seen.map->holds(seen.box, direction) ? seen.map->density(seen.light_lx, direction) : 0;
  const PortalPiece& piece = piece_[k];
  // Light travels against the direction, from the other side of the piece.
  const Vec3 way = piece.portal.corner - from;
  const bool through = certain || (glm::dot(way, piece.normal) * glm::dot(direction, piece.normal) > 0 &&
                                   crosses(piece.portal, DVec3(from), DVec3(direction)));
  return through ? piece.density(from, direction) : 0;
}

float PortalLight::density(const Vec3& from, const Vec3& direction, const Chances& c,
                           std::size_t certain) const {
  const double rest = 1 - static_cast<double>(c.sun), stray = static_cast<double>(c.stray);
  double density = stray * rest * static_cast<double>(light_->density(direction));
  if (c.sun > 0 && light_->in_sun(direction)) density += static_cast<double>(c.sun) / light_->sun_sr();
  if (!(c.sum > 0)) return static_cast<float>(density);
  double aimed = 0;
  for (std::size_t k = 0; k < piece_.size(); ++k)
    if (c.promise[k] > 0)
      aimed += static_cast<double>(c.promise[k]) * this->density(k, from, direction, c, k == certain);
  for (std::size_t k = 0; k < c.gap.size(); ++k) {
    const std::size_t number = piece_.size() + k;
    if (c.promise[number] > 0)
      aimed += static_cast<double>(c.promise[number]) * this->density(c.gap[k], direction, number == certain);
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
    const Vec3 direction = seen.seen.map ? seen.seen.map->sample(seen.seen.box, {u.x, rest})
                                         : seen.blind->sample(seen.gap, {u.x, rest});
    return sample_of(from, direction, c, chosen);
  }
  if (const SeenMap& seen = c.map[chosen]; seen.map)
    return sample_of(from, seen.map->sample(seen.box, {u.x, rest}), c, chosen);
  const Vec3 direction = normalized_or_zero(piece_[chosen].sample(from, {u.x, rest}) - from);
  if (direction == Vec3(0)) return {};
  return sample_of(from, direction, c, chosen);
}

float PortalLight::promise_lx(const Vec3& from) const {
  const Chances c = chances(from);
  // A surface turned any way receives a quarter of what comes from all sides.
  if (!(c.sum > 0)) return 0.25f * luminance(Rgb(light_->integral_lx()));
  const float sun_lx = c.sun > 0 ? luminance(light_->sun()->illuminance_lx) : 0.f;
  return c.sum + sun_lx;
}

}  // namespace phos::inline scene
