#include "record/footprint_columns.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"

namespace phos::inline record {
namespace {

constexpr std::size_t kAxes = AdaptiveFootprint::kAxes;

/// Adds the colours of one number of each axis: colour after colour, each with all axes.
void append_colours(const AdaptiveFootprint::Axes& axes, Rgb AdaptiveFootprint::Axis::*number,
                    std::vector<float>& to) {
  for (int c = 0; c < 3; ++c)
    for (const AdaptiveFootprint::Axis& axis : axes) to.push_back((axis.*number)[c]);
}

}  // namespace

void AxisColumns::append(const AdaptiveFootprint::Axes& axes) {
  using Axis = AdaptiveFootprint::Axis;
  for (const Axis& axis : axes) length_.push_back(axis.length_m);
  append_colours(axes, &Axis::slope, slope_), append_colours(axes, &Axis::bend, bend_);
  append_colours(axes, &Axis::turn_slope, turn_slope_), append_colours(axes, &Axis::turn_bend, turn_bend_);
}

void AxisColumns::add_to(TensorWriter& file, const std::string& ending) const {
  file.add<float>("footprint_length" + ending, length_);
  file.add<float>("footprint_slope" + ending, slope_);
  file.add<float>("footprint_bend" + ending, bend_);
  file.add<float>("footprint_turn_slope" + ending, turn_slope_);
  file.add<float>("footprint_turn_bend" + ending, turn_bend_);
}

std::vector<AdaptiveFootprint::Axes> read_axes(const TensorReader& file, const std::string& ending) {
  if (!file.has("footprint_length" + ending)) return {};
  const auto column = [&](const char* name) { return file.values<float>(name + ending); };
  const std::span<const float> length = column("footprint_length"), slope = column("footprint_slope"),
                               bend = column("footprint_bend"), turn_slope = column("footprint_turn_slope"),
                               turn_bend = column("footprint_turn_bend");
  std::vector<AdaptiveFootprint::Axes> all(length.size() / kAxes);
  parallel_for(all.size(), 1024, [&](std::size_t i) {
    for (std::size_t k = 0; k < kAxes; ++k) {
      const std::size_t red = 3 * kAxes * i + k;
      const auto rgb = [&](std::span<const float> of) {
        return Rgb(of[red], of[red + kAxes], of[red + 2 * kAxes]);
      };
      all[i][k] = {length[kAxes * i + k], rgb(slope), rgb(bend), rgb(turn_slope), rgb(turn_bend)};
    }
  });
  return all;
}

FootprintColumns::FootprintColumns(std::span<const IrradianceRecord> records) {
  if (!any_footprint(records)) return;
  for (std::size_t i = 0; i < records.size(); ++i) {
    PHOS_CHECK(records[i].footprint, "record ", i, " has no footprint, others have");
    first_.push_back(records[i].footprint->x());
    axes_.append(records[i].footprint->axes());
  }
}

void FootprintColumns::add_to(TensorWriter& file) const {
  if (first_.empty()) return;
  file.add_vectors("footprint_axis", first_);
  axes_.add_to(file);
}

std::vector<std::shared_ptr<const AdaptiveFootprint>> read_footprints(const TensorReader& file,
                                                                      std::span<const Vec3> normal) {
  const std::vector<AdaptiveFootprint::Axes> axes = read_axes(file);
  if (axes.empty()) return {};
  const std::span<const Vec3> first = file.vectors("footprint_axis");
  std::vector<std::shared_ptr<const AdaptiveFootprint>> footprints(normal.size());
  parallel_for(footprints.size(), 1024, [&](std::size_t i) {
    footprints[i] = std::make_shared<AdaptiveFootprint>(first[i], normal[i], axes[i]);
  });
  return footprints;
}

}  // namespace phos::inline record
