#include "scene/opening/portals_about_rooms.h"

#include "scene/opening/openings.h"
#include "scene/opening/room_box.h"
#include "scene/opening/waist.h"

namespace phos::inline scene {
namespace {

constexpr int kCells = 64;      // along each side of a face of the box
constexpr int kFineCells = 64;  // and of the parts found open in it
constexpr double kLeastSaved = 0.1;

/// An opening with less of the closed surface about it, in one piece or more.
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
  std::vector<Looker> lookers = look_about(rays);
  draw_to_waists(lookers);
  if (lookers.empty()) return {};
  const Bounds box = box_about(lookers);
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

}  // namespace phos::inline scene
