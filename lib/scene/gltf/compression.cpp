#include "scene/gltf/compression.h"

#include "core/error.h"
#include "scene/gltf/document.h"

namespace phos::inline scene {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kMeshopt[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& extension) {
  throw Error(ExitCode::bad_input, path,
              text(what, " is compressed with the extension ", extension,
                   ", which is not supported; export it without"));
}

bool has_data(const Json& document, const Json* accessor) {
  if (!accessor || !accessor->is_number()) return true;
  const Json& a = element(document, "accessors", static_cast<std::size_t>(accessor->as_number()));
  return a.find("bufferView") || a.find("sparse");
}

/// An optional Draco leaves the accessors of a primitive empty, or has a second copy of the data in them.
bool has_data_of(const Json& document, const Json& primitive) {
  if (!has_data(document, primitive.find("indices"))) return false;
  const Json* attributes = primitive.find("attributes");
  if (!attributes || !attributes->is_object()) return true;
  for (const auto& [name, accessor] : attributes->as_object())
    if (!has_data(document, &accessor)) return false;
  return true;
}

void check_meshes(const Json& document, const std::string& path) {
  for (std::size_t m = 0; m < count_at(document, "meshes"); ++m) {
    const Json& mesh = element(document, "meshes", m);
    for (std::size_t p = 0; p < count_at(mesh, "primitives"); ++p) {
      const Json& primitive = element(mesh, "primitives", p);
      if (find_path(primitive, text("extensions/", kDraco)) && !has_data_of(document, primitive))
        refuse(path, text("mesh \"", text_at(mesh, "name", text("meshes[", m, "]")), "\""), kDraco);
    }
  }
}

/// The buffer that meshopt's views stand in is a placeholder without bytes, unless the file gives it some.
void check_buffers(const Json& document, const std::string& path) {
  for (std::size_t v = 0; v < count_at(document, "bufferViews"); ++v) {
    const Json& view = element(document, "bufferViews", v);
    for (const char* extension : kMeshopt) {
      if (!find_path(view, text("extensions/", extension))) continue;
      const auto buffer = static_cast<std::size_t>(number_at(view, "buffer", 0));
      const Json& bytes = element(document, "buffers", buffer);
      const bool placeholder = find_path(bytes, text("extensions/", extension, "/fallback")) != nullptr;
      if (placeholder && !bytes.find("uri")) refuse(path, text("bufferViews[", v, "]"), extension);
    }
  }
}

}  // namespace

void require_uncompressed(const Json& document, const std::string& path) {
  check_meshes(document, path);
  check_buffers(document, path);
}

}  // namespace phos::inline scene
