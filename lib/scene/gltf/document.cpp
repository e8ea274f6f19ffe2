#include "scene/gltf/document.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/text/line.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "file/lfs_pointer.h"
#include "scene/gltf/check.h"
#include "scene/gltf/compression.h"
#include "scene/gltf/uri.h"
#include "scene/report/features.h"

namespace phos::inline scene {
namespace {

constexpr const char* kVersion1 = "glTF 1.0 is not supported; convert it to 2.0";

struct Chunks {
  std::string_view json, bin;
  bool has_bin = false;
};

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t v;
  std::memcpy(&v, bytes.data() + offset, sizeof v);
  return v;
}

/// GLB framing: 12 bytes of header, then chunks of (length, type, data).
Chunks split_glb(const std::string& path, std::string_view bytes) {
  const auto fail = [&](const std::string& message) { throw Error(ExitCode::bad_input, path, message); };
  if (bytes.size() < 12) fail("truncated: a GLB header has 12 bytes; copy or export the file again");
  const std::uint32_t version = word_at(bytes, 4);
  if (version == 1) fail(kVersion1);
  if (version != 2) fail(text("GLB version ", version, " is not supported; export glTF 2.0"));
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size()) {
    fail(
        text("truncated: ", bytes.size(), " of ", length, " bytes are there; copy or export the file again"));
  }
  Chunks chunks;
  std::size_t at = 12;
  for (int i = 0; at + 8 <= length; ++i) {
    const std::size_t size = word_at(bytes, at);
    const std::uint32_t type = word_at(bytes, at + 4);
    if (size > length - at - 8) fail(text("damaged: chunk ", i, " is longer than the file; export it again"));
    const std::string_view data = bytes.substr(at + 8, size);
    if (i == 0 && type != 0x4e4f534a) fail("damaged: the first chunk is not JSON; export it again");
    if (i == 0) chunks.json = data;
    if (i == 1 && type == 0x004e4942) chunks.bin = data, chunks.has_bin = true;
    at += 8 + (size + 3) / 4 * 4;
  }
  if (chunks.json.empty()) fail("truncated: there is no JSON chunk; copy or export the file again");
  return chunks;
}

Chunks split(const std::string& path, std::string_view bytes) {
  if (looks_like_glb(bytes)) return split_glb(path, bytes);
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  return {bytes, {}, false};
}

Json parse_document(const std::string& path, std::string_view json) {
  while (!json.empty() && json.back() == '\0') json.remove_suffix(1);
  Json document = parse_json(json, path);
  if (!document.is_object())
    throw Error(ExitCode::bad_input, path,
                "is not a glTF file: its JSON is not an object; export the scene again");
  return document;
}

void check_version(const Json& document, const std::string& path) {
  const auto fail = [&](const std::string& message) { throw Error(ExitCode::bad_input, path, message); };
  const Json* version = find_path(document, "asset/version");
  if (!version) {
    // glTF 1.0 could leave the version out, and had objects where 2.0 has arrays.
    const Json* nodes = document.find("nodes");
    if (nodes && nodes->is_object()) fail(kVersion1);
    fail("is not a glTF file: asset.version is missing; export the scene again");
  }
  const std::string v = version->is_string() ? version->as_string() : version->dump();
  if (v.rfind("1.", 0) == 0 || v == "1") fail(kVersion1);
  if (v.rfind("2.", 0) != 0) fail("glTF " + v + " is not supported; export glTF 2.0");
}

void check_extensions(const Json& document, const std::string& path) {
  const Json* required = document.find("extensionsRequired");
  if (!required) return;
  if (!required->is_array())
    throw Error(ExitCode::bad_input, path, "extensionsRequired must be an array; export the scene again");
  for (const Json& name : required->as_array()) {
    const std::string s = name.is_string() ? name.as_string() : name.dump();
    if (!can_be_required(s)) {
      throw Error(ExitCode::bad_input, path,
                  "the scene requires the extension " + s + ", which is not supported; export it without");
    }
  }
}

std::string buffer_bytes(const GltfDocument& document, std::size_t i, const Chunks& chunks) {
  const Json& buffer = element(document.json, "buffers", i);
  const std::string uri = text_at(buffer, "uri", "");
  const auto length = static_cast<std::uint64_t>(number_at(buffer, "byteLength", 0));
  std::string bytes;
  if (uri.empty()) {
    if (i != 0 || !chunks.has_bin) document.fail(text("buffers[", i, "] has no uri and no binary chunk"));
    bytes = chunks.bin;
  } else if (is_data_uri(uri)) {
    std::optional<std::string> decoded = decode_data_uri(uri);
    if (!decoded) document.fail(text("buffers[", i, "].uri is not valid base64"));
    bytes = std::move(*decoded);
  } else {
    const std::optional<std::string> file = uri_file(document.path, uri);
    if (!file) document.fail(text("buffers[", i, "].uri must be a relative path, not \"", uri, "\""));
    bytes = read_referred(*file);
    if (is_lfs_pointer(bytes)) document.fail(text("buffers[", i, "].uri, ", uri, ", is ", kLfsPointer));
  }
  if (bytes.size() < length) {
    document.fail(text("buffers[", i, "] is truncated: ", bytes.size(), " of ", length, " bytes are there"));
  }
  bytes.resize(length);
  return bytes;
}

