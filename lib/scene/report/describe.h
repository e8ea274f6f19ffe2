// A scene in figures: its contents, its brightness, and the requirements of computing its light.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "scene/material/models.h"
#include "scene/report/lint.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// A material and its effect on light. Textures and vertex colours count by their mean
/// (over the area that has the material).
struct MaterialSummary : ReflectionSummary {
  const Material* material = nullptr;
  std::uint64_t triangles = 0;
  double area_m2 = 0;  ///< of all its triangles, one side
};
std::vector<MaterialSummary> summarize_materials(const Scene& scene);
const char* model_name(Model model);

/// The stages that the light of this scene needs, and why; other stages need not run. "gloss" is had by
/// radiance records or rays: which of them suits each lobe is for others to say (radiance/gloss_report.h).
struct Requirement {
  std::string what;  ///< "irradiance records"
  std::string why;
};
std::vector<Requirement> scene_requirements(const Scene& scene);
/// What light asks for that reaches surfaces by mirrors, curved glass or sharp gloss alone, so that rays of
/// records seldom find it (unsampled.h).
inline constexpr const char* kCausticPhotons = "caustic photons";

/// Everything phos-scene tells, with the findings of the lint.
Json describe_scene(const Scene& scene, const std::vector<Finding>& findings);

}  // namespace phos::inline scene
