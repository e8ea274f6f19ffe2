#include "splat/gl/lamp_map.h"

#include <algorithm>
#include <cmath>

namespace phos::inline splat {
namespace {

/// Of a luminaire's map, in a direction away from it.
float share_towards(const ShareMap& map, const Vec3& direction) {
  const Vec3 d = map.axes * direction;
  constexpr float kWide = ShareMap::kWidth - 1, kHigh = ShareMap::kHeight - 1;
  const float turn = std::atan2(d.y, d.x) / (2 * kPi);
  const float x = (turn - std::floor(turn)) * kWide, y = std::atan2(std::hypot(d.x, d.y), -d.z) / kPi * kHigh;
  const float fx = std::clamp(std::floor(x), 0.f, kWide - 1), fy = std::clamp(std::floor(y), 0.f, kHigh - 1);
  const auto at = [&](int dx, int dy) {
    return map.share[static_cast<std::size_t>((static_cast<int>(fy) + dy) * ShareMap::kWidth +
                                              static_cast<int>(fx) + dx)];
  };
  const float tx = x - fx, ty = y - fy;
  return std::lerp(std::lerp(at(0, 0), at(1, 0), tx), std::lerp(at(0, 1), at(1, 1), tx), ty);
}

float of_spot(const ShadowSample& s, float along) {
  const auto outer = static_cast<float>(s.cos_outer), inner = static_cast<float>(s.cos_inner);
  const float rise = std::max(inner - outer, 1e-12f);  // above 0 where the edge is hard
  const float falloff = along >= inner ? 1.f : along <= outer ? 0.f : (along - outer) / rise;
  return falloff * falloff;
}

}  // namespace

/// The depth of a texel is compared with the receiver's plane at that texel; a texel further off the point
/// lies on facets beside it the more.
float LampMap::lit_share(const Vec3& v, const Vec3& n, std::size_t face, int taps) const {
  const GlView& view = sample.faces.front();
  const float w = view.perspective ? -v.z : 1.f;
  if (!(w > 0)) return 1;
  const auto wide = static_cast<float>(size), bias = sample.bias * static_cast<float>(taps);
  const Vec2 lens(view.lens.x, view.lens.y), shift(view.lens.z, view.lens.w);
  const Vec2 ndc = (Vec2(v) * lens + shift * w) / w;
  const Vec2 place = glm::floor((ndc * 0.5f + 0.5f) * wide - 0.5f * static_cast<float>(taps - 1));
  if (!(std::fabs(place.x) < 1e6f && std::fabs(place.y) < 1e6f)) return 1;
  const std::size_t first = face * static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  int lit = 0;
  for (int y = 0; y < taps; ++y) {
    const int row = std::clamp(static_cast<int>(place.y) + y, 0, size - 1);
    for (int x = 0; x < taps; ++x) {
      const int column = std::clamp(static_cast<int>(place.x) + x, 0, size - 1);
      const float stored = depth[first + static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                                 static_cast<std::size_t>(column)];
      const Vec2 texel(static_cast<float>(column), static_cast<float>(row));
      const Vec2 centre = ((texel + 0.5f) / wide * 2.f - 1.f - shift) / lens;
      if (view.perspective) {
        const float here = view.depth.x / w, facing = glm::dot(n, v);
        const float on_plane = facing != 0 ? view.depth.x * glm::dot(n, Vec3(centre, -1)) / facing : 2 * here;
        lit += !(stored > std::clamp(on_plane, 0.5f * here, 2 * here) * (1 + bias));
      } else {
        const float here = view.depth.x - view.depth.y * v.z;
        const float z = n.z != 0 ? (glm::dot(n, v) - glm::dot(Vec2(n), centre)) / n.z : v.z;
        const float on_plane = view.depth.x - view.depth.y * z;
        lit += !(stored > std::clamp(on_plane, here - 8 * bias, here + 8 * bias) + bias);
      }
    }
  }
  return static_cast<float>(lit) / static_cast<float>(taps * taps);
}

bool LampMap::light(const Vec3& position, const Vec3& facet, int taps, MappedLight& light) const {
  if (sample.faces.empty()) return false;
  const Vec3 from = position - sample.faces.front().eye;
  std::size_t face = 0;
  Vec3 v = sample.faces.front().axes * from;
  light.direction = -sample.forward, light.lux = sample.colour;
  if (sample.shape != PlaceShape::directional) {
    for (std::size_t f = 1; f < sample.faces.size(); ++f) {
      const Vec3 other = sample.faces[f].axes * from;
      if (other.z < v.z) v = other, face = f;
    }
    const float square = glm::dot(v, v);
    if (!(square > 0)) return false;
    light.direction = -glm::normalize(from);
    light.lux /= square;
    const float along = -glm::dot(light.direction, sample.forward);
    const bool area = sample.shape == PlaceShape::area || sample.shape == PlaceShape::area_map;
    if (sample.shape == PlaceShape::map || sample.shape == PlaceShape::area_map)
      light.lux *= share_towards(*sample.map, -light.direction);
    if (area) light.lux *= sample.two_sided ? std::fabs(along) : std::max(along, 0.f);
    if (sample.shape == PlaceShape::spot) light.lux *= of_spot(sample, along);
  }
  if (light.lux == Rgb(0) || !(glm::dot(facet, light.direction) > 0)) return false;
  const float share = lit_share(v, sample.faces[face].axes * facet, face, taps);
  light.lux *= share;
  return share > 0;
}

}  // namespace phos::inline splat