/// What tinygltf need not see: it then touches no file and decodes nothing.
Json without_payload(const Json& json, int depth = 0) {
  if (json.is_array()) {
    Json::Array out;
    for (const Json& item : json.as_array()) out.push_back(without_payload(item, depth + 1));
    return out;
  }
  if (!json.is_object()) return json;
  Json::Object out;
  for (const auto& [key, value] : json.as_object()) {
    if (key == "extras" || key == "extensions") continue;
    if (depth == 0 && (key == "buffers" || key == "images" || key == "animations")) continue;
    out.emplace(key, without_payload(value, depth + 1));
  }
  return out;
}

std::shared_ptr<const tinygltf::Model> parse_structure(const GltfDocument& document) {
  auto model = std::make_shared<tinygltf::Model>();
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  const std::string json = without_payload(document.json).dump();
  if (!reader.LoadASCIIFromString(model.get(), &error, &warning, json.data(),
                                  static_cast<unsigned>(json.size()), "", tinygltf::NO_REQUIRE)) {
    document.fail(one_line(error.empty() ? "not a valid glTF 2.0 document" : error));
  }
  // Objects it skipped would shift every index after them.
  for (const auto& [key, n] :
       std::initializer_list<std::pair<const char*, std::size_t>>{{"accessors", model->accessors.size()},
                                                                  {"bufferViews", model->bufferViews.size()},
                                                                  {"meshes", model->meshes.size()},
                                                                  {"materials", model->materials.size()},
                                                                  {"nodes", model->nodes.size()},
                                                                  {"cameras", model->cameras.size()}}) {
    if (n != count_at(document.json, key)) document.fail(text("some of the ", key, " cannot be read"));
  }
  return model;
}

}  // namespace

bool looks_like_glb(std::string_view bytes) { return bytes.substr(0, 4) == "glTF"; }

bool looks_like_json(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{';
}

GltfDocument read_gltf(const std::string& path, std::string_view bytes) {
  const Chunks chunks = split(path, bytes);
  GltfDocument document;
  document.path = path;
  document.json = parse_document(path, chunks.json);
  check_version(document.json, path);
  check_extensions(document.json, path);
  check_gltf(document.json, path);
  require_uncompressed(document.json, path);
  for (std::size_t i = 0; i < count_at(document.json, "buffers"); ++i) {
    document.buffer.push_back(buffer_bytes(document, i, chunks));
  }
  document.model = parse_structure(document);
  return document;
}

std::string spectrum_file(const std::string& path, const Json& of) {
  const Json* phos = find_path(of, "extras/phos");
  const Json* name = phos && phos->is_object() ? phos->find("spectrum") : nullptr;
  if (!name) return "";
  const std::optional<std::string> file =
      name->is_string() ? file_below(path, name->as_string()) : std::optional<std::string>();
  if (!file)
    throw std::runtime_error(
        "extras.phos.spectrum must be a relative path to a file beside the scene or in a folder below it");
  return *file;
}

std::vector<std::string> gltf_external_files(const std::string& path, std::string_view bytes, bool spectra) {
  const Json document = parse_document(path, split(path, bytes).json);
  std::vector<std::string> files;
  for (const char* key : {"buffers", "images", "extensions/EXT_lights_ies/lights"}) {
    const Json* list = find_path(document, key);
    if (!list || !list->is_array()) continue;
    for (const Json& item : list->as_array()) {
      const Json* uri = item.find("uri");
      if (!uri || !uri->is_string() || is_data_uri(uri->as_string())) continue;
      if (std::optional<std::string> file = uri_file(path, uri->as_string())) files.push_back(*file);
    }
  }
  for (std::size_t i = 0; i < count_at(document, "materials"); ++i) {
    const Json* phos = find_path(element(document, "materials", i), "extras/phos");
    const Json* file = phos && phos->is_object() ? phos->find("file") : nullptr;
    if (!file || !file->is_string()) continue;
    if (std::optional<std::string> there = file_below(path, file->as_string())) files.push_back(*there);
  }
  for (const char* key :
       {"materials", "extensions/KHR_lights_punctual/lights", "extensions/EXT_lights_ies/lights"}) {
    const Json* list = find_path(document, key);
    if (!spectra || !list || !list->is_array()) continue;
    for (const Json& item : list->as_array())
      if (std::string file = spectrum_file(path, item); !file.empty()) files.push_back(std::move(file));
  }
  return files;
}

const Json* find_path(const Json& json, std::string_view path) {
  const Json* at = &json;
  while (at && !path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    at = at->find(std::string(path.substr(0, slash)));
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return at;
}

double number_at(const Json& json, std::string_view path, double absent) {
  const Json* v = find_path(json, path);
  return v ? v->as_number() : absent;
}

std::string text_at(const Json& json, std::string_view path, const std::string& absent) {
  const Json* v = find_path(json, path);
  return v ? v->as_string() : absent;
}

std::optional<Rgb> rgb_at(const Json& json, std::string_view path) {
  const Json* v = find_path(json, path);
  if (!v) return std::nullopt;
  if (v->is_number()) return Rgb(static_cast<float>(v->as_number()));
  if (v->as_array().size() != 3) throw std::runtime_error("not three numbers");
  const auto at = [&](std::size_t i) { return static_cast<float>(v->as_array()[i].as_number()); };
  return Rgb(at(0), at(1), at(2));
}

std::size_t count_at(const Json& json, std::string_view path) {
  const Json* v = find_path(json, path);
  return v && v->is_array() ? v->as_array().size() : 0;
}

const Json& element(const Json& json, const std::string& key, std::size_t i) {
  static const Json kNull;
  const Json* list = json.find(key);
  return list && list->is_array() && i < list->as_array().size() ? list->as_array()[i] : kNull;
}

}  // namespace phos::inline scene
