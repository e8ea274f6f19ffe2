// Sensors from files of points.
#pragma once

#include <string>
#include <string_view>

#include "core/vector.h"
#include "sense/sensors.h"

namespace phos::inline sense {

/// Sensors from a text file (parse_points), "-" is stdin; `origin_m` is the scene's.
Sensors read_sensors(const std::string& path, const DVec3& origin_m = DVec3(0));
/// The same from text; `where` is its name in messages.
Sensors parse_sensors(std::string_view text, const std::string& where, const DVec3& origin_m = DVec3(0));

}  // namespace phos::inline sense
