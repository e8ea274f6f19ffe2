// What of the openings is seen from where.
#pragma once

#include <span>
#include <vector>

#include "scene/opening/portal.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// The box about the portals, parted into cells; of lines from places in a cell through places of a portal,
/// the part that nothing is in the way of. Only roughly, to choose by.
class PortalSight {
 public:
  PortalSight(const RayScene& rays, std::span<const Portal> portals);

  /// Of each portal, in (0, 1]; empty where it is not known, beyond the box.
  std::span<const float> from(const Vec3& place) const;

 private:
  std::size_t portals_ = 0;
  Bounds box_;
  std::vector<float> free_;  // cell by cell, of each portal
};

}  // namespace phos::inline scene
