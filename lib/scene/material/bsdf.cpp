#include "scene/material/bsdf.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/material/merl.h"
#include "scene/material/microfacet.h"
#include "scene/material/models.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {

namespace {

/// What is left after a length of glass; nothing where it absorbs without limit.
Rgb left_after(const Rgb& absorption_per_m, float length_m) {
  Rgb left(1);
  for (int c = 0; c < 3; ++c)
    if (absorption_per_m[c] > 0 && length_m > 0) left[c] = std::exp(-absorption_per_m[c] * length_m);
  return left;
}

float normal_reflectance(float ior) {
  const float root = (ior - 1) / (ior + 1);
  return root * root;
}

}  // namespace

// What the material is, at this point.

struct Bsdf::Looked {
  Rgb base, colour;  // kd times colour; colour: of texture and vertices
  Vec4 metallic_roughness;
  float anisotropy, transmission, alpha;
  Rgb through;  // diffuse transmission: share times colour
  float through_share;
};

Bsdf::Bsdf(const Scene& scene, const SurfacePoint& point)
    : frame_{point.tangent, glm::cross(point.normal, point.tangent), point.normal},
      geometric_normal_(point.geometric_normal),
      front_(point.front) {
  const Material& material = scene.material[point.material];
  Rgb base = material.kd * Rgb(point.colour);
  Vec4 colour = point.colour;
  if (material.base_colour.used()) {
    const Vec4 texel = look_up(scene, material.base_colour, point.uv0, point.uv1);
    base *= Rgb(texel), colour *= texel;
  }
  const auto texel = [&](const TextureUse& use) {
    return use.used() ? look_up(scene, use, point.uv0, point.uv1) : Vec4(1);
  };
  const float anisotropy =
      material.anisotropy > 0 ? material.anisotropy * texel(material.anisotropy_map).z : 0;
  const float transmission =
      material.transmission > 0 ? material.transmission * texel(material.transmission_map).x : 0;
  const float share = material.diffuse_transmission > 0
                          ? material.diffuse_transmission * texel(material.diffuse_transmission_map).w
                          : 0;
  if (is_solid_glass(material) && !front_)
    travelled_ = left_after(material.absorption_per_m, point.distance_m);
  resolve(
      scene, material,
      {base, Rgb(colour), texel(material.metallic_roughness), anisotropy, transmission,
       material.alpha * colour.w,
       share * material.diffuse_transmission_colour * Rgb(texel(material.diffuse_transmission_colour_map)),
       share});
}

Bsdf::Bsdf(const Scene& scene, std::uint32_t material, const Frame& frame)
    : frame_(frame), geometric_normal_(frame.z) {
  const Material& m = scene.material[material];
  const Vec4 colour = mean_texel(scene, m.base_colour);
  const float share = m.diffuse_transmission * mean_texel(scene, m.diffuse_transmission_map).w;
  resolve(scene, m,
          {m.kd * Rgb(colour), Rgb(colour), mean_texel(scene, m.metallic_roughness),
           m.anisotropy * mean_texel(scene, m.anisotropy_map).z,
           m.transmission * mean_texel(scene, m.transmission_map).x, m.alpha * colour.w,
           share * m.diffuse_transmission_colour * Rgb(mean_texel(scene, m.diffuse_transmission_colour_map)),
           share});
}

void Bsdf::resolve(const Scene& scene, const Material& material, const Looked& looked) {
  specular_ = material.ks;
  ior_ = material.ior;
  (this->*row_of(material).resolve)(scene, material, looked);
  if (material.alpha_mode == Material::Alpha::blend) cover(std::clamp(looked.alpha, 0.f, 1.f));
}

void Bsdf::resolve_lambert(const Scene&, const Material&, const Looked& looked) {
  diffuse_ = looked.base;
  through_ = looked.through;
}

void Bsdf::resolve_phong(const Scene&, const Material& material, const Looked& looked) {
  diffuse_ = looked.base;
  exponent_ = std::max(material.exponent, 0.f);
  lobe_ = max_component(specular_) > 0 ? Lobe::phong : Lobe::none;
}

