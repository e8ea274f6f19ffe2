#include "scene/opening/portal_sight.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"

namespace phos::inline scene {
namespace {

constexpr int kCells = 8;  // along each side of the box
constexpr std::uint32_t kLines = 32;

}  // namespace

PortalSight::PortalSight(const RayScene& rays, std::span<const Portal> portals) : portals_(portals.size()) {
  for (const Portal& p : portals)
    for (const Vec2 corner : {Vec2(0), Vec2(1, 0), Vec2(0, 1), Vec2(p.triangle ? 0.f : 1.f)})
      box_.include(p.at(corner));
  free_.resize(portals_ * kCells * kCells * kCells);
  parallel_for(kCells * kCells * kCells, 8, [&](std::size_t cell) {
    const Vec3 at(cell % kCells, cell / kCells % kCells, cell / (kCells * kCells));
    RandomStream random(0, Stage::pilot, cell);
    for (std::size_t k = 0; k < portals_; ++k) {
      random.start_bounce(static_cast<std::uint32_t>(k));
      const Portal& p = portals[k];
      std::uint32_t free = 0;
      for (std::uint32_t i = 0; i < kLines; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 place(random.uniform(), u);
        const Vec2 on = random.uniform2();
        const Vec3 from = box_.lo + box_.size() * ((at + place) / static_cast<float>(kCells));
        const Vec3 direction = normalized_or_zero(p.at(p.triangle ? sample_triangle(on) : on) - from);
        free += direction != Vec3(0) && max_component(rays.transmittance({from, direction})) > 0;
      }
      // As if half of one more were free: so few lines do not tell that it is hidden.
      free_[cell * portals_ + k] = (static_cast<float>(free) + 0.5f) / (static_cast<float>(kLines) + 1);
    }
  });
}

std::span<const float> PortalSight::from(const Vec3& place) const {
  const Vec3 size_m = box_.size(), at_m = place - box_.lo;
  std::size_t cell = 0;
  for (int c = 2; c >= 0; --c) {
    if (!(at_m[c] >= 0 && at_m[c] <= size_m[c])) return {};
    const float share = size_m[c] > 0 ? at_m[c] / size_m[c] : 0;
    cell = cell * kCells + static_cast<std::size_t>(std::min(static_cast<int>(share * kCells), kCells - 1));
  }
  return std::span(free_).subspan(cell * portals_, portals_);
}

}  // namespace phos::inline scene
