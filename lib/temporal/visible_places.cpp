#include "temporal/visible_places.h"

#include <algorithm>

#include "core/parallel.h"
#include "scene/load.h"
#include "scene/picture.h"

namespace phos {
namespace {

constexpr std::size_t kTaskPixels = 1024;

struct Seen {
  std::vector<RecordSite> open;
  std::vector<std::size_t> in_sight;
  std::uint64_t sites = 0;
};

}  // namespace

VisiblePlaces::VisiblePlaces(const FrameLight& light, const IrradianceCache& known,
                             const PlacementOptions& placement, const MaterialFilter& wanted,
                             const MaterialFilter& unwanted, std::uint64_t first_item)
    : light_(light),
      known_(known),
      placement_(placement),
      wanted_(wanted),
      unwanted_(unwanted),
      next_item_(first_item),
      tree_(light.scene().bounds, reading_accuracy(known.accuracy)),
      in_sight_(known.records.size(), false) {
  for (const IrradianceRecord& r : known.records) tree_.insert(r);
}

void VisiblePlaces::look(const FrameScene& at) {
  const Changes since = changes(light_.scene(), at.scene);
  const bool still = !since.anything_moved();
  PlacementOptions size = placement_;
  const Camera& camera = find_camera(at.scene, placement_.camera);
  resolve_size(camera, kPictureSide, size.width, size.height);
  const View view{camera, size.width, size.height, placement_.min_radius_pixels,
                  placement_.max_radius_pixels};
  const Candidates candidates = view_candidates(at.rays, view, wanted_);
  // One sample of each pixel, another one at each look.
  const std::size_t pixels = candidates.count / kViewSamples, first = looks_++ % kViewSamples * pixels;
  const auto accuracy = static_cast<float>(known_.accuracy);
  Seen seen = parallel_reduce<Seen>(
      pixels, kTaskPixels, {},
      [&](std::size_t begin, std::size_t end) {
        Seen part;
        std::vector<RecordSite> sites;
        std::vector<const IrradianceRecord*> found;
        for (std::size_t i = begin; i < end; ++i) candidates.sites(first + i, sites);
        part.sites = sites.size();
        for (RecordSite& site : sites) {
          if (!still || unwanted_) {
            const Anchor anchor = anchor_at(at.rays, site.position, site.normal);
            if (anchor.triangle == kNoTriangle) continue;
            if (unwanted_ &&
                unwanted_(at.scene.instance[at.scene.triangle_instance[anchor.triangle]].material))
              continue;
            if (since.moved[at.scene.triangle_instance[anchor.triangle]]) {
              const std::optional<Pose> then = pose_of(at.scene, anchor),
                                        now = pose_of(light_.scene(), anchor);
              if (!then || !now) continue;
              site.position = now->position;
              site.normal = glm::normalize(turned(*then, *now, site.normal));
            }
          }
          tree_.valid(site.position, site.normal, found);
          bool covered = false;
          for (const IrradianceRecord* r : found) {
            part.in_sight.push_back(static_cast<std::size_t>(r - tree_.records().data()));
            covered = covered || record_error(*r, site.position, site.normal) < accuracy;
          }
          if (!covered) part.open.push_back(site);
        }
        std::sort(part.in_sight.begin(), part.in_sight.end());
        part.in_sight.erase(std::unique(part.in_sight.begin(), part.in_sight.end()), part.in_sight.end());
        return part;
      },
      [](Seen& all, const Seen& part) {
        all.open.insert(all.open.end(), part.open.begin(), part.open.end());
        all.in_sight.insert(all.in_sight.end(), part.in_sight.begin(), part.in_sight.end());
        all.sites += part.sites;
      });
  for (RecordSite& site : seen.open) site.item = next_item_++, open_.push_back(site);
  for (const std::size_t i : seen.in_sight) in_sight_[i] = true;
  sites_ += seen.sites;
}

}  // namespace phos