void Bsdf::resolve_ward(const Scene&, const Material& material, const Looked& looked) {
  diffuse_ = looked.base;
  if (max_component(specular_) > 0) resolve_rough(Lobe::ward, material.alpha_x, material.alpha_y);
}

void Bsdf::resolve_conductor(const Scene&, const Material& material, const Looked&) {
  resolve_rough(Lobe::ggx, material.alpha_x, material.alpha_y);
}

void Bsdf::resolve_mirror(const Scene&, const Material&, const Looked&) { delta_ = Delta::mirror; }

void Bsdf::resolve_glass(const Scene&, const Material& material, const Looked& looked) {
  delta_ = is_solid_glass(material) ? Delta::dielectric : Delta::thin;
  if (!(ior_ > 0)) ior_ = 1;
  sheet_ = material.tint * looked.colour;
  inside_ = material.inside;
  absorption_per_m_ = material.absorption_per_m;
  curve_ = material.curve.get();
}

void Bsdf::resolve_oren_nayar(const Scene&, const Material& material, const Looked& looked) {
  diffuse_ = looked.base;
  if (!(OrenNayar::roughness(material.sigma_rad) > 0) || !(max_component(looked.base) > 0)) return;
  rough_base_ = OrenNayar(looked.base, material.sigma_rad);
  diffuse_ = rough_base_.mean_albedo();
}

void Bsdf::resolve_measured(const Scene& scene, const Material& material, const Looked&) {
  measured_ = scene.measured[static_cast<std::size_t>(material.measured)].get();
  diffuse_ = measured_->lambert();
  lobe_ = measured_->glossy() ? Lobe::measured : Lobe::none;
}

/// Every lobe is as strong as the share of the surface that is there. Solid glass has no share.
void Bsdf::cover(float coverage) {
  if (delta_ == Delta::dielectric) return;
  coverage_ = coverage;
  rough_base_.cover(coverage);
  diffuse_ *= coverage, base_ *= coverage, through_ *= coverage, specular_ *= coverage, f90_ *= coverage;
}

void Bsdf::resolve_rough(Lobe lobe, float alpha_x, float alpha_y) {
  // GGX is defined by its slope distribution, for which more than 1 has no use; Ward's may be wider.
  if (lobe == Lobe::ggx) alpha_x = std::min(alpha_x, 1.f), alpha_y = std::min(alpha_y, 1.f);
  if (std::max(alpha_x, alpha_y) < kSmoothestAlpha) {
    delta_ = lobe == Lobe::ward ? Delta::mirror : Delta::schlick;
    return;
  }
  lobe_ = lobe;
  alpha_x_ = std::max(alpha_x, kSmoothestAlpha), alpha_y_ = std::max(alpha_y, kSmoothestAlpha);
}

void Bsdf::put_under_coat(const Rgb& base, float f0, float f90, float k_interreflection) {
  coat_f0_ = f0, coat_f90_ = f90;
  const float transmitted = coat_mean_ = mean_coat_transmittance();
  if (!(max_component(base) > 0) || !(transmitted > 0)) return;
  coated_ = true;
  // k_interreflection is 1/eta^2 of the coat, or 0 for a base whose colour already holds the light that
  // leaves the coat. Of the light below the coat, transmitted / eta^2 leaves it (the same reciprocity that
  // makes the outside reflect 1 - transmitted).
  Rgb k(1 / transmitted);
  if (k_interreflection > 0) {
    const Rgb kd = glm::min(base, Rgb(1));
    k = Rgb(k_interreflection) / ((Rgb(1) - kd) + kd * (transmitted * k_interreflection));
  }
  base_ = k * base;
  diffuse_ = base_ * (transmitted * transmitted);
}

void Bsdf::resolve_plastic(const Scene&, const Material& material, const Looked& looked) {
  resolve_rough(Lobe::ggx, material.alpha_x, material.alpha_y);
  const float eta = std::max(ior_, 1.f), f0 = normal_reflectance(eta);
  specular_ = Rgb(f0);
  put_under_coat(looked.base, f0, 1, 1 / (eta * eta));
}

