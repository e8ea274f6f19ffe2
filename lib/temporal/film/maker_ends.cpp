// Where the lives of a film's places begin and end.
#include <algorithm>

#include "temporal/film/maker.h"

namespace phos::inline temporal {

/// Ends the spans that the last keys of these chains begin by keys at a frame (and begins no span there).
void FilmMaker::end_at(std::span<const std::size_t> chains, std::int64_t frame) {
  std::vector<std::size_t> there;
  std::vector<Key> keys = estimate_at(frame, chains, there);
  for (const std::size_t i : chains) {
    Key& last = chains_[i].keys.back();
    if (last.until == last.frame) last.until = frame;
  }
  for (std::size_t i = 0; i < there.size(); ++i) chains_[there[i]].keys.push_back(std::move(keys[i]));
}

/// Ends chains at the frame `end` of a piece; those whose surface has no area then, where it last had one.
void FilmMaker::end_vanished(std::span<const std::size_t> chains, std::int64_t begin, std::int64_t end) {
  std::vector<std::size_t> open;
  for (const std::size_t i : chains)
    if (chains_[i].keys.back().frame < end) open.push_back(i);
  for (std::int64_t f = end; f > begin && !open.empty(); --f) {
    const Scene& scene = lights_.scene_at(f).scene;
    std::vector<std::size_t> there;
    std::erase_if(open, [&](std::size_t i) {
      Pose pose;
      if (!site_of(chains_[i], scene, pose) || chains_[i].keys.back().frame >= f) return false;
      there.push_back(i);
      return true;
    });
    end_at(there, f);
  }
  for (const std::size_t i : open) chains_[i].keys.back().until = chains_[i].keys.back().frame + 1;
}

/// Begins chains by keys at a frame before their first.
void FilmMaker::begin_at(std::span<const std::size_t> chains, std::int64_t frame) {
  std::vector<std::size_t> there;
  std::vector<Key> keys = estimate_at(frame, chains, there);
  for (std::size_t i = 0; i < there.size(); ++i) {
    std::vector<Key>& all = chains_[there[i]].keys;
    keys[i].until = all.front().frame;
    all.insert(all.begin(), std::move(keys[i]));
  }
}

/// Begins chains at the first frame from `begin` to their first key at which their surface has an area.
void FilmMaker::begin_appeared(std::span<const std::size_t> chains, std::int64_t begin) {
  std::vector<std::size_t> open(chains.begin(), chains.end());
  for (std::int64_t f = begin; !open.empty(); ++f) {
    const Scene& scene = lights_.scene_at(f).scene;
    std::vector<std::size_t> there;
    std::erase_if(open, [&](std::size_t i) {
      if (chains_[i].keys.front().frame <= f) return true;
      Pose pose;
      if (!site_of(chains_[i], scene, pose)) return false;
      there.push_back(i);
      return true;
    });
    begin_at(there, f);
  }
}

}  // namespace phos::inline temporal
