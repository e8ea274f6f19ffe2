// Places far from the world's origin: counted from an origin of the scene's own, so that floats can say them.
#pragma once

#include <string>

#include "core/json.h"
#include "core/vector.h"

namespace phos {

/// Bounds in double, m, of coordinates that floats would round.
struct DBounds {
  DVec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(lo.x <= hi.x); }
  void include(const DVec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  double diagonal_m() const { return empty() ? 0 : glm::length(hi - lo); }
};

/// The origin that suits a scene within `world`: zero where that reaches no farther from the world's origin
/// than sixteen diagonals, where floats hold it well; else about its centre, at a whole multiple of a power
/// of two not below the diagonal, so that whole metres stay whole. Zero for bounds that are empty, a point,
/// or not finite.
DVec3 suitable_origin_m(const DBounds& world);

/// A place of the world, counted from the origin; the difference is taken in double.
Vec3 from_world(const DVec3& world_m, const DVec3& origin_m);

/// A coordinate in the world, origin_m + v, in as few digits as give v back once the origin is taken away
/// again; the shortest text of v where the origin is 0.
std::string world_text(double origin_m, float v);
/// The number that this text says.
double world_number(double origin_m, float v);
/// A place in a message: "(1, 2, 3) m", in the world.
std::string place_text(const DVec3& origin_m, const Vec3& p);

/// Three numbers; and back, zero where `parts` (of a scene) has no "origin_m".
Json world_json(const DVec3& origin_m, const Vec3& p);
Json origin_json(const DVec3& origin_m);
DVec3 origin_in(const Json& parts);

}  // namespace phos
