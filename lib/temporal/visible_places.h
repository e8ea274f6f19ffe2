// What a camera sees during some frames, as places of one of them.
#pragma once

#include <vector>

#include "cache/placement.h"
#include "temporal/frame_light.h"

namespace phos {

/// Looks at views of one or several frames, and takes what is seen back to where its surface is at the frame
/// of `light`.
class VisiblePlaces {
 public:
  /// `known`: records there; sites that none of them covers are open, and those that pictures read (see
  /// reading_accuracy) are in sight. Open sites are numbered from `first_item`. `wanted` empty: diffuse
  /// surfaces; but not `unwanted` ones. Holds references.
  VisiblePlaces(const FrameLight& light, const IrradianceCache& known, const PlacementOptions& placement,
                const MaterialFilter& wanted, const MaterialFilter& unwanted, std::uint64_t first_item);
  void look(const FrameScene& at);

  const std::vector<RecordSite>& open() const { return open_; }
  const std::vector<bool>& in_sight() const { return in_sight_; }  ///< by record
  std::uint64_t sites() const { return sites_; }

 private:
  const FrameLight& light_;
  const IrradianceCache& known_;
  const PlacementOptions& placement_;
  const MaterialFilter &wanted_, &unwanted_;
  std::uint64_t next_item_;
  RecordTree tree_;
  std::vector<RecordSite> open_;
  std::vector<bool> in_sight_;
  std::uint64_t sites_ = 0;
  std::size_t looks_ = 0;
};

}  // namespace phos
