// Footprints of records, and numbers of their axes, as columns of a file. A file has all of these columns or
// none.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "file/kinds/tensor_io.h"
#include "record/irradiance_cache.h"

namespace phos::inline record {

/// Numbers of axes; holds the columns until the file is written.
class AxisColumns {
 public:
  void append(const AdaptiveFootprint::Axes& axes);
  /// As footprint_length, footprint_slope and so on, each name with `ending`.
  void add_to(TensorWriter& file, const std::string& ending = "") const;

 private:
  std::vector<float> length_, slope_, bend_, turn_slope_, turn_bend_;
};
/// One row for each record, or empty where the file has none. Throws Error(bad_input) for columns that are
/// missing or have another shape.
std::vector<AdaptiveFootprint::Axes> read_axes(const TensorReader& file, const std::string& ending = "");

/// Holds the columns until the file is written.
class FootprintColumns {
 public:
  /// Either all records have one, or none has.
  explicit FootprintColumns(std::span<const IrradianceRecord> records);
  /// Adds nothing where there are none.
  void add_to(TensorWriter& file) const;

 private:
  std::vector<Vec3> first_;
  AxisColumns axes_;
};

/// One for each record, or empty where the file has none. Values are not checked (what_is_wrong). Throws
/// Error(bad_input) for columns that are missing or have another shape.
std::vector<std::shared_ptr<const AdaptiveFootprint>> read_footprints(const TensorReader& file,
                                                                      std::span<const Vec3> normal);

}  // namespace phos::inline record
