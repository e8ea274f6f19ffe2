#include "scene/obj/material.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/gltf/uri.h"

namespace phos::inline scene {
namespace {

/// From this exponent on a highlight is a mirror: exporters write 1000 for a roughness of 0, 900 for 0.05.
constexpr double kMirrorNs = 900;

Rgb clean(const tinyobj::real_t c[3]) {
  const auto value = [](tinyobj::real_t v) {
    return std::isfinite(v) && v > 0 ? static_cast<float>(v) : 0.0f;
  };
  return {value(c[0]), value(c[1]), value(c[2])};
}

/// "a", "b" and 3 more.
std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string all;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
    all += text(i == 0 ? "" : ", ", "\"", names[i], "\"");
  return names.size() > kShown ? text(all, " and ", names.size() - kShown, " more") : all;
}

/// The share of the surface that is there, by d or Tr.
std::optional<double> stated_share(const MtlStatements& said) {
  std::optional<double> share = said.number("d");
  if (!share)
    if (const std::optional<double> tr = said.number("Tr")) share = 1 - *tr;
  if (share) share = std::clamp(*share, 0.0, 1.0);
  return share;
}

CoverageOf channel_of(const tinyobj::texture_option_t& option) {
  switch (option.imfchan) {
    case 'r':
      return CoverageOf::red;
    case 'g':
      return CoverageOf::green;
    case 'b':
      return CoverageOf::blue;
    case 'l':
      return CoverageOf::luminance;
    default:
      return CoverageOf::alpha_or_luminance;
  }
}

bool same_place(const TextureUse& a, const TextureUse& b) {
  return a.offset == b.offset && a.scale == b.scale;
}

}  // namespace

std::string obj_file(const std::string& obj_path, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return beside(obj_path, name);
}