void Bsdf::resolve_metallic_roughness(const Scene&, const Material& material, const Looked& looked) {
  const Rgb& base = looked.base;
  const float roughness = std::clamp(material.roughness * looked.metallic_roughness.y, 0.f, 1.f);
  const float metallic = std::clamp(material.metallic * looked.metallic_roughness.z, 0.f, 1.f);
  const Rgb f0 = material.specular * glm::min(normal_reflectance(ior_) * material.specular_colour, Rgb(1));
  // Schlick is linear in its ends, so glTF's mix of a metal and a dielectric is one lobe.
  specular_ = (1 - metallic) * f0 + metallic * base;
  f90_ = (1 - metallic) * material.specular + metallic;
  const float alpha = roughness * roughness;
  resolve_rough(Lobe::ggx, alpha + (1 - alpha) * looked.anisotropy * looked.anisotropy, alpha);
  const Rgb beneath = (1 - metallic) * base;
  const float scattering = 1 - looked.transmission;
  put_under_coat(scattering * (1 - looked.through_share) * beneath, max_component(f0), material.specular, 0);
  through_ = scattering * (1 - metallic) * coat_mean_ * looked.through;
  sheet_ = looked.transmission * beneath;
  pane_share_ = (1 - metallic) * looked.transmission;
  if (max_component(sheet_) > 0 && delta_ == Delta::none) delta_ = Delta::sheet;
}

// What it does.

bool Bsdf::above(const Vec3& wo, const Vec3& wi, Vec3& o, Vec3& i) const {
  o = frame_.to_local(wo), i = frame_.to_local(wi);
  return o.z > 0 && i.z > 0 && glm::dot(wo, geometric_normal_) > 0 && glm::dot(wi, geometric_normal_) > 0;
}

/// From one side of the surface and of its shading normal's horizon to the other, either way.
bool Bsdf::across(const Vec3& wo, const Vec3& wi) const {
  const auto side = [&](const Vec3& w) {
    const bool above_shading = glm::dot(w, frame_.z) > 0, above_surface = glm::dot(w, geometric_normal_) > 0;
    return above_shading == above_surface ? (above_shading ? 1 : -1) : 0;
  };
  return side(wo) * side(wi) < 0;
}

/// The same material, looked at from the other side.
Bsdf Bsdf::turned() const {
  Bsdf side = *this;
  side.frame_ = {frame_.x, -frame_.y, -frame_.z};
  side.geometric_normal_ = -geometric_normal_;
  side.front_ = !front_;
  return side;
}

Bsdf Bsdf::other_side() const {
  Bsdf side;
  side.frame_ = {frame_.x, -frame_.y, -frame_.z};
  side.geometric_normal_ = -geometric_normal_;
  side.front_ = !front_;
  side.diffuse_ = through_;
  return side;
}

Rgb Bsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
  Vec3 o, i;
  if (!above(wo, wi, o, i)) return transmits_diffusely() && across(wo, wi) ? through_ / kPi : Rgb(0);
  return base_value(o, i) + lobe_value(o, i);
}

Rgb Bsdf::evaluate_gloss(const Vec3& wo, const Vec3& wi) const {
  Vec3 o, i;
  if (!has_gloss() || !above(wo, wi, o, i)) return Rgb(0);
  Rgb value = lobe_value(o, i);
  if (uneven_base()) value += base_value(o, i) - diffuse_ / kPi;
  return value;
}

Bsdf::Choice Bsdf::choice(const Vec3& o, const BsdfSample branches[2], int count) const {
  Choice p;
  p.diffuse = luminance(diffuse_);
  if (coated_) {
    p.diffuse *= coat_transmittance(o) / coat_mean_;  // diffuse_ / base_ is coat_mean_^2
  }
  if (rough_base_.rough()) p.diffuse = luminance(rough_base_.albedo(o.z));
  p.gloss = lobe_albedo(o.z);
  p.through = luminance(through_);
  for (int b = 0; b < count; ++b) p.delta[b] = luminance(branches[b].weight);
  const float sum = p.diffuse + p.gloss + p.through + p.delta[0] + p.delta[1];
  if (!(sum > 0)) return {};
  p.diffuse /= sum, p.gloss /= sum, p.through /= sum, p.delta[0] /= sum, p.delta[1] /= sum;
  return p;
}

