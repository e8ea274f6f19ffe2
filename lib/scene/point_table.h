// Points and the directions that they face, from text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

struct PointTable {
  std::vector<Vec3> position, normal;  ///< m; unit
  std::vector<std::string> id;         ///< one each, or empty
};

/// CSV whose first line names x,y,z (m) and nx,ny,nz, and perhaps id, in any order among other columns
/// ("x [m]" and "x_m" are read as x); or six numbers a line, between blanks or commas, as Radiance has them.
/// Lines that are empty or start with '#' are skipped. Throws Error(bad_input) naming line and column;
/// `where` is the text's name in messages. Positions are the world's, and come counted from `origin_m`.
PointTable parse_points(std::string_view text, const std::string& where, const DVec3& origin_m = DVec3(0));

}  // namespace phos::inline scene
