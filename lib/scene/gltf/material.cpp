#include "scene/gltf/material.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "file/atomic_file.h"
#include "scene/gltf/stated_brdf.h"
#include "scene/gltf/uri.h"
#include "scene/material/merl.h"
#include "scene/material/models.h"

namespace phos::inline scene {
namespace {

/// GGX roughness below which transmission counts as smooth glass.
constexpr double kSmoothRoughness = 0.1;

constexpr const char* kAnisotropy = "extensions/KHR_materials_anisotropy";
constexpr const char* kTransmission = "extensions/KHR_materials_transmission";
constexpr const char* kDiffuse = "extensions/KHR_materials_diffuse_transmission";
constexpr const char* kVolume = "extensions/KHR_materials_volume";

struct ImageBytes {
  std::string name, bytes, missing;
};

ImageBytes image_bytes(const GltfDocument& document, std::size_t i) {
  const Json& image = element(document.json, "images", i);
  const std::string uri = text_at(image, "uri", "");
  ImageBytes out{text_at(image, "name", text("images[", i, "]")), "", ""};
  if (const Json* view_index = image.find("bufferView")) {
    const auto& view = document.model->bufferViews[static_cast<std::size_t>(view_index->as_number())];
    const std::string& buffer = document.buffer[static_cast<std::size_t>(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
      document.fail(text("images[", i, "] reaches outside its buffer"));
    }
    out.bytes = buffer.substr(view.byteOffset, view.byteLength);
  } else if (is_data_uri(uri)) {
    std::optional<std::string> decoded = decode_data_uri(uri);
    if (!decoded) out.missing = "is not valid base64";
    if (decoded) out.bytes = std::move(*decoded);
  } else {
    out.name = uri.empty() ? out.name : uri;
    const std::optional<std::string> file = uri_file(document.path, uri);
    try {
      if (file) out.bytes = read_referred(*file);
      if (!file) out.missing = "is not a relative path";
    } catch (const Error&) {
      out.missing = "cannot be read beside the scene";
    }
  }
  return out;
}

Texture::Wrap wrap_of(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::clamp;
  if (code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Wrap::mirror;
  return Texture::Wrap::repeat;
}

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document, TexturePool& textures, Scene& scene)
      : document_(document), textures_(textures), scene_(scene) {}

  void read(std::size_t index) {
    index_ = index;
    const tinygltf::Material& from = document_.model->materials[index];
    json_ = &element(document_.json, "materials", index);
    material_ = Material();
    material_.name = from.name.empty() ? text("material ", index) : from.name;
    read_core(from);
    read_emission(from);
    read_extensions();
    if (const Json* phos = find_path(*json_, "extras/phos")) read_phos(*phos);
    check_energy();
    scene_.material.push_back(material_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    document_.fail(text("material \"", material_.name, "\": ", message));
  }
  /// Of what the scene itself tells, too.
  void note(const std::string& message) const {
    scene_.warnings.emplace_back(Note::Level::info, kSaidByLint, "material", material_.name, message);
  }
  void warn(const std::string& message) const {
    scene_.warnings.emplace_back(Note::Level::warning, "loader", "material", material_.name, message);
  }

  TextureUse use(const char* member, int texture, int set, bool srgb) {
    TextureUse out;
    if (texture < 0) return out;
    if (set > 1) {
      warn(text(member, " uses TEXCOORD_", set, ", which is not read; TEXCOORD_0 is used"));
      set = 0;
    }
    const auto t = static_cast<std::size_t>(texture);
    const tinygltf::Texture& from = document_.model->textures[t];
    TexturePool::Sampling sampling;
    if (from.sampler >= 0) {
      const tinygltf::Sampler& s = document_.model->samplers[static_cast<std::size_t>(from.sampler)];
      sampling = {wrap_of(s.wrapS), wrap_of(s.wrapT), s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST};
    }
    ImageBytes image{text("textures[", t, "]"), "", "has no image that phos can read"};
    if (from.source >= 0) image = image_bytes(document_, static_cast<std::size_t>(from.source));
    out.texture =
        textures_.add(std::to_string(t), image.name, std::move(image.bytes), image.missing, sampling, srgb);
    out.set = static_cast<std::uint8_t>(set);
    read_transform(find_path(*json_, std::string(member) + "/extensions/KHR_texture_transform"), out);
    return out;
  }

  void read_transform(const Json* transform, TextureUse& out) const {
    if (!transform) return;
    const auto pair = [&](const char* key, Vec2 absent) {
      const Json* v = transform->find(key);
      if (!v) return absent;
      if (!v->is_array() || v->as_array().size() != 2)
        fail(text("KHR_texture_transform.", key, " must be two numbers"));
      return Vec2(v->as_array()[0].as_number(), v->as_array()[1].as_number());
    };
    out.offset = pair("offset", out.offset);
    out.scale = pair("scale", out.scale);
    out.rotation_rad = static_cast<float>(number_at(*transform, "rotation", 0));
    const double set = number_at(*transform, "texCoord", out.set);
    if (set == 0 || set == 1) out.set = static_cast<std::uint8_t>(set);
  }

  void read_core(const tinygltf::Material& from) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    const auto factor = [&](std::size_t i) { return static_cast<float>(pbr.baseColorFactor[i]); };
    material_.model = Model::metallic_roughness;
    material_.kd = {factor(0), factor(1), factor(2)};
    material_.alpha = factor(3);
    material_.metallic = static_cast<float>(std::clamp(pbr.metallicFactor, 0.0, 1.0));
    material_.roughness = static_cast<float>(std::clamp(pbr.roughnessFactor, 0.0, 1.0));
    material_.alpha_x = material_.alpha_y = material_.roughness * material_.roughness;
    material_.base_colour = use("pbrMetallicRoughness/baseColorTexture", pbr.baseColorTexture.index,
                                pbr.baseColorTexture.texCoord, true);
    material_.metallic_roughness =
        use("pbrMetallicRoughness/metallicRoughnessTexture", pbr.metallicRoughnessTexture.index,
            pbr.metallicRoughnessTexture.texCoord, false);
    material_.normal = use("normalTexture", from.normalTexture.index, from.normalTexture.texCoord, false);
    material_.normal_scale = static_cast<float>(from.normalTexture.scale);
    material_.double_sided = from.doubleSided;
    material_.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    if (from.alphaMode == "MASK") material_.alpha_mode = Material::Alpha::mask;
    if (from.alphaMode == "BLEND") material_.alpha_mode = Material::Alpha::blend;
    check_colour("baseColorFactor", material_.kd);
  }

  void read_emission(const tinygltf::Material& from) {
    const std::string pointer = text("/materials/", index_);
    Rgb factor(0);
    for (std::size_t c = 0; c < from.emissiveFactor.size() && c < 3; ++c) {
      factor[static_cast<int>(c)] = static_cast<float>(from.emissiveFactor[c]);
    }
    if (const auto it = document_.animated.find(pointer + "/emissiveFactor");
        it != document_.animated.end()) {
      if (it->second.size() == 3) factor = {it->second[0], it->second[1], it->second[2]};
    }
    constexpr const char* kStrength = "extensions/KHR_materials_emissive_strength/emissiveStrength";
    double strength = number_at(*json_, kStrength, 1);
    if (const auto it = document_.animated.find(pointer + "/" + kStrength);
        it != document_.animated.end() && !it->second.empty()) {
      strength = it->second[0];
    }
    material_.emission = factor * static_cast<float>(strength);
    check_colour("emission", material_.emission);
    if (!material_.emits()) return;
    material_.emissive =
        use("emissiveTexture", from.emissiveTexture.index, from.emissiveTexture.texCoord, true);
  }

  void read_extensions() {
    material_.ior = static_cast<float>(number_at(*json_, "extensions/KHR_materials_ior/ior", 1.5));
    if (!(material_.ior == 0 || material_.ior >= 1)) fail("KHR_materials_ior.ior must be 1 or more");
    if (material_.ior == 0) material_.ior = 1.5f;  // 0 asks for the legacy specular-glossiness Fresnel
    material_.specular =
        static_cast<float>(number_at(*json_, "extensions/KHR_materials_specular/specularFactor", 1));
    if (const auto c = rgb_at(*json_, "extensions/KHR_materials_specular/specularColorFactor")) {
      material_.specular_colour = *c;
      check_colour("specularColorFactor", *c);
    }
    if (!(material_.specular >= 0 && material_.specular <= 1)) fail("specularFactor must be between 0 and 1");
    const double t = number_at(*json_, "extensions/KHR_materials_transmission/transmissionFactor", 0);
    if (!(t >= 0 && t <= 1)) fail("transmissionFactor must be between 0 and 1");
    material_.transmission = static_cast<float>(t);
    if (t > 0) read_transmission();
    if (const Json* diffuse = find_path(*json_, kDiffuse)) read_diffuse_transmission(*diffuse);
    if (const Json* anisotropy = find_path(*json_, kAnisotropy)) read_anisotropy(*anisotropy);
  }

  void read_diffuse_transmission(const Json& diffuse) {
    const double share = number_at(diffuse, "diffuseTransmissionFactor", 0);
    if (!(share >= 0 && share <= 1)) fail("diffuseTransmissionFactor must be between 0 and 1");
    const Rgb colour = rgb_at(diffuse, "diffuseTransmissionColorFactor").value_or(Rgb(1));
    check_colour("diffuseTransmissionColorFactor", colour);
    if (share == 0 || find_path(*json_, "extras/phos/brdf")) return;
    if (max_component(colour) > 1)
      warn("its diffuse transmission colour is above 1: it transmits more light than it receives");
    material_.diffuse_transmission = static_cast<float>(share);
    material_.diffuse_transmission_colour = colour;
    material_.diffuse_transmission_map = extension_texture(kDiffuse, "diffuseTransmissionTexture", false);
    material_.diffuse_transmission_colour_map =
        extension_texture(kDiffuse, "diffuseTransmissionColorTexture", true);
    if (find_path(*json_, std::string(kVolume) + "/thicknessFactor"))
      warn("diffuse transmission of a solid is not modelled: its surface is read as a thin sheet");
  }

  /// A texture that an extension of the material names.
  TextureUse extension_texture(const std::string& extension, const std::string& member, bool srgb) {
    const double texture = number_at(*json_, extension + "/" + member + "/index", -1);
    const double set = number_at(*json_, extension + "/" + member + "/texCoord", 0);
    return use((extension + "/" + member).c_str(), static_cast<int>(texture), static_cast<int>(set), srgb);
  }

  void read_anisotropy(const Json& anisotropy) {
    const double strength = number_at(anisotropy, "anisotropyStrength", 0);
    if (!(strength >= 0 && strength <= 1)) fail("anisotropyStrength must be between 0 and 1");
    if (strength == 0 || find_path(*json_, "extras/phos/brdf")) return;
    material_.anisotropy = static_cast<float>(strength);
    material_.anisotropy_rad = static_cast<float>(number_at(anisotropy, "anisotropyRotation", 0));
    material_.alpha_x += (1 - material_.alpha_x) * material_.anisotropy * material_.anisotropy;
    material_.anisotropy_map = extension_texture(kAnisotropy, "anisotropyTexture", false);
  }

  /// KHR_materials_transmission is an infinitely thin sheet unless KHR_materials_volume gives it a body.
  void read_transmission() {
    if (find_path(*json_, "extras/phos/brdf")) return;
    material_.transmission_map = extension_texture(kTransmission, "transmissionTexture", false);
    if (!find_path(*json_, "pbrMetallicRoughness/metallicFactor") && !material_.metallic_roughness.used()) {
      material_.metallic = 0;  // metal passes nothing, and nobody means that
      warn("it has no metallicFactor, which makes it a metal; as it transmits, it is read as 0");
    }
    const bool smooth = material_.roughness <= kSmoothRoughness && !material_.metallic_roughness.used();
    const Rgb tint = material_.kd;
    const double thickness_m = number_at(*json_, std::string(kVolume) + "/thicknessFactor", 0);
    if (!(thickness_m >= 0)) fail("thicknessFactor must not be negative");
    if (thickness_m > 0 && smooth && material_.transmission >= 0.5f) {
      become(Model::dielectric);
      material_.tint = material_.transmission * tint;
      material_.thickness_m = static_cast<float>(thickness_m);
      material_.absorption_per_m = read_attenuation();
      if (material_.transmission_map.used())
        warn("its transmissionTexture is not used: solid glass transmits all over");
      return;
    }
    if (thickness_m > 0)
      warn("rough or partial transmission of a solid is not modelled: its surface is read as a thin sheet");
    if (!smooth) {
      warn("transmitted light passes straight through without scattering, whatever the roughness");
    } else if (material_.transmission == 1 && !material_.transmission_map.used() && material_.metallic == 0 &&
               material_.specular == 1 && material_.specular_colour == Rgb(1)) {
      become(Model::thin_dielectric);
      material_.tint = tint;
    } else {
      material_.roughness = material_.alpha_x = material_.alpha_y = 0;
    }
  }

  /// KHR_materials_volume: light falls to attenuationColor within attenuationDistance.
  Rgb read_attenuation() const {
    const Json* volume = find_path(*json_, kVolume);
    const double distance_m =
        number_at(*volume, "attenuationDistance", std::numeric_limits<double>::infinity());
    const Rgb colour = rgb_at(*volume, "attenuationColor").value_or(Rgb(1));
    check_colour("attenuationColor", colour);
    if (!(distance_m >= 0)) fail("attenuationDistance must not be negative");
    Rgb absorption(0);
    for (int c = 0; c < 3; ++c) {
      if (colour[c] >= 1 || std::isinf(distance_m)) continue;
      absorption[c] = colour[c] > 0 && distance_m > 0
                          ? static_cast<float>(-std::log(static_cast<double>(colour[c])) / distance_m)
                          : kInfinity;
    }
    return absorption;
  }

  void become(Model model, const Rgb& kd = Rgb(0)) {
    material_.model = model;
    material_.kd = row_of(material_).keeps_kd ? kd : Rgb(0);
  }

  /// The exact model. What it does not give stays as the core material has it.
  void read_phos(const Json& phos) {
    material_.spectrum = spectrum_of_material();
    const Json* brdf = phos.find("brdf");
    if (!brdf && !material_.spectrum.empty()) return;
    if (!brdf || !brdf->is_string()) fail("extras.phos needs a \"brdf\"");
    const Model* model = model_named(brdf->as_string());
    if (!model) fail("extras.phos.brdf \"" + brdf->as_string() + "\" is not a model phos has");
    const StatedBrdf::Owner owner{[&](const std::string& message) { fail(message); },
                                  [&](const std::string& message) { warn(message); },
                                  [&]() { read_measured(phos); }};
    const StatedBrdf stated(phos, material_.kd, owner);
    become(*model, stated.colour("kd").value_or(stated.base()));
    material_.ks = Rgb(0);
    material_.ior = stated.number("ior", static_cast<double>(material_.ior));
    if (material_.ior < 1) fail("extras.phos.ior must be 1 or more");
    stated.read_alpha(material_);
    const ModelRow& row = row_of(material_);
    if (row.read) row.read(stated, material_);
    for (const ModelRow& any : model_rows())
      for (const ModelParameter& p : any.parameters)
        if (&any == &row || p.of_every_model)
          material_.*p.number = stated.number(p.key, static_cast<double>(p.absent));
  }

  std::string spectrum_of_material() const {
    try {
      return spectrum_file(document_.path, *json_);
    } catch (const std::runtime_error& e) {
      fail(e.what());
    }
  }

  /// The table, once for each file. It is the whole material: textures and colours do not change it.
  void read_measured(const Json& phos) {
    const Json* file = phos.find("file");
    if (!file || !file->is_string()) fail("extras.phos: merl needs a \"file\"");
    const std::optional<std::string> path = file_below(document_.path, file->as_string());
    if (!path) {
      fail("extras.phos.file must be a relative path to a file beside the scene or in a folder below it");
    }
    auto [known, first] = measured_.try_emplace(*path, static_cast<std::int32_t>(scene_.measured.size()));
    if (first) scene_.measured.push_back(std::make_shared<const MerlBrdf>(read_merl(*path)));
    const MerlBrdf& measured = *scene_.measured[static_cast<std::size_t>(known->second)];
    material_.measured = known->second;
    material_.kd = measured.lambert();
    material_.alpha_x = material_.alpha_y = measured.alpha();
    if (material_.base_colour.used()) warn("its base colour texture is not used with measured data");
    material_.base_colour = TextureUse();
    if (const std::string gain = measured.energy_gain(); !gain.empty()) note(gain);
    if (first) count_cells(measured);
  }

  void count_cells(const MerlBrdf& measured) {
    const auto count = [&](const char* event, std::uint64_t n) {
      if (n > 0) scene_.events[event] += n;
    };
    count("measured angles that reflect more than they get", measured.gaining_angles());
    count("measured cells without data, filled from the nearest", measured.empty_reachable_cells());
  }

  void check_colour(const std::string& what, const Rgb& c) const {
    phos::check_colour(c, what, [&](const std::string& message) { fail(message); });
  }

  void check_energy() const {
    const ModelRow& row = row_of(material_);
    if (row.passes_kt && material_.diffuse_transmission > 0 &&
        max_component(material_.kd + material_.diffuse_transmission_colour) > 1.0001f)
      warn("kd + kt is above 1: it transmits more light than it receives");
    if (max_component(material_.kd + (row.adds_ks ? material_.ks : Rgb(0))) > 1.0001f)
      note("kd + ks is above 1: it reflects more light than it receives");
  }

  const GltfDocument& document_;
  TexturePool& textures_;
  Scene& scene_;
  Material material_;
  std::map<std::string, std::int32_t> measured_;  // by file
  const Json* json_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace

void read_gltf_materials(const GltfDocument& document, TexturePool& textures, Scene& scene) {
  MaterialReader reader(document, textures, scene);
  for (std::size_t i = 0; i < document.model->materials.size(); ++i) reader.read(i);
}

}  // namespace phos::inline scene
