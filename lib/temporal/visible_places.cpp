#include "temporal/visible_places.h"

#include <algorithm>

#include "core/parallel.h"
#include "scene/load.h"
#include "scene/picture.h"

namespace phos {
namespace {

constexpr std::size_t kTaskPixels = 1024;

struct Seen {
  VisiblePlaces::Open open;
  std::vector<std::size_t> in_sight;
  std::uint64_t lost = 0;
};

}  // namespace

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
  PlacementOptions size = placement_;
  const Camera& camera = find_camera(at.scene, placement_.camera);
  resolve_size(camera, kPictureSide, size.width, size.height);
  const View view{camera, size.width, size.height, placement_.min_radius_pixels.value(),
                  placement_.max_radius_pixels};
  const Candidates candidates = view_candidates(at.rays, view, wanted_);
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

}  // namespace phos
