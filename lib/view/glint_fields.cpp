#include "view/glint_fields.h"

#include <cmath>

#include "scene/material/bsdf.h"
#include "scene/material/models.h"

namespace phos::inline view {
namespace {

struct Glint {
  GlintKind kind = GlintKind::none;
  Rgb peak{0};
  float width = 0;
};

Glint glint_of(const Scene& scene, std::uint32_t material) {
  const Bsdf bsdf(scene, material);
  const Material& m = scene.material[material];
  const GlossWidth gloss = gloss_width(m);
  Glint glint;
  if (!bsdf.has_gloss()) return glint;
  if (gloss.kind == GlossWidth::Kind::exponent) {
    glint.kind = GlintKind::phong, glint.width = gloss.exponent;
  } else if (gloss.kind == GlossWidth::Kind::rough) {
    // Ward's lobe is beside the matt part, GGX over or instead of it.
    glint.kind = row_of(m).adds_ks ? GlintKind::ward : GlintKind::ggx;
    glint.width = std::sqrt(gloss.alpha_x * gloss.alpha_y);
  } else {
    return glint;
  }
  const Vec3 normal(0, 0, 1);
  glint.peak = glm::max(bsdf.evaluate_gloss(normal, normal), Rgb(0));
  return glint;
}

}  // namespace

void add_glints(const Scene& scene, MessageWriter& message) {
  std::vector<std::uint32_t> kind;
  std::vector<float> peak, width;
  for (std::uint32_t i = 0; i < scene.material.size(); ++i) {
    const Glint glint = glint_of(scene, i);
    kind.push_back(static_cast<std::uint32_t>(glint.kind)), width.push_back(glint.width);
    for (int c = 0; c < 3; ++c) peak.push_back(glint.peak[c]);
  }
  message.add("material", "glint", kind);
  message.add("material", "glint_peak", peak);
  message.add("material", "glint_width", width);
}

}  // namespace phos::inline view
