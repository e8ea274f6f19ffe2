#include "temporal/survey.h"

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/progress.h"

namespace phos::inline temporal {

const FrameRange& FilmSurvey::shot_of(std::int64_t frame) const {
  for (const FrameRange& shot : shots)
    if (shot.contains(frame)) return shot;
  PHOS_CHECK(false, "frame ", frame, " is in no shot");
}

FilmSurvey survey(const std::string& path, const SceneOptions& options, const FrameRange& frames) {
  FilmSurvey film;
  film.frames = frames;
  Progress progress("frames", static_cast<std::uint64_t>(frames.count()), "frames");
  std::shared_ptr<const Scene> window[4];  // the last frames, the newest last
  std::int64_t begin = frames.first;       // of the shot
  // With the window's scenes at f - 2 .. f + 1: does something jump from f - 1 to f?
  const auto judge = [&](std::int64_t f) {
    if (!window[1] || !window[2]) return;
    const Scene& before = window[0] ? *window[0] : *window[1];
    const Scene& after = window[3] ? *window[3] : *window[2];
    if (!jumps(before, *window[1], *window[2], after)) return;
    film.shots.push_back({begin, f - 1});
    begin = f;
  };
  const auto push = [&](std::shared_ptr<const Scene> next) {
    std::rotate(window, window + 1, window + 4);
    window[3] = std::move(next);
  };
  for (std::int64_t f = frames.first; f <= frames.last; ++f) {
    throw_if_interrupted();
    auto scene = std::make_shared<const Scene>(load_frame(path, options, f));
    if (f == frames.first) {
      require_frames(*scene, frames);
      film.moved.assign(scene->instance.size(), false);
    } else {
      const Changes c = changes(*window[3], *scene);
      film.light_changes = film.light_changes || c.light();
      for (std::size_t i = 0; i < c.moved.size(); ++i) film.moved[i] = film.moved[i] || c.moved[i];
    }
    film.scene_hash.push_back(scene->hash);
    push(std::move(scene));
    judge(f - 1);
    progress.advance();
  }
  push(nullptr);
  judge(frames.last);
  film.shots.push_back({begin, frames.last});
  return film;
}

}  // namespace phos::inline temporal
