// What a camera sees during some frames, as places of one of them.
#pragma once

#include <vector>

#include "place/placement_options.h"
#include "record/tree.h"
#include "temporal/frame_light.h"

namespace phos::inline temporal {

/// Looks at views of one or several frames, and takes the visible places back to where their surfaces are at
/// the frame of `light`.
class VisiblePlaces {
 public:
  /// `known`: records there; those that pictures read (see reading_accuracy) are in sight. Open sites are
  /// numbered from `first_item`. `wanted` empty: diffuse surfaces; but not `unwanted` ones. Holds references.
  VisiblePlaces(const FrameLight& light, const IrradianceCache& known, const PlacementOptions& placement,
                const MaterialFilter& wanted, const MaterialFilter& unwanted, std::uint64_t first_item);

  /// Sites that no record covers.
  struct Open {
    std::vector<RecordSite> now;  ///< where they are at the frame of `light`
    std::vector<RecordSite>
        then;  ///< where they are at the frame looked at: their surface has no area before
  };
  Open look(const FrameScene& at);
  /// Records that were added to the known ones since.
  void add(const IrradianceRecord& record) { tree_.insert(record); }

  const std::vector<bool>& in_sight() const { return in_sight_; }  ///< by record known at first
  std::uint64_t lost() const { return lost_; }            ///< sites whose surface was not found again
  std::uint64_t next_item() const { return next_item_; }  ///< sites have had those before it

 private:
  const FrameLight& light_;
  const PlacementOptions& placement_;
  const MaterialFilter &wanted_, &unwanted_;
  std::uint64_t next_item_;
  float accuracy_;
  RecordTree tree_;
  std::vector<bool> in_sight_;
  std::size_t looks_ = 0;
  std::uint64_t lost_ = 0;
};

/// Sites that a frame's view shows and no known record covers, numbered from `first_item`: one of each
/// pixel's, and where there is one the others of the pixels about it. `known`: records at that frame; filters
/// as of VisiblePlaces.
std::vector<RecordSite> holes_in_view(const FrameScene& at, const IrradianceCache& known,
                                      const PlacementOptions& placement, const MaterialFilter& wanted,
                                      const MaterialFilter& unwanted, std::uint64_t first_item);

}  // namespace phos::inline temporal
