#include "temporal/film/footprint_change.h"

#include <algorithm>

namespace phos::inline temporal {
namespace {

using Axis = AdaptiveFootprint::Axis;

float frames_of(const Life& life) { return static_cast<float>(std::int64_t{life.end} - life.birth); }

/// An axis `age` frames after its birth.
Axis at(const Axis& born, const Axis& change, float age, const Life& life) {
  return {std::max(born.length_m + age * change.length_m, born.length_m / frames_of(life)),
          born.slope + age * change.slope, born.bend + age * change.bend,
          born.turn_slope + age * change.turn_slope, born.turn_bend + age * change.turn_bend};
}

}  // namespace

std::shared_ptr<const AdaptiveFootprint::Axes> footprint_change(const AdaptiveFootprint::Axes& from,
                                                                const AdaptiveFootprint::Axes& to,
                                                                float frames, Reach reach) {
  AdaptiveFootprint::Axes change;
  for (std::size_t k = 0; k < change.size(); ++k) {
    const Axis& a = from[k];
    const Axis b = reach == Reach::stays ? with_length(to[k], a.length_m) : to[k];
    change[k] = {(b.length_m - a.length_m) / frames, (b.slope - a.slope) / frames, (b.bend - a.bend) / frames,
                 (b.turn_slope - a.turn_slope) / frames, (b.turn_bend - a.turn_bend) / frames};
  }
  return std::make_shared<const AdaptiveFootprint::Axes>(change);
}

void change_footprint(const FilmRecord& film, float age, IrradianceRecord& r) {
  const AdaptiveFootprint& born = *film.record.footprint;
  const AdaptiveFootprint::Axes& change = *film.change.footprint;
  AdaptiveFootprint::Axes axes;
  float last_m = 0;  // the longest at the end of the life
  for (std::size_t k = 0; k < axes.size(); ++k) {
    axes[k] = at(born.axes()[k], change[k], age, film.life);
    last_m = std::max(last_m, at(born.axes()[k], change[k], frames_of(film.life), film.life).length_m);
  }
  r.footprint = std::make_shared<AdaptiveFootprint>(born.x(), film.record.normal, axes);
  // The radius belongs to the longest axis, and goes straight from end to end as if the longest axis did.
  const float straight_m = born.longest_m() + age / frames_of(film.life) * (last_m - born.longest_m());
  r.radius_m *= r.footprint->longest_m() / straight_m;
}

}  // namespace phos::inline temporal
