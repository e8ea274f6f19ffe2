#include "temporal/film/maker.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/parallel.h"
#include "place/parallel_maker.h"
#include "temporal/events.h"

namespace phos::inline temporal {
namespace {

/// Frames of a piece, besides its first, whose view is looked at for places.
constexpr std::int64_t kLooks = 8;
constexpr std::int64_t kStillLooks = 100;  // of a film without change
/// A middle estimate that differs from the interpolated light by less than this share of the accuracy is not
/// kept: it would show noise.
constexpr double kWorthKeeping = 0.125;
/// docs/methods.md#f3: relative changes count against this share of the scene's mean irradiance at least.
constexpr double kFloorShare = 1e-3;

/// In double: the square of a faint light is below floats.
double norm2(const DVec3& v) { return glm::dot(v, v); }

double mean_irradiance(std::span<const Chain> chains) {
  double sum = 0;
  for (const Chain& c : chains) sum += std::sqrt(norm2(DVec3(c.keys.front().record.irradiance)));
  return chains.empty() ? 0 : sum / static_cast<double>(chains.size());
}

}  // namespace

FrameLight& FrameLights::at(std::int64_t frame) {
  const auto found =
      std::find_if(recent_.begin(), recent_.end(), [&](const auto& l) { return l->frame() == frame; });
  if (found != recent_.end()) {
    std::rotate(found, found + 1, recent_.end());
    return *recent_.back();
  }
  if (recent_.size() == kKept) recent_.erase(recent_.begin());
  recent_.push_back(std::make_unique<FrameLight>(scenes_.at(frame), options_, source_));
  frames_.insert(frame);
  return *recent_.back();
}

FilmMaker::FilmMaker(FrameLights& lights, const FilmSurvey& survey, const FilmOptions& options, FilmTask task,
                     Counters& counters)
    : lights_(lights), survey_(survey), options_(options), task_(std::move(task)), counters_(counters) {
  bounds_ = bounds_of(task_.records);
}

void FilmMaker::run() {
  Progress progress(task_.label, static_cast<std::uint64_t>(survey_.frames.count()), "frames");
  for (const FrameRange& shot : survey_.shots) {
    if (options_.lives == Lives::rate) {
      for (std::int64_t frame = shot.first; frame <= shot.last; ++frame, progress.advance()) {
        frame_by_rate(frame, shot);
      }
      continue;
    }
    for (std::int64_t begin = shot.first; begin <= shot.last;) {
      const std::int64_t end = std::min(begin + options_.max_life, shot.last);
      block(begin, end, shot, progress);
      begin = end == shot.last ? shot.last + 1 : end;
    }
  }
}

void FilmMaker::still() {
  std::vector<std::int64_t> looks;
  const std::int64_t step = std::max<std::int64_t>(1, survey_.frames.count() / kStillLooks);
  for (std::int64_t f = survey_.frames.first; f <= survey_.frames.last; f += step) looks.push_back(f);
  place_at(survey_.frames.first, looks);
}

/// Frames [begin, end] of a shot; the frame `end` belongs to the next piece too, unless it is the shot's
/// last.
void FilmMaker::block(std::int64_t begin, std::int64_t end, const FrameRange& shot, Progress& progress) {
  const auto frames = static_cast<std::uint64_t>(end - begin + (end == shot.last));
  std::vector<std::int64_t> looks;
  const std::int64_t step = std::max<std::int64_t>(1, (end - begin) / kLooks);
  for (std::int64_t f = begin; f < end; f += step) looks.push_back(f);
  if (end == shot.last && (looks.empty() || looks.back() != end)) looks.push_back(end);
  std::vector<std::size_t> wanted = place_at(begin, looks);
  std::uint64_t shown = frames / 3;
  progress.advance(shown);
  if (floor_ == 0) set_floor();
  if (begin < end) {
    end_vanished(wanted, begin, end);
    progress.advance(frames / 3), shown += frames / 3;
    refine(wanted, begin);
    if (task_.placement.place == Place::view)
      for (const std::int64_t look : looks)
        if (look > begin && look < end) cover(wanted, begin, end, look);
  }
  progress.advance(frames - shown);
  if (end == shot.last)
    for (const std::size_t i : wanted)
      if (Key& last = chains_[i].keys.back(); last.frame == end) last.until = end + 1;
}

/// Keys of chains at a frame, where their surfaces are there then: `there` are these chains, `made` the
/// estimates of their keys.
std::vector<Key> FilmMaker::estimate(std::span<const std::size_t> chains, FrameLight& light,
                                     const Estimator& estimator, std::vector<std::size_t>& there,
                                     std::vector<Made>& made) {
  there.clear(), made.clear();
  std::vector<RecordSite> sites;
  std::vector<Pose> poses;
  for (const std::size_t i : chains) {
    Pose pose;
    const std::optional<RecordSite> site = site_of(chains_[i], light.scene(), pose);
    if (!site) {
      counters_.count(kLostRecordEvent);
      continue;
    }
    sites.push_back(*site), poses.push_back(pose), there.push_back(i);
  }
  if (sites.empty()) return {};
  const Kept kept(estimator, task_, light.frame());
  ParallelMaker maker(*kept);
  made = maker.make(sites);
  report_.estimates += made.size(), report_.making_s += maker.seconds();
  maker.count_into(counters_);
  std::vector<Key> keys;
  for (std::size_t i = 0; i < made.size(); ++i)
    keys.push_back(key_of(chains_[there[i]], made[i], bounds_, light.frame(), sites[i], poses[i]));
  return keys;
}

std::vector<Key> FilmMaker::estimate_at(std::int64_t frame, std::span<const std::size_t> chains,
                                        std::vector<std::size_t>& there) {
  if (chains.empty()) return there.clear(), std::vector<Key>();
  std::vector<Made> made;
  FrameLight& light = lights_.at(frame);
  return estimate(chains, light, task_.estimator(light), there, made);
}

void FilmMaker::set_floor() { floor_ = kFloorShare * mean_irradiance(chains_); }

/// Halves the spans of chains from `begin` on where the light in the middle is not between the ends.
void FilmMaker::refine(std::span<const std::size_t> chains, std::int64_t begin) {
  if (options_.checks == 0) return;
  std::vector<Segment> segments;
  for (const std::size_t i : chains) {
    const std::vector<Key>& keys = chains_[i].keys;
    for (std::size_t k = 1; k < keys.size(); ++k)
      if (keys[k - 1].frame >= begin) segments.push_back({i, keys[k - 1].frame, keys[k].frame, 0});
  }
  while (!segments.empty()) {
    std::erase_if(segments, [](const Segment& s) { return s.end - s.begin < 2; });
    std::map<std::int64_t, std::vector<Segment>> by_middle;
    for (const Segment& s : segments) by_middle[(s.begin + s.end) / 2].push_back(s);
    segments.clear();
    for (const auto& [middle, at_middle] : by_middle) {
      std::vector<std::size_t> chains, there;
      for (const Segment& s : at_middle) chains.push_back(s.chain);
      std::vector<Key> keys = estimate_at(middle, chains, there);
      for (std::size_t i = 0, found = 0; i < at_middle.size(); ++i) {
        const Segment& s = at_middle[i];
        Chain& chain = chains_[s.chain];
        if (found == there.size() || there[found] != s.chain) continue;  // its surface has no area then
        Key& key = keys[found++];
        double share = 0;
        const bool straight = is_straight(*chain.at(s.begin), key, *chain.at(s.end), share);
        const bool halved = !straight || s.depth + 1 < options_.checks;
        if (halved) {
          segments.push_back({s.chain, s.begin, middle, s.depth + 1});
          segments.push_back({s.chain, middle, s.end, s.depth + 1});
        }
        if (!halved && share < kWorthKeeping) continue;
        const auto after = std::upper_bound(chain.keys.begin(), chain.keys.end(), middle,
                                            [](std::int64_t f, const Key& k) { return f < k.frame; });
        std::prev(after)->until = middle;
        key.until = after->frame;
        chain.keys.insert(after, std::move(key));
      }
    }
  }
}

/// Is the middle as interpolation has it? `share`: the missed light over the light that may be missed.
bool FilmMaker::is_straight(const Key& from, const Key& middle, const Key& to, double& share) const {
  const double t =
      static_cast<double>(middle.frame - from.frame) / static_cast<double>(to.frame - from.frame);
  double missed2 = 0, light2 = 0, noise2 = 0;
  if (middle.radiance) {
    const std::vector<float>&a = from.radiance->light, &m = middle.radiance->light, &b = to.radiance->light;
    for (std::size_t i = 0; i < m.size(); ++i) {
      const double straight = (1 - t) * static_cast<double>(a[i]) + t * static_cast<double>(b[i]);
      const double value = static_cast<double>(m[i]);
      missed2 += (value - straight) * (value - straight), light2 += value * value;
    }
    const std::vector<float>& error = middle.radiance->stderr_light;
    for (std::size_t i = 0; i < error.size(); ++i)
      noise2 += static_cast<double>(2 * (i / 3) + 1) * static_cast<double>(error[i]) *
                static_cast<double>(error[i]);
  } else {
    const DVec3 value(middle.record.irradiance);
    missed2 = norm2(value - glm::mix(DVec3(from.record.irradiance), DVec3(to.record.irradiance), t));
    light2 = norm2(value);
    noise2 = norm2(DVec3(middle.record.stderr_lx)) * (1 - static_cast<double>(middle.record.shared));
  }
  const double allowed = options_.temporal_accuracy * std::max(std::sqrt(light2), floor_);
  if (missed2 == 0) return share = 0, true;
  share = allowed > 0 ? std::sqrt(missed2) / allowed : kInfinity;
  // A difference that noise alone makes (of the three estimates: 3/2 of its variance; twice its deviation) is
  // no change. Their common noise, from the photons behind them, makes no difference; its share of each band
  // of radiance is not known. There noise, most of it in the highest bands, hides all but large changes:
  // FilmOptions::checks does what this cannot.
  return missed2 <= allowed * allowed + 6 * noise2;
}

FilmReport FilmMaker::report() const {
  FilmReport report = report_;
  report.frames_with_light = lights_.frames();
  return report;
}

}  // namespace phos::inline temporal