float Bsdf::density(const Vec3& wo, const Vec3& wi) const {
  Vec3 o, i;
  const bool reflects = above(wo, wi, o, i);
  if (!reflects && !(transmits_diffusely() && across(wo, wi))) return 0;
  if (!(o.z > 0)) return turned().density(wo, wi);
  if (lobe_ == Lobe::none && !has_specular() && !transmits_diffusely())
    return has_diffuse() ? i.z / kPi : 0.f;
  BsdfSample branches[2];
  // Choices weigh flux, so that luminance and photons share one density.
  const Choice p = choice(o, branches, specular_branches(wo, branches, TransportMode::flux));
  if (!reflects) return p.through * -i.z / kPi;
  float density = p.diffuse * i.z / kPi;
  if (p.gloss > 0) density += p.gloss * lobe_density(o, i);
  return density;
}

float Bsdf::flux_correction(const Vec3& wo, const Vec3& wi) const {
  if (frame_.z == geometric_normal_) return 1;
  const float ratio = std::fabs(glm::dot(wo, frame_.z) * glm::dot(wi, geometric_normal_)) /
                      std::fabs(glm::dot(wo, geometric_normal_) * glm::dot(wi, frame_.z));
  return std::isfinite(ratio) ? ratio : 0.f;
}

bool Bsdf::sample_lambert(const Vec3& wo, const Vec2& u, BsdfSample& result, TransportMode mode) const {
  if (!has_diffuse() || !(glm::dot(wo, frame_.z) > 0) || !(glm::dot(wo, geometric_normal_) > 0)) return false;
  const Vec3 i = sample_cosine_hemisphere(u), wi = frame_.to_world(i);
  if (!(i.z > 0) || !(glm::dot(wi, geometric_normal_) > 0)) return false;
  result.direction = wi;
  result.weight = mode == TransportMode::flux ? flux_correction(wo, wi) * diffuse_ : diffuse_;
  result.density = i.z / kPi;
  result.specular = result.transmitted = false;
  return true;
}

bool Bsdf::sample(const Vec3& wo, float u_lobe, const Vec2& u, BsdfSample& result, TransportMode mode) const {
  if (lobe_ == Lobe::none && !has_specular() && !uneven_base() && !transmits_diffusely())
    return sample_lambert(wo, u, result, mode);
  const Vec3 o = frame_.to_local(wo);
  if (!(o.z > 0) || !(glm::dot(wo, geometric_normal_) > 0)) return false;
  BsdfSample branches[2];
  const int count = specular_branches(wo, branches, TransportMode::flux);
  const Choice p = choice(o, branches, count);
  const float reflecting = p.diffuse + p.gloss;
  if (p.through > 0 && u_lobe >= reflecting && (count == 0 || u_lobe < reflecting + p.through)) {
    const Vec3 local = sample_cosine_hemisphere(u), wi = frame_.to_world({local.x, local.y, -local.z});
    if (!(local.z > 0) || !across(wo, wi)) return false;
    result = BsdfSample();
    result.direction = wi, result.transmitted = true;
    result.weight = through_ / p.through, result.density = p.through * local.z / kPi;
    if (mode == TransportMode::flux) result.weight *= flux_correction(wo, wi);
    return true;
  }
  const float beyond = u_lobe - (reflecting + p.through);
  if (count > 0 && beyond >= 0) {
    const int b = count == 2 && beyond >= p.delta[0] ? 1 : 0;
    if (!(p.delta[b] > 0)) return false;
    if (mode == TransportMode::radiance) specular_branches(wo, branches, mode);
    result = branches[b];
    result.weight /= p.delta[b];
    if (mode == TransportMode::flux && !result.straight)
      result.weight *= flux_correction(wo, result.direction);
    return true;
  }
  Vec3 i;
  if (p.gloss == 0 || u_lobe < p.diffuse) {
    if (!(p.diffuse > 0)) return false;
    i = sample_cosine_hemisphere(u);
  } else if (!sample_lobe(o, u, i)) {
    return false;
  }
  const Vec3 wi = frame_.to_world(i);
  if (!(i.z > 0) || !(glm::dot(wi, geometric_normal_) > 0)) return false;
  result = BsdfSample();
  result.direction = wi;
  result.density = p.diffuse * i.z / kPi;
  if (p.gloss > 0) result.density += p.gloss * lobe_density(o, i);
  if (!(result.density > 0)) return false;
  result.weight = (base_value(o, i) + lobe_value(o, i)) * (i.z / result.density);
  if (mode == TransportMode::flux) result.weight *= flux_correction(wo, wi);
  return true;
}

