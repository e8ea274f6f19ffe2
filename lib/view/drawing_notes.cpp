#include "view/drawing_notes.h"

#include <algorithm>

#include "scene/material/bsdf.h"
#include "view/gloss_message.h"

namespace phos::inline view {
namespace {

/// What of the scene the page does not draw as it is.
struct Traits {
  bool gloss = false;     // reads no radiance record
  bool records = false;   // gloss that does
  bool specular = false;  // mirrors and glass
  bool bumps = false;
};

Traits traits_of(const Scene& scene, const GlossCache* gloss) {
  Traits traits;
  traits.records = has_gloss_records(scene, gloss);
  for (std::uint32_t i = 0; i < scene.material.size(); ++i) {
    const Bsdf bsdf(scene, i);
    traits.gloss = traits.gloss || (bsdf.has_gloss() && !(traits.records && reads_records(gloss, i)));
    traits.specular = traits.specular || bsdf.has_specular();
    traits.bumps = traits.bumps || scene.material[i].normal.used();
  }
  return traits;
}

}  // namespace

std::vector<std::string> drawing_notes(const RayScene& rays, const IrradianceCache& cache,
                                       const GlossCache* gloss) {
  const Traits traits = traits_of(rays.scene(), gloss);
  const std::pair<bool, const char*> all[] = {
      {traits.gloss, "gloss without radiance records reflects lamps, and other light as a matt surface does"},
      {traits.records,
       "gloss is drawn from radiance records; on curved surfaces, lobes keep their shape about the mirrored "
       "direction"},
      {traits.specular,
       "mirrors and glass reflect once: the flat ones that matter most by a second view of the scene, others "
       "by cube maps about them"},
      {rays.has_panes(), "glass is seen through, and lets light of lamps pass, without bending"},
      {traits.bumps, "normal maps are not drawn"},
      {cache.caustics != nullptr, "caustic light, which the cache holds as photons, is not drawn"}};
  std::vector<std::string> notes;
  for (const auto& [applies, note] : all)
    if (applies) notes.emplace_back(note);
  return notes;
}

}  // namespace phos::inline view
