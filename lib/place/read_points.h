// Places of records from text.
#pragma once

#include <string>
#include <vector>

#include "place/candidates.h"

namespace phos::inline place {

/// Points from CSV with a header naming x,y,z (m) and nx,ny,nz in any order among other columns; "x [m]" and
/// "x_m" are read as x. '#' starts a comment line. Throws Error(bad_input) naming line and column.
std::vector<SurfaceSample> read_points(const std::string& path, const DVec3& origin_m = DVec3(0));

}  // namespace phos::inline place
