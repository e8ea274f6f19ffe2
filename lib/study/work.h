// The commands of a study, in the order in which they run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/spec/check.h"
#include "study/spec/settings.h"
#include "study/spec/stages.h"

namespace phos::inline study {

/// One setting with one seed: the commands that end in its picture and in its table of lux.
struct Job {
  std::size_t setting = 0, seed = 0;  ///< indices
  std::optional<std::size_t> picture, lux;
};

/// One or two files of a reference. `stages`: the commands that make them, none where they are given.
struct ReferenceWork {
  std::vector<std::string> files;
  std::vector<std::size_t> stages;
};

struct StudyWork {
  std::vector<Setting> settings;
  Stages stages;
  /// Seed by seed, in each round the other way through the settings: a machine that slows down favours none.
  std::vector<Job> jobs;
  std::vector<ReferenceWork> pictures;  ///< of scene x cameras + camera; empty without pictures
  std::vector<ReferenceWork> lux;       ///< of each scene; empty without sensors
  std::vector<SceneLoss> losses{};      ///< of the scenes

  const ReferenceWork& picture_of(const StudyFile& study, const Setting& s) const {
    return pictures[s.scene * study.cameras.size() + s.camera];
  }
  /// Files, commands and all that they read, each once.
  std::vector<std::size_t> order() const;
};

/// `folder`: where files go. Sizes of pictures are the study's, else the given reference's, else 400 wide.
/// Throws Error(mismatch) for a given reference of another size or another version of its scene, or without
/// the layer; Error(usage) for a scene without that camera; Error(bad_input) for a scene that cannot be read
/// or has no light.
StudyWork plan_work(const StudyFile& study, const CommandRunner& runner, const std::string& folder);

}  // namespace phos::inline study
