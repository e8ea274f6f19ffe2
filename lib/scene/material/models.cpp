#include "scene/material/models.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "scene/gltf/stated_brdf.h"
#include "scene/gltf/stated_pane.h"
#include "scene/material/merl.h"
#include "scene/material/model_summaries.h"

namespace phos::inline scene {
namespace {

bool has_ks(const Material& m) { return max_component(m.ks) > 0; }
bool no_ks(const Material& m) { return !has_ks(m); }

GlossWidth mirror_of(bool there) { return {there ? GlossWidth::Kind::mirror : GlossWidth::Kind::none}; }
GlossWidth rough_of(float alpha_x, float alpha_y, double hit_factor = 12) {
  return {GlossWidth::Kind::rough, alpha_x, alpha_y, hit_factor};
}
GlossWidth alpha_gloss(const Material& m) { return rough_of(m.alpha_x, m.alpha_y); }
GlossWidth ward_gloss(const Material& m) {
  return has_ks(m) ? rough_of(m.alpha_x, m.alpha_y, 8) : GlossWidth();
}
GlossWidth phong_gloss(const Material& m) {
  return has_ks(m) ? GlossWidth{GlossWidth::Kind::exponent, 0, 0, 12, m.exponent} : GlossWidth();
}
GlossWidth glass_gloss(const Material& m) { return mirror_of(m.ior != 1); }
GlossWidth core_gloss(const Material& m) {
  if (!(m.specular > 0 || m.metallic > 0)) return {};
  return rough_of(m.roughness * m.roughness, m.roughness * m.roughness);
}

void read_lambert(const StatedBrdf& stated, Material& m) {
  m.diffuse_transmission_colour = stated.colour("kt").value_or(Rgb(0));
  if (max_component(m.diffuse_transmission_colour) > 0) m.diffuse_transmission = 1;
}
void read_ks(const StatedBrdf& stated, Material& m) { m.ks = stated.colour("ks").value_or(Rgb(0)); }
void read_ward(const StatedBrdf& stated, Material& m) {
  read_ks(stated, m);
  if (!(m.alpha_x > 0 && m.alpha_y > 0)) stated.fail("extras.phos: ward needs ax and ay above 0");
}
void read_mirror(const StatedBrdf& stated, Material& m) {
  m.ks = stated.colour("ks").value_or(stated.base());
}
void read_f0(const StatedBrdf& stated, Material& m) { m.ks = stated.colour("f0").value_or(stated.base()); }
void read_oren_nayar(const StatedBrdf& stated, Material&) {
  if (const float sigma = stated.number("sigma", 0); sigma > kPi / 2)
    stated.warn(text("extras.phos.sigma ", shortest(sigma), " is above pi/2: it is read in radians"));
}
void read_table(const StatedBrdf& stated, Material&) { stated.read_measured(); }

constexpr const char* kGlass = "glass";
constexpr ModelParameter kExponent[] = {{"exponent", &Material::exponent, 1, true}};
constexpr ModelParameter kSigma[] = {{"sigma", &Material::sigma_rad}};

}  // namespace

constinit const ModelRow ModelRow::kTable[] = {
    {.name = "metallic-roughness",
     .stated = false,
     .keeps_kd = true,
     .gltf_core = true,
     .passage = Passage::sheet,
     .takes_from_lambert = true,
     .resolve = &Bsdf::resolve_metallic_roughness,
     .base_in_gloss = [](const Material& m) { return m.metallic > 0; },
     .gloss = core_gloss,
     .summarise = summarise_core},
    {.name = "lambert",
     .keeps_kd = true,
     .passes_kt = true,
     .read = read_lambert,
     .resolve = &Bsdf::resolve_lambert,
     .lambert_alone = [](const Material&) { return true; },
     .summarise = summarise_lambert},
    {.name = "phong",
     .keeps_kd = true,
     .adds_ks = true,
     .tells_alpha = false,
     .parameters = kExponent,
     .read = read_ks,
     .resolve = &Bsdf::resolve_phong,
     .lambert_alone = no_ks,
     .gloss = phong_gloss,
     .summarise = summarise_kd_and_ks},
    {.name = "ward",
     .keeps_kd = true,
     .adds_ks = true,
     .alpha_lobe = true,
     .read = read_ward,
     .resolve = &Bsdf::resolve_ward,
     .lambert_alone = no_ks,
     .gloss = ward_gloss,
     .summarise = summarise_kd_and_ks},
    {.name = "plastic",
     .keeps_kd = true,
     .alpha_lobe = true,
     .takes_from_lambert = true,
     .resolve = &Bsdf::resolve_plastic,
     .gloss = alpha_gloss,
     .summarise = summarise_plastic},
    {.name = "conductor",
     .alpha_lobe = true,
     .spectrum_is_of_ks = true,
     .read = read_f0,
     .resolve = &Bsdf::resolve_conductor,
     .gloss = alpha_gloss,
     .summarise = summarise_conductor},
    {.name = "dielectric",
     .passage = Passage::solid,
     .no_spectrum = kGlass,
     .read = read_glass,
     .resolve = &Bsdf::resolve_glass,
     .gloss = glass_gloss,
     .summarise = summarise_glass},
    {.name = "thindielectric",
     .passage = Passage::pane,
     .no_spectrum = kGlass,
     .read = read_pane,
     .resolve = &Bsdf::resolve_glass,
     .gloss = glass_gloss,
     .summarise = summarise_glass},
    {.name = "mirror",
     .spectrum_is_of_ks = true,
     .read = read_mirror,
     .resolve = &Bsdf::resolve_mirror,
     .gloss = [](const Material& m) { return mirror_of(has_ks(m)); },
     .summarise = summarise_mirror},
    {.name = "merl",
     .measured = true,
     .takes_from_lambert = true,
     .no_spectrum = "measured data",
     .read = read_table,
     .resolve = &Bsdf::resolve_measured,
     .summarise = summarise_measured},
    {.name = "oren-nayar",
     .keeps_kd = true,
     .tells_alpha = false,
     .takes_from_lambert = true,
     .parameters = kSigma,
     .read = read_oren_nayar,
     .resolve = &Bsdf::resolve_oren_nayar,
     .lambert_alone = [](const Material& m) { return !(m.sigma_rad > 0); },
     .base_in_gloss = [](const Material& m) { return m.sigma_rad > 0; },
     .summarise = summarise_oren_nayar},
};

std::span<const ModelRow> model_rows() { return ModelRow::kTable; }

const Model* model_named(const std::string& name) {
  static const std::map<std::string, Model> kModels = [] {
    std::map<std::string, Model> models;
    for (std::size_t i = 0; i < model_rows().size(); ++i)
      if (model_rows()[i].stated) models[model_rows()[i].name] = static_cast<Model>(i);
    return models;
  }();
  const auto found = kModels.find(name);
  return found == kModels.end() ? nullptr : &found->second;
}

GlossWidth gloss_width(const Material& m) {
  const auto gloss = row_of(m).gloss;
  return gloss ? gloss(m) : GlossWidth();
}

bool Material::diffuse_alone() const {
  const auto alone = row_of(*this).lambert_alone;
  return alone && alone(*this) && alpha_mode != Alpha::blend && !(diffuse_transmission > 0);
}

bool Material::anisotropic() const {
  const ModelRow& row = row_of(*this);
  return row.gltf_core ? anisotropy > 0 : row.alpha_lobe && alpha_x != alpha_y;
}

}  // namespace phos::inline scene
