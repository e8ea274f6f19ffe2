#include "scene/gltf/luminaires.h"

#include <cmath>

#include "core/error.h"
#include "scene/gltf/uri.h"

namespace phos::inline scene {
namespace {

constexpr const char* kProfiles = "extensions/EXT_lights_ies/lights";
constexpr const char* kOfNode = "extensions/EXT_lights_ies";

bool is_index(const Json& v, std::size_t n) {
  if (!v.is_number()) return false;
  const double d = v.as_number();
  return d >= 0 && d < static_cast<double>(n) && d == std::floor(d);
}

std::string bytes_of_view(const GltfDocument& document, std::size_t i) {
  const Json& view = element(document.json, "bufferViews", i);
  const std::string& buffer = document.buffer[static_cast<std::size_t>(number_at(view, "buffer", 0))];
  const double offset = number_at(view, "byteOffset", 0), length = number_at(view, "byteLength", 0);
  if (!(offset + length <= static_cast<double>(buffer.size())))
    document.fail(text("bufferViews[", i, "] reaches outside its buffer of ", buffer.size(), " bytes"));
  return buffer.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

}  // namespace

void check_gltf_luminaires(const Json& document, const std::string& path) {
  const auto fail = [&](const std::string& message) { throw Error(ExitCode::bad_input, path, message); };
  const Json* profiles = find_path(document, kProfiles);
  if (profiles && !profiles->is_array()) fail(text(kProfiles, " must be an array"));
  const std::size_t n = count_at(document, kProfiles);
  for (std::size_t i = 0; i < n; ++i) {
    const Json& profile = profiles->as_array()[i];
    const std::string place = text("EXT_lights_ies.lights[", i, "]");
    if (!profile.is_object()) fail(place + " must be an object");
    for (const char* key : {"uri", "name", "mimeType"})
      if (const Json* v = profile.find(key); v && !v->is_string())
        fail(text(place, ".", key, " must be a text"));
    const Json* view = profile.find("bufferView");
    if (view && !is_index(*view, count_at(document, "bufferViews")))
      fail(text(place, ".bufferView names none of the ", count_at(document, "bufferViews"), " bufferViews"));
    if (!view && !profile.find("uri")) fail(place + " has neither uri nor bufferView");
  }
  for (std::size_t i = 0; i < count_at(document, "nodes"); ++i) {
    const Json* of_node = find_path(element(document, "nodes", i), kOfNode);
    if (!of_node) continue;
    const std::string place = text("nodes[", i, "].EXT_lights_ies");
    if (!of_node->is_object()) fail(place + " must be an object");
    const Json* light = of_node->find("light");
    if (!light || !is_index(*light, n)) fail(text(place, ".light names none of the ", n, " light profiles"));
    const auto number = [](const Json& v) {
      return v.is_number() && v.as_number() >= 0 && v.as_number() <= 1e30;
    };
    if (const Json* m = of_node->find("multiplier"); m && !number(*m))
      fail(place + ".multiplier must be 0 or more");
    if (const Json* c = of_node->find("color")) {
      bool good = c->is_array() && c->as_array().size() == 3;
      for (std::size_t k = 0; good && k < 3; ++k) good = number(c->as_array()[k]);
      if (!good) fail(place + ".color must be three numbers, 0 or more");
    }
  }
}

std::optional<GltfLuminaire> gltf_luminaire(const Json& document, std::size_t node) {
  const Json* of_node = find_path(element(document, "nodes", node), kOfNode);
  if (!of_node) return {};
  GltfLuminaire out;
  out.profile = static_cast<std::size_t>(of_node->find("light")->as_number());
  out.name = text_at(find_path(document, kProfiles)->as_array()[out.profile], "name", "");
  const Rgb colour = glm::clamp(rgb_at(*of_node, "color").value_or(Rgb(1)), Rgb(0), Rgb(1));
  out.colour = colour * static_cast<float>(number_at(*of_node, "multiplier", 1));
  return out;
}

std::shared_ptr<const PhotometricFile> GltfProfiles::read(std::size_t i) {
  std::shared_ptr<const PhotometricFile>& known = file_[i];
  if (known) return known;
  const Json& profile = find_path(document_.json, kProfiles)->as_array()[i];
  const std::string where = text(document_.path, ": EXT_lights_ies.lights[", i, "]");
  const auto parsed = [&](std::string_view bytes) {
    return std::make_shared<const PhotometricFile>(parse_photometry(bytes, where));
  };
  const std::string uri = text_at(profile, "uri", "");
  if (const Json* view = profile.find("bufferView")) {
    known = parsed(bytes_of_view(document_, static_cast<std::size_t>(view->as_number())));
  } else if (is_data_uri(uri)) {
    const std::optional<std::string> bytes = decode_data_uri(uri);
    if (!bytes) document_.fail(text("EXT_lights_ies.lights[", i, "].uri is not valid base64"));
    known = parsed(*bytes);
  } else {
    const std::optional<std::string> file = uri_file(document_.path, uri);
    if (!file)
      document_.fail(text("EXT_lights_ies.lights[", i, "].uri must be a relative path, not \"", uri, "\""));
    read_referred(*file);  // a regular file, or an error
    known = std::make_shared<const PhotometricFile>(read_photometry(*file));
  }
  return known;
}

}  // namespace phos::inline scene
