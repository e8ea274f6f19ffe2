// What a film shows, before any light is computed.
#pragma once

#include <string>
#include <vector>

#include "scene/motion/film.h"

namespace phos::inline temporal {

struct FilmSurvey {
  FrameRange frames;
  std::vector<std::string> scene_hash;  ///< of each frame
  /// Runs of frames without a jump in between (scene/motion/film.h), in order: all frames together.
  std::vector<FrameRange> shots;
  std::vector<bool> moved;     ///< by instance: at any of the frames
  bool light_changes = false;  ///< from any frame to another

  const FrameRange& shot_of(std::int64_t frame) const;
  const std::string& hash_of(std::int64_t frame) const {
    return scene_hash[static_cast<std::size_t>(frame - frames.first)];
  }
};
/// Loads every frame once. Throws as load_frame(), and Error(usage) for frames that are not there.
FilmSurvey survey(const std::string& scene, const SceneOptions& options, const FrameRange& frames);

}  // namespace phos::inline temporal
