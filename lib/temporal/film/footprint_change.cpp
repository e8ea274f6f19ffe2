#include "temporal/film/footprint_change.h"

#include <algorithm>

namespace phos::inline temporal {
namespace {

using Axis = AdaptiveFootprint::Axis;

float frames_of(const Life& life) { return static_cast<float>(std::int64_t{life.end} - life.birth); }

/// The length of an axis `age` frames after its birth.
float length_at(float born_m, float change_m, float age, const Life& life) {
  return std::max(born_m + age * change_m, born_m / frames_of(life));
}

/// An axis `age` frames after its birth.
Axis at(const Axis& born, const Axis& change, float age, const Life& life) {
  return {length_at(born.length_m, change.length_m, age, life), born.slope + age * change.slope,
          born.bend + age * change.bend, born.turn_slope + age * change.turn_slope,
          born.turn_bend + age * change.turn_bend};
}

/// The radius belongs to the longest axis, and goes straight from end to end as if the longest axis did: the
/// longest one now over that.
float beside_straight(float now_m, float born_m, float last_m, float age, const Life& life) {
  return now_m / (born_m + age / frames_of(life) * (last_m - born_m));
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
  r.radius_m *= beside_straight(r.footprint->longest_m(), born.longest_m(), last_m, age, film.life);
}

AdaptiveFootprint::Lengths footprint_change(const AdaptiveFootprint::Lengths& from,
                                            const AdaptiveFootprint::Lengths& to, float frames) {
  AdaptiveFootprint::Lengths change;
  for (std::size_t k = 0; k < change.size(); ++k) change[k] = (to[k] - from[k]) / frames;
  return change;
}

void change_footprint(const FilmRadianceRecord& film, float age, RadianceRecord& r) {
  const AdaptiveFootprint::Lengths &born = *film.record.footprint_m, &change = *film.change.footprint_m;
  AdaptiveFootprint::Lengths now;
  float now_m = 0, born_m = 0, last_m = 0;  // the longest
  for (std::size_t k = 0; k < now.size(); ++k) {
    now[k] = length_at(born[k], change[k], age, film.life);
    now_m = std::max(now_m, now[k]), born_m = std::max(born_m, born[k]);
    last_m = std::max(last_m, length_at(born[k], change[k], frames_of(film.life), film.life));
  }
  r.footprint_m = now;
  r.radius_m *= beside_straight(now_m, born_m, last_m, age, film.life);
}

}  // namespace phos::inline temporal
