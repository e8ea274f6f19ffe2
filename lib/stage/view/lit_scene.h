// A scene by the light of some of its lamps, and the caches of this light.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "record/irradiance_cache.h"
#include "scene/lamp/luminaires.h"
#include "scene/load.h"
#include "scene/rays.h"
#include "sense/sensors.h"
#include "splat/picture/gloss.h"
#include "stage/view/cache_sets.h"

namespace phos::stage {

struct LitScene {
  explicit LitScene(Scene lit) : scene(std::move(lit)), rays(scene), lights(scene) {}
  const Scene scene;
  const RayScene rays;
  const Luminaires lights;
};

/// The scene of a command, and the same with other lamps. Each takes the memory of a scene, and is loaded
/// once.
class LitScenes {
 public:
  LitScenes(std::string path, SceneOptions options);
  /// With the lamps of the options.
  const LitScene& own() { return with(options_.lamps); }
  const LitScene& with(const std::string& lamps);

 private:
  std::string path_;
  SceneOptions options_;
  std::map<std::string, std::unique_ptr<const LitScene>> of_lamps_;
};

/// A group of caches, read.
struct LitGroup {
  std::string name;
  std::vector<std::uint32_t> lamps;  ///< of the scene that the page draws (Scene::light)
  const LitScene* lit = nullptr;
  std::vector<Container> files;
  IrradianceCache records;
  SensorCaches caches;
  PictureGloss gloss;
  double gloss_accuracy = 0;  ///< of reading radiance records

  /// The radiance records; null: there are none.
  const GlossCache* radiance() const { return gloss.cache ? &*gloss.cache : nullptr; }
};

/// Throws as open_caches(), require_together() and read_caches(), and Error(usage) for records that the page
/// does not draw (adaptive ones) and for no record. The files must hold the light of `group.lamps`.
LitGroup lit_group(const CacheGroup& group, LitScenes& scenes, const std::string& scene_path,
                   bool allow_mismatch, Counters& counters);

}  // namespace phos::stage
