#include <algorithm>
#include <array>
#include <cmath>

#include "scene/find_portals.h"
#include "scene/openings.h"

namespace phos {
namespace {

constexpr int kCells = 64;      // along each side of a face of the box
constexpr int kFineCells = 64;  // and of what is found open in it
constexpr double kLeastSaved = 0.1;
/// Beyond the box of the lookers, of its diagonal: what is flat still has sides, and an opening in a
/// side of the room lies within the box, next to its face.
constexpr float kMargin = 3e-5f;

/// Face 2 * axis + (1 for the upper) of a box.
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

/// The face and the place of it at which a ray from within leaves the box.
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

/// An opening with less of what is closed about it, in one piece or more.
std::vector<Portal> refined(const RayScene& rays, std::span<const Looker> lookers, const Portal& found,
                            std::span<const std::uint32_t> witnesses, std::uint64_t number) {
  Openings fine(rays, lookers, found, kFineCells, number);
  fine.look(witnesses);
  fine.grow();
  const std::vector<Portal> parts = fine.rectangles(kLeastSaved);
  return parts.empty() ? std::vector<Portal>{found} : parts;
}

}  // namespace

std::vector<Portal> portals_about_rooms(const RayScene& rays) {
  const std::vector<Looker> lookers = look_about(rays);
  if (lookers.empty()) return {};
  Bounds box;
  for (const Looker& looker : lookers) box.include(looker.position);
  const Vec3 margin(kMargin * box.diagonal_m());
  box.include(box.lo - margin), box.include(box.hi + margin);
  std::vector<Openings> face;
  for (int f = 0; f < 6; ++f)
    face.emplace_back(rays, lookers, face_of(box, f), kCells, static_cast<std::uint64_t>(f));
  for (std::size_t i = 0; i < lookers.size(); ++i)
    for (const Vec3& direction : lookers[i].sky) {
      const auto [f, place] = way_out(box, lookers[i].position, direction);
      face[static_cast<std::size_t>(f)].mark(i, direction, place);
    }
  std::vector<Portal> out;
  for (Openings& openings : face) {
    openings.look({});
    openings.grow();
    for (const Portal& found : openings.rectangles(kLeastSaved)) {
      const auto parts = refined(rays, lookers, found, openings.witnesses(found), face.size() + out.size());
      out.insert(out.end(), parts.begin(), parts.end());
    }
  }
  return out;
}

}  // namespace phos