std::optional<std::string> read_if_there(const std::string& path) {
  try {
    return read_referred(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

void ObjMaterials::make_thin(Material& glass) {
  glass.model = Model::thin_dielectric;
  glass.tint *= glass.tint;
}

void ObjMaterials::warn(const std::string& material, const std::string& what) {
  scene_.warnings.emplace_back(Note::Level::warning, "loader", "material", material, what);
}

TextureUse ObjMaterials::texture(const std::string& name, const tinyobj::texture_option_t& option,
                                 bool srgb) {
  TextureUse use;
  if (name.empty()) return use;
  const std::optional<std::string> bytes = read_if_there(obj_file(scene_.path, name));
  TexturePool::Sampling sampling;
  if (option.clamp) sampling.wrap_u = sampling.wrap_v = Texture::Wrap::clamp;
  use.texture = textures_.add(text(name, option.clamp ? " clamp" : ""), name, bytes.value_or(""),
                              bytes ? "" : "cannot be read beside the scene", sampling, srgb);
  // u and v of the file times -s plus -o; ours count rows from above.
  const auto finite = [](tinyobj::real_t v, float absent) {
    return std::isfinite(v) ? static_cast<float>(v) : absent;
  };
  use.scale = {finite(option.scale[0], 1), finite(option.scale[1], 1)};
  use.offset = {finite(option.origin_offset[0], 0), 1 - use.scale.y - finite(option.origin_offset[1], 0)};
  return use;
}

void ObjMaterials::read_reflection(const tinyobj::material_t& from, const MtlStatements& said, Material& m) {
  m.kd = said.colour("Kd").value_or(clean(from.diffuse));
  const Rgb ks = said.colour("Ks").value_or(Rgb(0));
  const std::optional<double> ns = said.number("Ns");
  if (max_component(ks) > 0) {
    const bool reflects = from.illum == 3 || from.illum == 5 || from.illum == 8;
    if (!said.states("illum")) {
      warn(m.name, "Ks is not used: no illum says that there are highlights");
    } else if (reflects && (!ns || *ns >= kMirrorNs)) {
      m.model = Model::ward;  // of no roughness: a mirror beside a Lambert part
      if (max_component(m.kd) == 0 && from.diffuse_texname.empty()) m.model = Model::mirror;
      m.ks = ks;
      if (from.illum == 5)
        warn(m.name, "illum 5 is read as a mirror of Ks at every angle, without Fresnel's rise");
    } else if (from.illum >= 2 && ns && !(*ns > 0)) {
      warn(m.name, "Ks is not used: Ns is not above 0");
    } else if (from.illum >= 2) {
      m.model = Model::phong;
      m.ks = ks;
      m.exponent = static_cast<float>(ns.value_or(1));
    }
    if (max_component(m.kd + m.ks) > 1.0001f)
      scene_.warnings.emplace_back(Note::Level::info, kSaidByLint, "material", m.name,
                                   "Kd + Ks is above 1: it reflects more light than it receives");
  }
  m.base_colour = texture(from.diffuse_texname, from.diffuse_texopt, true);
  // A map stands in for a Kd that exporters leave black.
  if (m.base_colour.used() && max_component(m.kd) == 0) m.kd = Rgb(1);
}

/// False: it is no glass.
bool ObjMaterials::read_glass(const MtlStatements& said, double share, Material& m) {
  const auto illum = static_cast<int>(said.number("illum").value_or(0));
  if (illum != 4 && illum != 6 && illum != 7 && illum != 9) return false;
  const double ior = said.number("Ni").value_or(1);
  const std::optional<Rgb> filter = said.colour(said.states("Tf") ? "Tf" : "Kt");
  const bool whole = share <= 0 || share >= 1;
  if (!(ior > 1) && (illum == 4 || !filter || ior < 1)) {
    if (whole && share > 0)
      warn(m.name, text("illum ", illum, " is read as reflection only: glass needs an Ni above 1"));
    return false;
  }
  if (!whole || said.states("map_d")) {
    warn(m.name, text("illum ", illum,
                      " and Ni are not used: the share that d leaves open passes light straight, without the "
                      "reflections of glass"));
    return false;
  }
  if (max_component(m.kd + m.ks) > 0)
    warn(m.name, text("illum ", illum, " is read as clear glass of index ", shortest(ior),
                      ": Kd, Ks and Ns are not used"));
  m.model = Model::dielectric;
  m.kd = m.ks = Rgb(0);
  m.ior = static_cast<float>(ior);
  m.base_colour = {};
  const Rgb tint = glm::min(filter.value_or(Rgb(1)), Rgb(1));
  m.tint = {std::sqrt(tint.x), std::sqrt(tint.y), std::sqrt(tint.z)};
  return true;
}

void ObjMaterials::read_transparency(const tinyobj::material_t& from, const MtlStatements& said,
                                     Material& m) {
  const std::optional<double> d = said.number("d"), tr = said.number("Tr");
  double share = stated_share(said).value_or(1);
  if (d && tr && std::fabs(*d - (1 - *tr)) > 1e-3)
    warn(m.name, text("d ", shortest(*d), " and Tr ", shortest(*tr), " contradict each other; d is taken"));
  if (said.has_option("d", "-halo"))
    warn(m.name, "-halo of d is not modelled: it lets the same share pass at every angle");
  const auto index = static_cast<std::uint32_t>(scene_.material.size());
  if (read_glass(said, share, m)) {
    glass_.insert(index);
    return;
  }
  const TextureUse map = texture(from.alpha_texname, from.alpha_texopt, false);
  const std::optional<Rgb> filter = said.colour(said.states("Tf") ? "Tf" : "Kt");
  const bool tinted = filter && *filter != Rgb(1) && *filter != Rgb(0);
  if (tinted) warn(m.name, "Tf is not used: it filters what passes glass (illum 4, 6, 7 or 9, and Ni)");
  if (map.used() && share == 0) {
    warn(m.name, "d is 0, or Tr is 1, beside a map_d: the map alone says what is there");
    share = 1;
  } else if (share == 0) {
    warn(m.name,
         "it is invisible: d is 0, or Tr is 1, so that all light passes; 1 - Tr is the share that is there");
  }
  if (share == 1 && !map.used()) return;
  m.alpha_mode = Material::Alpha::blend;
  m.alpha = static_cast<float>(share);
  if (map.used()) coverage_.push_back({index, map.texture, channel_of(from.alpha_texopt), map});
}

void ObjMaterials::note_unread(const MtlStatements& said) {
  static const std::set<std::string> kOptions = {"-o", "-s", "-clamp", "-texres", "-halo"};
  static const std::set<std::string> kTextures = {"map_Kd", "map_Ke", "map_d", "norm"};
  for (const auto& [keyword, rest] : said.rest) {
    const MtlUse use = mtl_use(keyword);
    if (use != MtlUse::read) {
      const bool off = keyword == "map_aat" && rest == "off";
      if (!off)
        unread_[text(keyword, use == MtlUse::not_known ? " is not known, and not read" : " is not modelled")]
            .push_back(said.material);
      continue;
    }
    const bool colour = keyword.size() == 2 && keyword[0] == 'K' && keyword != "Ka";
    if ((colour || keyword == "Tf") && said.numbers(keyword).empty())
      unread_[text(keyword, " is read as numbers only, not \"", rest.substr(0, rest.find(' ')), "\"")]
          .push_back(said.material);
    if (!kTextures.contains(keyword)) continue;
    for (const std::string& option : said.options(keyword)) {
      const bool of_coverage = keyword == "map_d" && option == "-imfchan";
      const bool blends = option == "-blendu" || option == "-blendv";
      if (kOptions.contains(option) || of_coverage ||
          (blends && rest.find(option + " off") == std::string::npos))
        continue;
      unread_[text(option, " of ", keyword, " is not modelled")].push_back(said.material);
    }
  }
}

void ObjMaterials::add(const tinyobj::material_t& from, const MtlStatements& said) {
  Material m;
  m.name = from.name;
  m.emission = said.colour("Ke").value_or(Rgb(0));
  read_reflection(from, said, m);
  read_transparency(from, said, m);
  if (m.emits())
    m.emissive = texture(from.emissive_texname, from.emissive_texopt, true);
  else if (!from.emissive_texname.empty())
    warn(m.name, "map_Ke is not used: no Ke says how bright it is, in cd/m2");
  m.normal = texture(from.normal_texname, from.normal_texopt, false);
  note_unread(said);
  scene_.material.push_back(m);
}

/// The alpha of a base colour is a coverage in a blended material; a colour's own alpha says nothing in MTL.
void ObjMaterials::join_coverage(const std::vector<std::int32_t>& place) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> joined;  // by colour and coverage
  const auto add = [&](Texture made) {
    scene_.texture.push_back(std::move(made));
    return static_cast<std::int32_t>(scene_.texture.size() - 1);
  };
  const auto at = [&](std::int32_t i) {
    return i < 0 ? nullptr : &scene_.texture[static_cast<std::size_t>(i)];
  };
  for (const Coverage& c : coverage_) {
    Material& m = scene_.material[c.material];
    const std::int32_t map = place[static_cast<std::size_t>(c.texture)];
    if (map < 0) continue;
    if (m.base_colour.used() && !same_place(m.base_colour, c.use))
      warn(m.name, "-o and -s of map_d differ from those of map_Kd, which are used for both");
    const std::int32_t key = 8 * map + static_cast<std::int32_t>(c.channel);
    auto [known, fresh] = joined.try_emplace({m.base_colour.texture, key}, -1);
    if (fresh) known->second = add(with_coverage(at(m.base_colour.texture), *at(map), c.channel));
    if (!m.base_colour.used()) m.base_colour = c.use;
    m.base_colour.texture = known->second;
  }
  std::set<std::uint32_t> covered;
  for (const Coverage& c : coverage_)
    if (place[static_cast<std::size_t>(c.texture)] >= 0) covered.insert(c.material);
  for (std::uint32_t i = 0; i < scene_.material.size(); ++i) {
    Material& m = scene_.material[i];
    if (m.alpha_mode != Material::Alpha::blend || covered.contains(i) || !m.base_colour.used()) continue;
    if (!has_alpha(*at(m.base_colour.texture))) continue;
    auto [known, fresh] = joined.try_emplace({m.base_colour.texture, -1}, -1);
    if (fresh) known->second = add(without_alpha(*at(m.base_colour.texture)));
    m.base_colour.texture = known->second;
  }
}

void ObjMaterials::finish() {
  const std::vector<std::int32_t> place = textures_.decode(scene_);
  join_coverage(place);
  for (Material& m : scene_.material)
    if (m.alpha_mode == Material::Alpha::blend && m.alpha == 1 && !m.base_colour.used())
      m.alpha_mode = Material::Alpha::opaque;  // its map cannot be read
  for (const auto& [what, materials] : unread_)
    scene_.warnings.emplace_back(text(what, " (material ", list_of(materials), ")"));
}

}  // namespace phos::inline scene
