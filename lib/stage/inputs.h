// The files that a command names: told apart by their contents, in any order, and checked to belong together.
#pragma once

#include <string>
#include <vector>

#include "file/container.h"
#include "file/tool.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace phos::stage {

/// The scene, and phos files in the order given.
struct InputFiles {
  std::string scene;
  std::vector<std::string> phos;
};
/// What a program reads besides the scene. An error of a second scene says it.
enum class Beside { caches, files };
/// Throws Error(usage) for no scene or two of them, Error(bad_input) for a missing or an empty file.
InputFiles sort_inputs(const std::vector<std::string>& paths, Beside beside);
/// For programs whose help names the scene first. Another file is the scene where it alone is no phos file;
/// all other orders are left as they are, to be refused where the files are read.
InputFiles scene_and_others(const std::string& scene, const std::vector<std::string>& others);

/// What records are made from, at most one file of a kind; all but the scene may be absent ("").
struct RecordFiles {
  std::string scene, photons, source, radiance, brdf;
};
/// Throws as sort_inputs(), and Error(usage) for two of a kind, or another kind.
RecordFiles sort_record_inputs(const std::vector<std::string>& paths);
/// Enters them in the tool's provenance, each under its role.
void add_inputs(Tool& tool, const RecordFiles& files, const SceneOptions& scene_options);

enum class CacheKinds {
  records,            ///< irradiance and radiance
  records_and_lobes,  ///< and .brdf, at least one other file
};
/// Throws Error(bad_input) for a file of another kind.
std::vector<Container> open_caches(const std::vector<std::string>& paths, CacheKinds kinds);

/// Throws Error(mismatch) for a file of another scene, or a film without the scene's frame, unless
/// `allow_mismatch`.
void require_together(const Container& file, const std::string& scene_path, const Scene& scene,
                      bool allow_mismatch);
void require_together(const std::vector<Container>& files, const std::string& scene_path, const Scene& scene,
                      bool allow_mismatch);

/// A file to add to. Throws Error(usage) for a film, Error(mismatch) if it was made from another scene, or
/// from other photons than those given, unless `allow_mismatch`.
Container open_to_add(const std::string& path, FileKind kind, const RecordFiles& files, const Scene& scene,
                      bool allow_mismatch);

}  // namespace phos::stage
