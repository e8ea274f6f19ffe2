// A glTF file taken apart: checked JSON, the bytes of its buffers, and tinygltf's typed view of the rest.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/json.h"
#include "core/vector.h"

namespace tinygltf {
class Model;
}

namespace phos::inline scene {

struct GltfDocument {
  std::string path;
  Json json;                        ///< every index, count and number in it is in range (check_gltf)
  std::vector<std::string> buffer;  ///< bytes of buffers[i], as long as its byteLength says
  std::shared_ptr<const tinygltf::Model>
      model;  ///< accessors, views, meshes, materials, nodes, cameras, skins
  /// Values that KHR_animation_pointer sets at the time of the scene, by JSON pointer.
  std::map<std::string, std::vector<float>> animated;

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ExitCode::bad_input, path, message);
  }
};

/// Does it start like a binary glTF? Like a JSON text?
bool looks_like_glb(std::string_view bytes);
bool looks_like_json(std::string_view bytes);

/// Takes a .glb or .gltf apart. Throws Error(bad_input): truncated, another version, an unknown required
/// extension (named), a buffer that is missing or too short, an index out of range.
GltfDocument read_gltf(const std::string& path, std::string_view bytes);

/// Files that the document's buffers and images name, whether they exist or not; with `spectra` the files
/// of extras.phos.spectrum too.
std::vector<std::string> gltf_external_files(const std::string& path, std::string_view bytes,
                                             bool spectra = false);
/// The file that extras.phos.spectrum of a material or light names; "" where it names none. Throws
/// std::runtime_error if it is no relative path to a file beside the scene or in a folder below it.
std::string spectrum_file(const std::string& path, const Json& of);

/// Member at "a/b/c" below `json`, nullptr where any step is missing.
const Json* find_path(const Json& json, std::string_view path);
/// The number there, or `absent`. Throws std::runtime_error for another type (check_gltf has made sure of the
/// core).
double number_at(const Json& json, std::string_view path, double absent);
std::string text_at(const Json& json, std::string_view path, const std::string& absent);
/// Three numbers, or one for all three.
std::optional<Rgb> rgb_at(const Json& json, std::string_view path);
/// Length of an array member; 0 where it is missing.
std::size_t count_at(const Json& json, std::string_view path);
/// Element i of the top-level array `key`; null where it is missing.
const Json& element(const Json& json, const std::string& key, std::size_t i);

}  // namespace phos::inline scene
