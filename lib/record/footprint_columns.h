// Footprints of records as columns of a file: footprint_axis f32[n,3], the direction of the first axis,
// footprint_length f32[n,8] m, and footprint_slope, footprint_bend, footprint_turn_slope and
// footprint_turn_bend f32[n,3,8] (colour, axis) in lx, lx/rad and lx/rad2. A file has all of them, or none.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "file/container.h"
#include "record/irradiance_cache.h"

namespace phos::inline record {

/// Holds the columns until the file is written.
class FootprintColumns {
 public:
  /// Either all records have one, or none has.
  explicit FootprintColumns(std::span<const IrradianceRecord> records);
  /// Adds nothing where there are none.
  void add_to(ContainerWriter& file) const;

 private:
  std::vector<Vec3> axis_;
  std::vector<float> length_, slope_, bend_, turn_slope_, turn_bend_;
};

/// One for each record, or empty where the file has none. Values are not checked (what_is_wrong). Throws
/// Error(bad_input) for columns that are missing or have another shape.
std::vector<std::shared_ptr<const AdaptiveFootprint>> read_footprints(const Container& file,
                                                                      std::span<const Vec3> normal);

}  // namespace phos::inline record
