// Where a film's records are placed.
#include <algorithm>
#include <functional>
#include <numeric>

#include "place/modes.h"
#include "temporal/events.h"
#include "temporal/film/maker.h"
#include "temporal/visible_places.h"

namespace phos::inline temporal {

/// Chains whose last key lies at `frame`, in order. After a jump, all those that were there before it may be
/// wanted: they get one.
std::vector<std::size_t> FilmMaker::there_at(std::int64_t frame) {
  std::vector<std::size_t> before, there;
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    const Key& last = chains_[i].keys.back();
    if (last.until == frame && last.frame != frame) before.push_back(i);
  }
  end_at(before, frame);
  for (std::size_t i = 0; i < chains_.size(); ++i)
    if (chains_[i].keys.back().frame == frame) there.push_back(i);
  return there;
}

/// Which chains the frames from `frame` on want, with new ones where the views `looks` lack them.
std::vector<std::size_t> FilmMaker::place_at(std::int64_t frame, std::span<const std::int64_t> looks) {
  FrameLight& light = lights_.at(frame);
  const std::vector<std::size_t> known = there_at(frame);
  IrradianceCache cache;
  cache.accuracy = task_.records.accuracy;
  for (const std::size_t i : known) cache.records.push_back(chains_[i].keys.back().record);

  std::vector<std::size_t> wanted;
  std::vector<Made> made;
  std::vector<Late> late;
  const std::size_t first_new = chains_.size();
  if (task_.placement.place == Place::view) {
    VisiblePlaces places(light, cache, task_.placement, task_.wanted, task_.unwanted,
                         kFilmItems + next_number_);
    std::int64_t looked = frame;
    for (const std::int64_t f : looks) {
      const VisiblePlaces::Open open = places.look(lights_.scene_at(f));
      const std::size_t before = cache.records.size();
      add_chains(light, task_.estimator(light), cache, open.now, made);
      for (std::size_t i = before; i < cache.records.size(); ++i) places.add(cache.records[i]);
      late.push_back(add_late(f, looked, open.then, frame));
      looked = f;
    }
    next_number_ = static_cast<std::uint32_t>(places.next_item() - kFilmItems);
    if (places.lost() > 0) counters_.count(kLostPlaceEvent, places.lost());
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (places.in_sight()[i])
        wanted.push_back(known[i]);
      else
        ++report_.deleted;
    }
    report_.kept_alive += wanted.size();
  } else {
    wanted = known;
    add_chains(light, task_.estimator(light), cache, {}, made);
    if (task_.placement.place == Place::photons) estimate_anew(first_new, light);
  }
  for (const Late& l : late) begin_appeared(l.chains, l.begin);
  for (std::size_t i = first_new; i < chains_.size(); ++i) wanted.push_back(i);
  return wanted;
}

/// New chains where the known records leave sites (or, of other placements than views, surfaces) uncovered;
/// `made` are the estimates of the new records. The new records are added to `known`.
void FilmMaker::add_chains(FrameLight& light, const Estimator& estimator, IrradianceCache& known,
                           std::span<const RecordSite> sites, std::vector<Made>& made) {
  made.clear();
  const std::size_t before = known.records.size();
  const bool view = task_.placement.place == Place::view;
  const Kept kept(estimator, task_, light.frame());
  PlacementReport placed;
  if (view) {
    if (sites.empty()) return;
    const Candidates candidates{
        sites.size(), [&](std::size_t i, std::vector<RecordSite>& out) { out.push_back(sites[i]); }};
    placed = place_records(known, *kept, light.rays(), task_.records, task_.placement, candidates, counters_);
  } else {
    PlacementSource source;
    source.wanted = task_.wanted;
    if (!source.wanted && task_.unwanted) source.wanted = std::not_fn(task_.unwanted);
    if (task_.placement.place == Place::photons) source.photons = &light.photons(counters_);
    placed = extend_cache(known, *kept, light.rays(), task_.records, task_.placement, source, counters_);
  }
  report_.estimates += placed.made, report_.making_s += placed.making_s,
      report_.uncovered += placed.uncovered;
  made = std::move(placed.made_records);
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!view) made[i].item = kFilmItems + next_number_++;
    const RadianceRecord* radiance = placed.radiance.empty() ? nullptr : &placed.radiance[i];
    chains_.push_back(
        chain_of(made[i], known.records[before + i], radiance, light.rays(), light.frame(), survey_));
  }
}

/// Chains on surfaces that have no area at the frame `begin`, where other chains start, and are seen at
/// `frame`. They are to begin where their surface first has one, after `looked`, the frame looked at before.
FilmMaker::Late FilmMaker::add_late(std::int64_t frame, std::int64_t looked,
                                    std::span<const RecordSite> sites, std::int64_t begin) {
  if (sites.empty()) return {};
  const std::size_t first_new = chains_.size();
  std::vector<Made> made;
  FrameLight& light = lights_.at(frame);
  IrradianceCache known;
  known.accuracy = task_.records.accuracy;
  for (const Chain& chain : chains_)
    if (chain.keys.back().frame >= begin) add_as_it_was(chain, light.scene(), known);
  add_chains(light, task_.estimator(light), known, sites, made);

  lights_.at(begin);  // stays in work
  std::vector<std::size_t> added(chains_.size() - first_new);
  std::iota(added.begin(), added.end(), first_new);
  return {std::move(added), looked + 1};
}

/// The first keys of chains from `first` on once more. A record placed at a photon leaves that out, and those
/// that follow it at the same place do not: they would differ where nothing changes.
void FilmMaker::estimate_anew(std::size_t first, FrameLight& light) {
  std::vector<std::size_t> chains(chains_.size() - first), there;
  std::iota(chains.begin(), chains.end(), first);
  std::vector<Made> made;
  std::vector<Key> keys = estimate(chains, light, task_.estimator(light), there, made);
  for (std::size_t i = 0; i < keys.size(); ++i) chains_[there[i]].keys.back() = std::move(keys[i]);
}

/// Places the records that the view of a frame within ]begin, end[ lacks. Of records that were placed at
/// `begin` the zones are smaller where something has come near since.
void FilmMaker::cover(std::vector<std::size_t>& wanted, std::int64_t begin, std::int64_t end,
                      std::int64_t look) {
  FrameLight& light = lights_.at(look);
  std::vector<Chain> chains;  // of this piece of the film alone
  for (const std::size_t i : wanted) {
    const Chain& c = chains_[i];
    const auto from =
        std::find_if(c.keys.begin(), c.keys.end(), [&](const Key& k) { return k.frame >= begin; });
    chains.push_back({c.number, c.anchor, c.share, c.least_radius_m, c.most_radius_m, {from, c.keys.end()}});
  }
  FilmInfo info;
  info.frames = {begin, end}, info.accuracy = task_.records.accuracy;
  info.gradients = TemporalGradients::interpolated;
  IrradianceCache known = cache_at(film_of(chains, info, task_.records.paths), look, light.scene());
  const std::vector<RecordSite> holes = holes_in_view(light.at(), known, task_.placement, task_.wanted,
                                                      task_.unwanted, kFilmItems + next_number_);
  next_number_ += static_cast<std::uint32_t>(holes.size());
  std::vector<Made> made;
  const std::size_t first_new = chains_.size();
  add_chains(light, task_.estimator(light), known, holes, made);
  std::vector<std::size_t> added(chains_.size() - first_new);
  std::iota(added.begin(), added.end(), first_new);
  begin_appeared(added, begin);
  end_vanished(added, begin, end);
  refine(added, begin);
  wanted.insert(wanted.end(), added.begin(), added.end());
}

}  // namespace phos::inline temporal
