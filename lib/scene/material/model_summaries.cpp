#include "scene/material/model_summaries.h"

#include <algorithm>

#include "scene/material/merl.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

/// A dielectric's own highlight (4 %) counts as gloss below this roughness; above it, it is as good as
/// diffuse.
constexpr float kDullRoughness = 0.9f;

/// Along the normal. A surface that is black but for its gloss reflects its gloss; the base colour holds all
/// that others reflect.
double reflectance_of(const Scene& scene, const Material& m, double base) {
  const float face = (m.ior - 1) / (m.ior + 1) * ((m.ior - 1) / (m.ior + 1));
  const double gloss = luminance(m.specular * glm::min(face * m.specular_colour, Rgb(1)));
  const double passes = m.transmission * mean_texel(scene, m.transmission_map).x, metal = m.metallic;
  if (passes == 0) return std::max(base, (1 - metal) * gloss);
  return metal * base + (1 - metal) * (gloss + (1 - gloss) * (1 - passes) * base);
}

ReflectionSummary coated(const Material& m, double reflectance, bool diffuse) {
  const bool smooth = m.alpha_x == 0 && m.alpha_y == 0;
  return {reflectance, diffuse, !smooth, smooth};
}

}  // namespace

ReflectionSummary summarise_core(const SummaryInput& in) {
  const Material& m = in.material;
  const bool smooth = m.roughness == 0 && m.anisotropy == 0;
  ReflectionSummary s;
  s.reflectance = reflectance_of(in.scene, m, (1 - (1 - m.metallic) * in.through) * in.kd);
  s.diffuse = (in.kd > 0 || in.through > 0) && m.metallic < 1 &&
              !(m.transmission == 1 && m.metallic == 0 && !m.transmission_map.used());
  s.specular = m.transmission > 0 || smooth;
  s.glossy = !smooth && (m.metallic > 0.1f || (m.roughness < kDullRoughness && m.specular > 0));
  return s;
}

ReflectionSummary summarise_lambert(const SummaryInput& in) { return {in.kd, in.kd > 0 || in.through > 0}; }

ReflectionSummary summarise_kd_and_ks(const SummaryInput& in) {
  return {in.kd + in.ks, in.kd > 0, in.ks > 0};
}

ReflectionSummary summarise_plastic(const SummaryInput& in) { return coated(in.material, in.kd, in.kd > 0); }

ReflectionSummary summarise_conductor(const SummaryInput& in) { return coated(in.material, in.ks, false); }

ReflectionSummary summarise_mirror(const SummaryInput& in) { return {in.ks, false, false, in.ks > 0}; }

ReflectionSummary summarise_glass(const SummaryInput&) { return {0, false, false, true}; }

ReflectionSummary summarise_measured(const SummaryInput& in) {
  const MerlBrdf& measured = *in.scene.measured[static_cast<std::size_t>(in.material.measured)];
  return {luminance(measured.mean_albedo()), max_component(measured.lambert()) > 0, measured.glossy()};
}

}  // namespace phos::inline scene
