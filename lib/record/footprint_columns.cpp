#include "record/footprint_columns.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"

namespace phos::inline record {
namespace {

constexpr std::uint64_t kAxes = AdaptiveFootprint::kAxes;

std::size_t place(std::size_t record, std::size_t colour, std::size_t axis) {
  return (3 * record + colour) * kAxes + axis;
}

}  // namespace

FootprintColumns::FootprintColumns(std::span<const IrradianceRecord> records) {
  if (!any_footprint(records)) return;
  const std::size_t n = records.size();
  axis_.resize(n), length_.resize(kAxes * n);
  for (std::vector<float>* v : {&slope_, &bend_, &turn_slope_, &turn_bend_}) v->resize(3 * kAxes * n);
  for (std::size_t i = 0; i < n; ++i) {
    PHOS_CHECK(records[i].footprint, "record ", i, " has no footprint, others have");
    const AdaptiveFootprint& f = *records[i].footprint;
    axis_[i] = f.x();
    for (std::size_t k = 0; k < kAxes; ++k) {
      const AdaptiveFootprint::Axis& a = f.axes()[k];
      length_[kAxes * i + k] = a.length_m;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = place(i, c, k);
        const auto channel = static_cast<int>(c);
        slope_[at] = a.slope[channel], bend_[at] = a.bend[channel];
        turn_slope_[at] = a.turn_slope[channel], turn_bend_[at] = a.turn_bend[channel];
      }
    }
  }
}

void FootprintColumns::add_to(ContainerWriter& file) const {
  if (axis_.empty()) return;
  const std::uint64_t n = axis_.size();
  file.add_vectors("footprint_axis", axis_, "1");
  file.add<float>("footprint_length", length_, {n, kAxes}, "m");
  file.add<float>("footprint_slope", slope_, {n, 3, kAxes}, "lx");
  file.add<float>("footprint_bend", bend_, {n, 3, kAxes}, "lx");
  file.add<float>("footprint_turn_slope", turn_slope_, {n, 3, kAxes}, "lx/rad");
  file.add<float>("footprint_turn_bend", turn_bend_, {n, 3, kAxes}, "lx/rad2");
}

std::vector<std::shared_ptr<const AdaptiveFootprint>> read_footprints(const Container& file,
                                                                      std::span<const Vec3> normal) {
  const std::uint64_t n = normal.size();
  if (!file.has("footprint_length")) return {};
  const std::span<const float> length = file.values<float>("footprint_length", {n, kAxes}),
                               slope = file.values<float>("footprint_slope", {n, 3, kAxes}),
                               bend = file.values<float>("footprint_bend", {n, 3, kAxes}),
                               turn_slope = file.values<float>("footprint_turn_slope", {n, 3, kAxes}),
                               turn_bend = file.values<float>("footprint_turn_bend", {n, 3, kAxes});
  const std::span<const float> x = file.values<float>("footprint_axis", {n, 3});
  std::vector<std::shared_ptr<const AdaptiveFootprint>> footprints(n);
  parallel_for(n, 1024, [&](std::size_t i) {
    AdaptiveFootprint::Axes axes;
    for (std::size_t k = 0; k < kAxes; ++k) {
      const auto rgb = [&](std::span<const float> column) {
        return Rgb(column[place(i, 0, k)], column[place(i, 1, k)], column[place(i, 2, k)]);
      };
      axes[k] = {length[kAxes * i + k], rgb(slope), rgb(bend), rgb(turn_slope), rgb(turn_bend)};
    }
    footprints[i] =
        std::make_shared<AdaptiveFootprint>(Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]), normal[i], axes);
  });
  return footprints;
}

}  // namespace phos::inline record
