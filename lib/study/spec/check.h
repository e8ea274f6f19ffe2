// What a study asks for, against the scenes and references that are there.
#pragma once

#include <string>
#include <vector>

#include "study/spec/study_file.h"

namespace phos::inline study {

/// The files of a given reference (`which`: pictures or lux) of a scene and camera; empty: it is to be made.
const std::vector<std::string>& given(const StudyFile& study, const std::string& scene,
                                      const std::string& camera,
                                      std::vector<std::string> GivenReference::*which);

/// What a scene says and phos does not model: the line that each of its programs says, too.
struct SceneLoss {
  std::string scene, line;
  bool refused = false;  ///< by --strict
};

/// Before any work: the parts of the scenes that are left out. Throws Error(bad_input) for a scene that
/// cannot be read or has no light, or sensors that cannot be read; Error(usage) for a camera that is not
/// there; Error(mismatch) for a given reference of another size, layer, scene or sensors, or whose two files
/// are one.
std::vector<SceneLoss> check_against_scenes(const StudyFile& study);

}  // namespace phos::inline study
