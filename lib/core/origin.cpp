#include "core/origin.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace phos {
namespace {

constexpr double kNear = 16;  // diagonals: floats are then within 1e-6 of a diagonal

bool is_finite(const DVec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

DVec3 suitable_origin_m(const DBounds& world) {
  const double diagonal = world.diagonal_m();
  if (!(diagonal > 0) || !std::isfinite(diagonal)) return DVec3(0);
  const DVec3 far = glm::max(glm::abs(world.lo), glm::abs(world.hi));
  if (std::max({far.x, far.y, far.z}) <= kNear * diagonal) return DVec3(0);
  const double step = std::exp2(std::ceil(std::log2(diagonal)));
  const DVec3 centre = 0.5 * world.lo + 0.5 * world.hi;
  const DVec3 origin = step * glm::round(centre / step) + 0.0;
  return is_finite(origin) ? origin : DVec3(0);
}

Vec3 from_world(const DVec3& world_m, const DVec3& origin_m) { return Vec3(world_m - origin_m); }

std::string world_text(double origin_m, float v) {
  if (origin_m == 0) return shortest(v);
  const double world = origin_m + static_cast<double>(v);
  std::array<char, 64> buffer;
  for (int digits = 1; digits < 17; ++digits) {
    const auto [end, problem] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), world,
                                              std::chars_format::general, digits);
    double back = 0;
    std::from_chars(buffer.data(), end, back);
    if (problem == std::errc() && static_cast<float>(back - origin_m) == v) return {buffer.data(), end};
  }
  return shortest(world);
}

double world_number(double origin_m, float v) {
  const std::string digits = world_text(origin_m, v);
  double world = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), world);
  return world;
}

std::string place_text(const DVec3& origin_m, const Vec3& p) {
  return text('(', world_text(origin_m.x, p.x), ", ", world_text(origin_m.y, p.y), ", ",
              world_text(origin_m.z, p.z), ") m");
}

Json world_json(const DVec3& origin_m, const Vec3& p) {
  Json::Array out;
  for (int c = 0; c < 3; ++c) {
    out.push_back(world_number(origin_m[c], p[c]));
  }
  return out;
}

Json origin_json(const DVec3& origin_m) { return Json::Array{origin_m.x, origin_m.y, origin_m.z}; }

DVec3 origin_in(const Json& parts) {
  const Json* origin = parts.find("origin_m");
  if (!origin || !origin->is_array() || origin->as_array().size() != 3) return DVec3(0);
  DVec3 out(0);
  for (int c = 0; c < 3; ++c) {
    const Json& v = origin->as_array()[static_cast<std::size_t>(c)];
    if (v.is_number() && std::isfinite(v.as_number())) out[c] = v.as_number();
  }
  return out;
}

}  // namespace phos
