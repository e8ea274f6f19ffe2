// The reflection models as a table: one row each. All that depends on a material's model is a column.
#pragma once

#include <span>

#include "scene/material/bsdf.h"
#include "scene/scene.h"

namespace phos::inline scene {

class StatedBrdf;

/// A number of a model that extras.phos states, and that a description tells.
struct ModelParameter {
  const char* key = "";  ///< in extras.phos, and in the description
  float Material::*number = nullptr;
  float absent = 0;
  /// Read and hashed for every model, stated or not, so that scene hashes of older files stay.
  bool of_every_model = false;
};

/// Of a material, for a description. Textures and vertex colours are at their mean.
struct ReflectionSummary {
  double reflectance = 0;  ///< luminance of diffuse plus specular part; clear glass counts none
  bool diffuse = false;    ///< has a Lambert part
  bool glossy = false;     ///< has a part worth computing that is neither Lambert's nor a mirror's
  bool specular = false;   ///< mirror, or light passes it straight
};
struct SummaryInput {
  const Scene& scene;
  const Material& material;
  double base;     ///< luminance of the base colour's texture and of vertex colours
  double kd, ks;   ///< luminance, kd with `base`
  double through;  ///< share that a sheet passes diffusely
};

/// How narrow the gloss of a material is. Roughness maps are left out.
struct GlossWidth {
  enum class Kind : std::uint8_t { none, mirror, rough, exponent };
  Kind kind = Kind::none;
  float alpha_x = 0, alpha_y = 0;  ///< rough
  double hit_factor = 12;          ///< rough: of lobe_hit_share, 12 for GGX, 8 for Ward
  float exponent = 0;              ///< Kind::exponent
};

/// How light passes: not; through a thin pane; through a thin sheet, as far as Material::transmission says;
/// or into a solid, bent at its surface.
enum class Passage : std::uint8_t { none, pane, sheet, solid };

struct ModelRow {
  const char* name = "";
  bool stated = true;  ///< extras.phos may name it
  // What of a material counts.
  bool keeps_kd = false;    ///< else kd is 0
  bool adds_ks = false;     ///< reflects kd + ks
  bool passes_kt = false;   ///< kd reflects whole, and kt passes diffusely
  bool gltf_core = false;   ///< roughness, metallic and anisotropy of glTF, with their textures
  bool alpha_lobe = false;  ///< anisotropic where alpha_x and alpha_y differ
  bool measured = false;    ///< needs Material::measured
  bool tells_alpha = true;  ///< where glossy, a description tells alpha_x and alpha_y
  Passage passage = Passage::none;
  /// Its gloss is signed: it takes light from the Lambert part.
  bool takes_from_lambert = false;
  // Spectra of reflectance.
  bool spectrum_is_of_ks = false;     ///< else of kd
  const char* no_spectrum = nullptr;  ///< why it takes none
  std::span<const ModelParameter> parameters = {};
  /// Reads the keys of extras.phos beside kd, ior, alpha and `parameters`.
  void (*read)(const StatedBrdf& stated, Material& material) = nullptr;
  /// Puts its lobes together at a point.
  void (Bsdf::*resolve)(const Scene&, const Material&, const Bsdf::Looked&) = nullptr;
  bool (*lambert_alone)(const Material&) = nullptr;  ///< null: never
  bool (*base_in_gloss)(const Material&) = nullptr;  ///< does the base colour change the gloss? null: never
  GlossWidth (*gloss)(const Material&) = nullptr;    ///< null: none
  ReflectionSummary (*summarise)(const SummaryInput&) = nullptr;

  static const ModelRow kTable[];  ///< in the order of Model
};

std::span<const ModelRow> model_rows();
inline const ModelRow& row_of(const Material& m) {
  return ModelRow::kTable[static_cast<std::size_t>(m.model)];
}
/// The model that extras.phos calls so; null: none.
const Model* model_named(const std::string& name);

inline bool is_solid_glass(const Material& m) { return row_of(m).passage == Passage::solid; }
GlossWidth gloss_width(const Material& material);

}  // namespace phos::inline scene
