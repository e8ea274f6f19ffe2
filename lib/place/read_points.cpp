#include "place/read_points.h"

#include "file/atomic_file.h"
#include "scene/point_table.h"

namespace phos::inline place {

std::vector<SurfaceSample> read_points(const std::string& path, const DVec3& origin_m) {
  const PointTable table = parse_points(read_text(path), path, origin_m);
  std::vector<SurfaceSample> points;
  for (std::size_t i = 0; i < table.position.size(); ++i)
    points.push_back({table.position[i], table.normal[i]});
  return points;
}

}  // namespace phos::inline place
