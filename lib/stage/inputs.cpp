#include "stage/inputs.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "file/hash.h"
#include "file/mapped_file.h"
#include "temporal/film/file.h"
#include "temporal/film/inputs.h"

namespace phos::stage {
namespace {

void take(std::string& slot, const std::string& path, const char* what) {
  if (!slot.empty())
    throw Error(ExitCode::usage, path, text("is a second ", what, " beside ", slot, "; give one"));
  slot = path;
}

void take_scene(std::string& scene, const std::string& path, Beside beside) {
  if (!scene.empty() && beside == Beside::caches)
    throw Error(ExitCode::usage, path,
                text("is not a phos file, and ", scene, " is the scene already; give one scene, and caches"));
  take(scene, path, "scene");
}

InputFiles tell_apart(const std::vector<std::string>& paths, Beside beside) {
  InputFiles files;
  for (const std::string& path : paths) {
    require_bytes(path);
    if (is_container(path)) {
      files.phos.push_back(path);
      continue;
    }
    hash_file(path);  // a file that cannot be read is reported before its scene
    take_scene(files.scene, path, beside);
  }
  return files;
}

void require_scene(const std::string& scene) {
  if (scene.empty())
    throw Error(ExitCode::usage, "", "no scene among the inputs; give the .glb, .gltf or .obj too");
}

bool is_brdf(const Container& file) { return file.kind() == FileKind::brdf; }

}  // namespace

InputFiles sort_inputs(const std::vector<std::string>& paths, Beside beside) {
  InputFiles files = tell_apart(paths, beside);
  require_scene(files.scene);
  return files;
}

InputFiles scene_and_others(const std::string& scene, const std::vector<std::string>& others) {
  InputFiles files{scene, others};
  if (!is_container(scene) || std::count_if(others.begin(), others.end(), is_container) + 1 !=
                                  static_cast<std::ptrdiff_t>(others.size()))
    return files;
  const auto found = std::find_if_not(files.phos.begin(), files.phos.end(), is_container);
  files.scene = *found;
  files.phos.erase(found);
  files.phos.insert(files.phos.begin(), scene);
  return files;
}

RecordFiles sort_record_inputs(const std::vector<std::string>& paths) {
  const InputFiles sorted = tell_apart(paths, Beside::files);
  RecordFiles files;
  files.scene = sorted.scene;
  const std::map<FileKind, std::pair<std::string*, const char*>> kinds{
      {FileKind::photons, {&files.photons, "photon map"}},
      {FileKind::irradiance, {&files.source, "irradiance cache"}},
      {FileKind::radiance, {&files.radiance, "radiance cache"}},
      {FileKind::brdf, {&files.brdf, "file of lobes"}}};
  for (const std::string& path : sorted.phos) {
    const FileKind kind = Container::open(path).kind();
    const auto found = kinds.find(kind);
    if (found == kinds.end())
      throw Error(ExitCode::usage, path,
                  text("holds ", name_of(kind),
                       "; give a scene, photons, its .brdf file, or a cache for rays to read"));
    take(*found->second.first, path, found->second.second);
  }
  require_scene(files.scene);
  return files;
}

void add_inputs(Tool& tool, const RecordFiles& files, const SceneOptions& scene_options) {
  tool.add_input("scene", scene_files(files.scene, scene_options));
  if (!files.photons.empty()) tool.add_input("photons", files.photons);
  if (!files.source.empty()) tool.add_input("source", files.source);
  if (!files.radiance.empty()) tool.add_input("gloss", files.radiance);
  if (!files.brdf.empty()) tool.add_input("brdf", files.brdf);
}

std::vector<Container> open_caches(const std::vector<std::string>& paths, CacheKinds kinds) {
  std::vector<Container> files;
  for (const std::string& path : paths) {
    files.push_back(Container::open(path));
    const bool lobes = kinds == CacheKinds::records_and_lobes && is_brdf(files.back());
    if (!lobes && files.back().kind() != FileKind::radiance)
      files.back() = Container::open(path, FileKind::irradiance);
  }
  if (kinds == CacheKinds::records_and_lobes && std::all_of(files.begin(), files.end(), is_brdf))
    throw Error(ExitCode::bad_input, paths.empty() ? "CACHE" : paths.front(),
                "is not an irradiance cache, which is needed; give the output of phos-irradiance too");
  return files;
}

void require_together(const Container& file, const std::string& scene_path, const Scene& scene,
                      bool allow_mismatch) {
  if (!allow_mismatch) require_same_scene(file, scene_path, scene);
}

void require_together(const std::vector<Container>& files, const std::string& scene_path, const Scene& scene,
                      bool allow_mismatch) {
  for (const Container& file : files) require_together(file, scene_path, scene, allow_mismatch);
}

Container open_to_add(const std::string& path, FileKind kind, const RecordFiles& files, const Scene& scene,
                      bool allow_mismatch) {
  Container file = Container::open(path, kind);
  if (is_film(file))
    throw Error(ExitCode::usage, path,
                "is a film, and records are added to a cache of one scene; give one as --add-to, or both "
                "files to phos-splat");
  require_together(file, files.scene, scene, allow_mismatch);
  const auto& inputs = file.provenance().inputs;
  const auto photons = inputs.find("photons");
  if (!allow_mismatch && photons != inputs.end() && !files.photons.empty() &&
      photons->second != hash_file(files.photons).hex())
    throw Error(ExitCode::mismatch, path,
                "was made from other photons; give those, or pass --allow-mismatch to mix the two");
  return file;
}

}  // namespace phos::stage
