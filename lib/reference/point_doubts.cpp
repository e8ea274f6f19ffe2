#include "reference/point_doubts.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace phos::inline reference {

void PointDoubts::prepare(PointOptions& options) const {
  options.least_samples = samples_wanted(ways_, sampler_, options.samples);
}

void PointDoubts::judge(PointIrradiance& point) {
  ++points_;
  least_samples_ = std::min(least_samples_.value_or(point.samples), point.samples);
  if (!point.trusted) ++untrusted_, dark_ += point.illuminance_lx == 0;
  if (unsampled(ways_, sampler_, static_cast<double>(point.samples)).empty()) return;
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  point.illuminance_stderr_lx = std::numeric_limits<double>::quiet_NaN();
  point.stderr_lx = Rgb(kNone);
}

void PointDoubts::tell(Tool& tool) const {
  if (points_ == 0) return;
  const auto samples = static_cast<double>(*least_samples_);
  tell_unsampled(tool, unsampled(ways_, sampler_, samples), sampler_, samples);
  if (untrusted_ == 0) return;
  tool.stat("untrusted", untrusted_);
  tool.doubt(text(untrusted_, " of ", points_, " sensors have too few bright paths for a stated error",
                  dark_ > 0 ? text(" (", dark_, " of them found no light)") : "", "; raise --samples"));
}

}  // namespace phos::inline reference
