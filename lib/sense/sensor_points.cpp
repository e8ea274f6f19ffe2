#include "sense/sensor_points.h"

#include <iostream>
#include <istream>
#include <iterator>

#include "file/atomic_file.h"
#include "scene/point_table.h"
#include "sense/sensors.h"

namespace phos::inline sense {

Sensors parse_sensors(std::string_view text, const std::string& where, const DVec3& origin_m) {
  PointTable table = parse_points(text, where, origin_m);
  Sensors sensors;
  sensors.origin_m = origin_m;
  for (std::size_t i = 0; i < table.position.size(); ++i)
    sensors.points.push_back({table.position[i], table.normal[i]});
  sensors.ids = std::move(table.id);
  return sensors;
}

Sensors read_sensors(const std::string& path, const DVec3& origin_m) {
  if (path != "-") return parse_sensors(read_text(path), path, origin_m);
  const std::string all{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  return parse_sensors(all, "stdin", origin_m);
}

}  // namespace phos::inline sense