/// Of light that meets the surface at o, the pane's own.
PaneLayer Bsdf::layer(const Vec3& o) const {
  PaneLayer layer;
  if (delta_ == Delta::thin) {
    layer = pane_layer(o.z, ior_, inside_);
    const Rgb factor = curve_ ? sheet_ * curve_->at(o.z) : sheet_;
    for (int k = 0; k < 2; ++k) {
      // A curve says nothing of the reflectance: as glass of this index, as far as the curve leaves it.
      if (curve_) layer.back[k] = glm::min(layer.back[k], Rgb(1) - factor);
      layer.pass[k] = curve_ ? factor : layer.pass[k] * factor;
      layer.back_behind[k] = layer.back[k];
    }
  } else if (max_component(sheet_) > 0 && delta_ != Delta::dielectric) {
    const bool exact = coat_f90_ == 1;
    const PaneLayer clear = exact ? pane_layer(o.z, std::max(ior_, 1.f), Rgb(1)) : PaneLayer();
    const float f = coat_f0_ + (coat_f90_ - coat_f0_) * schlick_power(o.z);
    for (int k = 0; k < 2; ++k) {
      const Rgb pane = exact ? clear.pass[k] : Rgb((1 - f) / (1 + f));
      layer.pass[k] = sheet_ * ((1 - pane_share_) * coat_transmittance(o) + pane_share_ * pane);
      if (delta_ != Delta::schlick) continue;
      // Of its own reflectance, a face's, the share that is a pane has two of.
      layer.back[k] = schlick(o.z) / std::max(coverage_, 1e-6f) + pane_share_ * ((Rgb(1) - pane) - f);
      layer.back[k] = layer.back_behind[k] = glm::max(layer.back[k], Rgb(0));
    }
  }
  if (coverage_ < 1)
    for (int k = 0; k < 2; ++k) {
      layer.pass[k] = Rgb(1 - coverage_) + coverage_ * layer.pass[k];
      layer.back[k] *= coverage_, layer.back_behind[k] *= coverage_;
    }
  return layer;
}

PaneLayer Bsdf::pane(const Vec3& wo) const {
  const Vec3 o = frame_.to_local(wo);
  if (!passes_straight() || !(o.z > 0) || !(glm::dot(wo, geometric_normal_) > 0)) return {};
  return packed_ ? pack_ : layer(o);
}

PaneLayer Bsdf::plate(const Vec3& wo, float thickness_m) const {
  const float cosine = glm::dot(wo, frame_.z);
  if (!(cosine > 0)) return {};
  PaneLayer layer = pane_layer(cosine, std::max(ior_, 1.f), left_after(absorption_per_m_, thickness_m));
  for (Rgb& pass : layer.pass) pass *= sheet_ * sheet_;  // the tint of either face
  return layer;
}

void Bsdf::replace_pane(const PaneLayer& pack) {
  packed_ = true, pack_ = pack;
  if (delta_ == Delta::dielectric) delta_ = Delta::thin;
}

float Bsdf::total_reflection(const Vec3& wo) const {
  if (delta_ != Delta::dielectric) return 0;
  const float eta = front_ ? ior_ : 1 / ior_;
  float cos_t;
  const bool total = eta < 1 && fresnel_dielectric(std::fabs(glm::dot(wo, frame_.z)), eta, cos_t) >= 1;
  return total ? 1 / eta : 0;
}

