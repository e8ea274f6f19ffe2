#include "temporal/visible_places.h"

#include <algorithm>

#include "core/parallel.h"
#include "place/view_candidates.h"
#include "record/tree.h"
#include "scene/load.h"
#include "scene/picture.h"

namespace phos::inline temporal {
namespace {

constexpr std::size_t kTaskPixels = 1024;
constexpr std::size_t kHolePixels = 64;  // that are looked at again where one of them shows a hole

struct Seen {
  VisiblePlaces::Open open;
  std::vector<std::size_t> in_sight;
  std::uint64_t lost = 0;
};

/// What a frame's view shows.
Candidates seen_by(const FrameScene& at, const PlacementOptions& placement, const MaterialFilter& wanted) {
  PlacementOptions size = placement;
  const Camera& camera = find_camera(at.scene, placement.camera);
  resolve_size(camera, kPictureSide, size.width, size.height);
  const View view{camera, size.width, size.height, placement.min_radius_pixels.value(),
                  placement.max_radius_pixels};
  return view_candidates(at.rays, view, wanted);
}

}  // namespace

std::vector<RecordSite> holes_in_view(const FrameScene& at, const IrradianceCache& known,
                                      const PlacementOptions& placement, const MaterialFilter& wanted,
                                      const MaterialFilter& unwanted, std::uint64_t first_item) {
  RecordTree tree(at.scene.bounds, known.accuracy);
  for (const IrradianceRecord& r : known.records) tree.insert(r);
  const Candidates candidates = seen_by(at, placement, wanted);
  const std::size_t pixels = candidates.count / kViewSamples;
  const auto add_holes = [&](std::size_t begin, std::size_t end, std::vector<RecordSite>& holes) {
    std::vector<RecordSite> sites;
    for (std::size_t i = begin; i < end; ++i) candidates.sites(i, sites);
    for (const RecordSite& site : sites) {
      if (tree.covered(site.position, site.normal)) continue;
      if (unwanted) {
        const auto material = material_at(at.rays, site.position, site.normal);
        if (!material || unwanted(*material)) continue;
      }
      holes.push_back(site);
    }
  };
  std::vector<RecordSite> holes = parallel_reduce<std::vector<RecordSite>>(
      pixels, kHolePixels, {},
      [&](std::size_t begin, std::size_t end) {
        std::vector<RecordSite> part;
        add_holes(begin, end, part);
        if (!part.empty())
          for (std::size_t k = 1; k < kViewSamples; ++k)
            add_holes(k * pixels + begin, k * pixels + end, part);
        return part;
      },
      [](std::vector<RecordSite>& all, const std::vector<RecordSite>& part) {
        all.insert(all.end(), part.begin(), part.end());
      });
  for (RecordSite& site : holes) site.item = first_item++;
  return holes;
}

VisiblePlaces::VisiblePlaces(const FrameLight& light, const IrradianceCache& known,
                             const PlacementOptions& placement, const MaterialFilter& wanted,
                             const MaterialFilter& unwanted, std::uint64_t first_item)
    : light_(light),
      placement_(placement),
      wanted_(wanted),
      unwanted_(unwanted),
      next_item_(first_item),
      accuracy_(static_cast<float>(known.accuracy)),
      tree_(light.scene().bounds, reading_accuracy(known.accuracy)),
      in_sight_(known.records.size(), false) {
  for (const IrradianceRecord& r : known.records) tree_.insert(r);
}

VisiblePlaces::Open VisiblePlaces::look(const FrameScene& at) {
  const Changes since = changes(light_.scene(), at.scene);
  const bool still = !since.anything_moved();
  const Candidates candidates = seen_by(at, placement_, wanted_);
  // One sample of each pixel, another one at each look.
  const std::size_t pixels = candidates.count / kViewSamples, first = looks_++ % kViewSamples * pixels;
  Seen seen = parallel_reduce<Seen>(
      pixels, kTaskPixels, {},
      [&](std::size_t begin, std::size_t end) {
        Seen part;
        std::vector<RecordSite> sites;
        std::vector<const IrradianceRecord*> found;
        for (std::size_t i = begin; i < end; ++i) candidates.sites(first + i, sites);
        for (RecordSite& site : sites) {
          const RecordSite seen = site;
          if (!still || unwanted_) {
            const Anchor anchor = anchor_at(at.rays, site.position, site.normal);
            if (anchor.triangle == kNoTriangle) {
              ++part.lost;
              continue;
            }
            if (unwanted_ &&
                unwanted_(at.scene.instance[at.scene.triangle_instance[anchor.triangle]].material))
              continue;
            if (since.moved[at.scene.triangle_instance[anchor.triangle]]) {
              const std::optional<Pose> then = pose_of(at.scene, anchor),
                                        now = pose_of(light_.scene(), anchor);
              if (!then) {
                ++part.lost;
                continue;
              }
              if (!now) {
                part.open.then.push_back(seen);
                continue;
              }
              site.position = now->position;
              site.normal = glm::normalize(turned(*then, *now, site.normal));
            }
          }
          tree_.valid(site.position, site.normal, found);
          bool covered = false;
          for (const IrradianceRecord* r : found) {
            part.in_sight.push_back(static_cast<std::size_t>(r - tree_.records().data()));
            covered = covered || record_error(*r, site.position, site.normal) < accuracy_;
          }
          if (!covered) part.open.now.push_back(site);
        }
        std::sort(part.in_sight.begin(), part.in_sight.end());
        part.in_sight.erase(std::unique(part.in_sight.begin(), part.in_sight.end()), part.in_sight.end());
        return part;
      },
      [](Seen& all, const Seen& part) {
        all.open.now.insert(all.open.now.end(), part.open.now.begin(), part.open.now.end());
        all.open.then.insert(all.open.then.end(), part.open.then.begin(), part.open.then.end());
        all.in_sight.insert(all.in_sight.end(), part.in_sight.begin(), part.in_sight.end());
        all.lost += part.lost;
      });
  for (std::vector<RecordSite>* sites : {&seen.open.now, &seen.open.then})
    for (RecordSite& site : *sites) site.item = next_item_++;
  for (const std::size_t i : seen.in_sight)
    if (i < in_sight_.size()) in_sight_[i] = true;
  lost_ += seen.lost;
  return seen.open;
}

}  // namespace phos::inline temporal
