// Frame after frame: records live as long as the change from their first frame to the next allows (Gautron
// 2006, algorithm 5; docs/methods.md#f4).
#include <algorithm>

#include "temporal/ahead.h"
#include "temporal/change.h"
#include "temporal/film/maker.h"
#include "temporal/visible_places.h"

namespace phos::inline temporal {

/// How long a key lives, by the light expected one frame on.
void FilmMaker::live(Key& key, const Chain& chain, const Made& made, const FrameScene* next,
                     std::int64_t most) const {
  std::int64_t life = std::min(options_.max_life, most);
  if (made.ahead && next) {
    key.ahead = made.ahead;
    if (const std::optional<Pose> then = pose_of(next->scene, chain.anchor)) key.ahead_pose = *then;
    const double floor = std::max(floor_, 1e-30);
    key.rate = key.radiance && made.ahead->radiance
                   ? change_rate(key.radiance->light, made.ahead->radiance->light, floor)
                   : change_rate(key.record.irradiance, made.ahead->record.irradiance, floor);
    life = std::min(life, life_of(key.rate, options_.temporal_accuracy, options_.max_life));
  }
  key.until = key.frame + life;
  key.jumps = life == most;
}

void FilmMaker::frame_by_rate(std::int64_t frame, const FrameRange& shot) {
  FrameLight& light = lights_.at(frame);
  const std::int64_t most = shot.last + 1 - frame;
  const FrameScene* next = nullptr;
  std::optional<AheadEstimator> ahead;
  if (frame < shot.last && options_.look_ahead != LookAhead::none) {
    FrameLight& coming = lights_.at(frame + 1);
    next = &coming.at();
    ahead.emplace(FrameEstimator{task_.estimator(light), light.rays(), light.lights()},
                  FrameEstimator{task_.estimator(coming), coming.rays(), coming.lights()},
                  changes(light.scene(), coming.scene()), task_.records, light.seed(),
                  AheadOptions{.look = options_.look_ahead,
                               .whole = options_.gradients == TemporalGradients::extrapolated});
  }
  const Estimator& estimator = ahead ? *ahead : task_.estimator(light);

  // What is there already: records alive, and those whose time is up.
  IrradianceCache known;
  known.accuracy = task_.records.accuracy;
  std::vector<std::size_t> chain_of_record, due;
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    if (chains_[i].keys.back().until < frame) continue;
    if (add_as_it_was(chains_[i], light.scene(), known)) chain_of_record.push_back(i);
  }
  std::vector<RecordSite> open;
  std::vector<bool> seen(known.records.size(), true);
  if (task_.placement.place == Place::view) {
    VisiblePlaces places(light, known, task_.placement, task_.wanted, task_.unwanted,
                         kFilmItems + next_number_);
    open = places.look(light.at()).now, seen = places.in_sight();
    next_number_ = static_cast<std::uint32_t>(places.next_item() - kFilmItems);
  }
  for (std::size_t i = 0; i < chain_of_record.size(); ++i) {
    if (chains_[chain_of_record[i]].keys.back().until > frame) continue;
    if (seen[i])
      due.push_back(chain_of_record[i]), ++report_.kept_alive;
    else
      ++report_.deleted;
  }
  std::vector<std::size_t> there;
  std::vector<Made> made;
  std::vector<Key> keys = estimate(due, light, estimator, there, made);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    live(keys[i], chains_[there[i]], made[i], next, most);
    chains_[there[i]].keys.push_back(std::move(keys[i]));
  }
  const std::size_t first_new = chains_.size();
  add_chains(light, estimator, known, open, made);
  if (floor_ == 0) set_floor();
  for (std::size_t i = first_new; i < chains_.size(); ++i)
    live(chains_[i].keys.back(), chains_[i], made[i - first_new], next, most);
}

}  // namespace phos::inline temporal