int Bsdf::specular_branches(const Vec3& wo, BsdfSample branches[2], TransportMode mode) const {
  if (!has_specular()) return 0;
  const Vec3 o = frame_.to_local(wo);
  if (!(o.z > 0) || !(glm::dot(wo, geometric_normal_) > 0)) return 0;
  int count = 0;
  const auto add = [&](const Vec3& local, const Rgb& weight, bool transmitted) {
    const Vec3 direction = glm::normalize(frame_.to_world(local));
    if (!(max_component(weight) > 0) || (glm::dot(direction, geometric_normal_) < 0) != transmitted) return;
    branches[count++] = {direction, weight, 0, true, transmitted, false};
  };
  const Vec3 reflected(-o.x, -o.y, o.z);
  const bool straight = passes_straight();
  const PaneLayer pane = straight ? packed_ ? pack_ : layer(o) : PaneLayer();
  switch (delta_) {
    case Delta::none:
    case Delta::sheet:
      break;
    case Delta::mirror:
      add(reflected, specular_, false);
      break;
    case Delta::schlick:
      add(reflected, max_component(sheet_) > 0 ? pane.reflectance() : schlick(o.z), false);
      break;
    case Delta::dielectric: {
      const float eta = front_ ? ior_ : 1 / ior_;
      float cos_t;
      const float f = fresnel_dielectric(o.z, eta, cos_t);
      add(reflected, travelled_ * f, false);
      const float scale = mode == TransportMode::radiance ? 1 / (eta * eta) : 1.f;
      add({-o.x / eta, -o.y / eta, -cos_t}, travelled_ * sheet_ * ((1 - f) * scale), true);
      break;
    }
    case Delta::thin:
      add(reflected, pane.reflectance(), false);
      break;
  }
  if (const Rgb through = pane.transmittance(); straight && max_component(through) > 0)
    branches[count++] = {-wo, through, 0, true, true, true};
  return count;
}

float Bsdf::broad_share(const Vec3& o) const {
  if (!uneven_base()) return 0;
  if (lobe_ == Lobe::none) return 1;
  const float towards = coat_transmittance(o);
  // The coat's change: towards the eye, and by where light comes from.
  const float change =
      looked_from_ ? 0.04f * towards : coat_mean_ * (std::fabs(towards - coat_mean_) + 0.04f);
  const float broad = luminance(base_) * change;
  // Never more than half, as a narrow lobe sees more contrast than a broad one.
  return std::clamp(broad / (broad + luminance(schlick(o.z))), 0.1f, 0.5f);
}

void Bsdf::look_from(const Vec3& wo) {
  const Vec3 o = frame_.to_local(wo);
  if (!uneven_base() || !(o.z > 0)) return;
  diffuse_ = rough_base_.rough() ? rough_base_.albedo(o.z) : base_ * (coat_mean_ * coat_transmittance(o));
  looked_from_ = true;
}

float Bsdf::density_gloss(const Vec3& wo, const Vec3& wi) const {
  Vec3 o, i;
  if (!has_gloss() || !above(wo, wi, o, i)) return 0;
  const float broad = broad_share(o);
  return broad * i.z / kPi + (1 - broad) * lobe_density(o, i);
}

bool Bsdf::sample_gloss(const Vec3& wo, const Vec2& u, BsdfSample& result) const {
  const Vec3 o = frame_.to_local(wo);
  if (!has_gloss() || !(o.z > 0) || !(glm::dot(wo, geometric_normal_) > 0)) return false;
  const float broad = broad_share(o);
  Vec3 i;
  if (u.x < broad) {
    i = sample_cosine_hemisphere({u.x / broad, u.y});
  } else if (!sample_lobe(o, {std::min((u.x - broad) / (1 - broad), kBelowOne), u.y}, i)) {
    return false;
  }
  const Vec3 wi = frame_.to_world(i);
  if (!(i.z > 0) || !(glm::dot(wi, geometric_normal_) > 0)) return false;
  result = BsdfSample();
  result.direction = wi;
  result.density = broad * i.z / kPi + (1 - broad) * lobe_density(o, i);
  if (!(result.density > 0)) return false;
  Rgb value = lobe_value(o, i);
  if (uneven_base()) value += base_value(o, i) - diffuse_ / kPi;
  result.weight = value * (i.z / result.density);
  return true;
}

}  // namespace phos::inline scene
