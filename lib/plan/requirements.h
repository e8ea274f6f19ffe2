// The parts of a pipeline that the light of a scene requires, and the parts that it does not, each with a
// reason.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/json.h"
#include "radiance/gloss_report.h"
#include "scene/report/describe.h"
#include "scene/report/light_ways.h"

namespace phos::inline plan {

struct Needs {
  bool lit = false;            ///< there is a lamp
  bool gloss = false;          ///< something glossy, a mirror or glass: rays of the picture follow it
  bool specular = false;       ///< mirrors or smooth glass among them
  std::string held_gloss;      ///< the gloss that harmonics hold, in words; "": none, and `unwanted` says why
  std::vector<LightWay> ways;  ///< of lamps to surfaces, by mirrors, curved glass or sharp gloss
  bool animated = false;
  std::int64_t frames = 0;
  std::vector<Requirement> wanted;    ///< the parts that the plan makes, and why
  std::vector<Requirement> unwanted;  ///< the parts that it leaves out, and why
};

/// `gloss`: gloss_report() of the scene; `film`: of many frames of an animated scene. Whether radiance
/// records show the gloss that harmonics hold is left to plan_gloss().
Needs plan_needs(const Scene& scene, const Json& gloss, bool film);

Json to_json(const Needs& needs);

}  // namespace phos::inline plan
