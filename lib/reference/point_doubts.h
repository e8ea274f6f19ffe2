// What the standard errors of measured points do not hold.
#pragma once

#include <vector>

#include "file/tool.h"
#include "reference/point_irradiance.h"
#include "scene/report/unsampled.h"

namespace phos::inline reference {

/// Goes with one run over points, and is told of each.
class PointDoubts {
 public:
  /// `ways` of the scene by which light can reach the points; none where only direct light is asked for.
  PointDoubts(std::vector<LightWay> ways, Sampler sampler) : ways_(std::move(ways)), sampler_(sampler) {}

  /// Has the run go on until all ways are sampled that --samples are enough for.
  void prepare(PointOptions& options) const;
  /// Takes the standard error of a point away (not a number) where a way was not sampled, by its own samples.
  void judge(PointIrradiance& point);
  /// Says so: see Tool::doubt(). Before the output is written.
  void tell(Tool& tool) const;

 private:
  std::vector<LightWay> ways_;
  Sampler sampler_;
  std::uint64_t points_ = 0, untrusted_ = 0, dark_ = 0;
  std::optional<std::uint64_t> least_samples_;
};

}  // namespace phos::inline reference
