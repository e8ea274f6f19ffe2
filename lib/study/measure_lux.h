// How far a table of lux is from a reference.
#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "study/measure.h"

namespace phos::inline study {

/// Lux at sensors, as phos-sense and phos-reference --points write them.
struct LuxTable {
  std::string where;             ///< its file, for messages
  std::vector<Vec3> position;    ///< m
  std::vector<float> lux;        ///< E_lx or illuminance_lx
  std::vector<float> stderr_lx;  ///< empty without the column stderr_lx, or where it has gaps
};
/// Throws Error(bad_input) for a file without those columns or without a row, or a cell that is no number.
LuxTable read_lux(const std::string& path);
/// The error of illuminance, as measure_picture() finds it for a layer. Throws Error(mismatch) where the
/// sensors are not the same ones in the same order.
MeasuredError measure_lux(const LuxTable& table, const LuxTable& reference, const LuxTable* second = nullptr);

}  // namespace phos::inline study
