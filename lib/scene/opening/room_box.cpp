#include "scene/opening/room_box.h"

namespace phos::inline scene {
namespace {

/// Beyond the box of the lookers, of its diagonal: a flat box still has sides, and an opening in a
/// side of the room lies within the box, next to its face.
constexpr float kMargin = 3e-5f;

}  // namespace

Bounds box_about(std::span<const Looker> lookers) {
  Bounds box;
  for (const Looker& looker : lookers) box.include(looker.position);
  const Vec3 margin(kMargin * box.diagonal_m());
  box.include(box.lo - margin), box.include(box.hi + margin);
  return box;
}

Portal face_of(const Bounds& box, int face) {
  const int axis = face / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
  const bool upper = face % 2 == 1;
  Portal p;
  p.corner = box.lo;
  if (upper) p.corner[axis] = box.hi[axis];
  p.edge[0][first] = box.size()[first];
  p.edge[1][second] = box.size()[second];
  p.inwards[axis] = upper ? -1.f : 1.f;
  return p;
}

std::pair<int, Vec3> way_out(const Bounds& box, const Vec3& from, const Vec3& direction) {
  float nearest = kInfinity;
  int face = 0;
  for (int c = 0; c < 3; ++c) {
    if (direction[c] == 0) continue;
    const float t = ((direction[c] > 0 ? box.hi[c] : box.lo[c]) - from[c]) / direction[c];
    if (t < nearest) nearest = t, face = 2 * c + (direction[c] > 0);
  }
  return {face, from + nearest * direction};
}

}  // namespace phos::inline scene
