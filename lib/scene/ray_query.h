// Rays as Embree takes them, one or sixteen at a time, and the panes that they pass.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <span>
#include <vector>

#include "scene/material/passage.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Hits on panes, of rays that go on: of each ray of a packet, in any order.
struct PaneLog {
  struct Entry {
    std::uint32_t ray;
    PaneHit hit;
  };
  std::vector<Entry> entries;

  /// Of one ray, up to a distance; valid until the next call.
  std::span<PaneHit> of(std::uint32_t ray, float end_m) {
    own_.clear();
    for (const Entry& e : entries)
      if (e.ray == ray && e.hit.distance_m <= end_m) own_.push_back(e.hit);
    return own_;
  }

 private:
  std::vector<PaneHit> own_;
};

/// What is passed to Embree with a ray; `log`: where hits on panes are put down, while the ray goes on; null:
/// they are hits like others.
struct RayContext {
  RTCIntersectContext embree;  // first, as Embree hands on its address
  PaneLog* log = nullptr;

  explicit RayContext(bool side_by_side = false, PaneLog* pane_log = nullptr) : log(pane_log) {
    rtcInitIntersectContext(&embree);
    if (side_by_side) embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
};

/// The log of this thread, empty.
inline PaneLog& fresh_log() {
  thread_local PaneLog log;
  log.entries.clear();
  return log;
}

/// Rays that run side by side.
inline constexpr std::size_t kPacket = 16;

/// At most that many rays.
inline void pack(std::span<const Ray> rays, float units_per_m, int (&valid)[kPacket], RTCRay16& packet) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    valid[i] = -1;
    const Vec3 origin = units_per_m * ray.origin;
    packet.org_x[i] = origin.x, packet.org_y[i] = origin.y, packet.org_z[i] = origin.z;
    packet.dir_x[i] = ray.direction.x, packet.dir_y[i] = ray.direction.y, packet.dir_z[i] = ray.direction.z;
    packet.tnear[i] = units_per_m * ray.t_min_m, packet.tfar[i] = units_per_m * ray.t_max_m;
    packet.time[i] = 0, packet.mask[i] = 0xffffffffu;
    packet.id[i] = static_cast<unsigned>(i), packet.flags[i] = 0;
  }
  // Where the machine's packets are narrower, Embree takes no notice of `valid` but of a ray's interval.
  std::fill(packet.tnear + rays.size(), packet.tnear + kPacket, 0.f);
  std::fill(packet.tfar + rays.size(), packet.tfar + kPacket, -1.f);
}

inline RTCRayHit embree_ray(const Ray& ray, float units_per_m) {
  RTCRayHit query;
  const Vec3 origin = units_per_m * ray.origin;
  query.ray.org_x = origin.x, query.ray.org_y = origin.y, query.ray.org_z = origin.z;
  query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
  query.ray.tnear = units_per_m * ray.t_min_m, query.ray.tfar = units_per_m * ray.t_max_m;
  query.ray.time = 0;
  query.ray.mask = 0xffffffffu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace phos::inline scene
