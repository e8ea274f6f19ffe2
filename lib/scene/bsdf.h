// Reflection and transmission at a point.
#pragma once

#include "core/vector.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos {

struct BsdfSample {
  Vec3 direction{0};  ///< world, unit, leaving the surface
  Rgb weight{0};      ///< f cos / density (the density includes the choice of lobe)
  float density = 0;  ///< per sr over all non-specular lobes; 0 for a specular (delta) sample
  bool specular = false;
  bool transmitted = false;
};

/// The material at one point, textures looked up. `wo` and `wi` are unit, world space, and point away from the surface.
class Bsdf {
 public:
  Bsdf(const Scene& scene, const SurfacePoint& point);

  /// f(wo, wi) in 1/sr, cosine NOT included, specular (delta) lobes not included; 0 for wi below the surface of a
  /// reflector. Reciprocal.
  Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
  /// Density of sample() for wi, per sr; 0 where evaluate is 0 for lack of a lobe.
  float density(const Vec3& wo, const Vec3& wi) const;
  /// Draws a direction. False: absorbed (no reflecting lobe). u_lobe picks the lobe.
  bool sample(const Vec3& wo, float u_lobe, const Vec2& u, BsdfSample& result) const;

  /// Every specular continuation with its weight (reflection and refraction), for deterministic tracing; at most 2.
  int specular_branches(const Vec3& wo, BsdfSample branches[2]) const;

  /// Diffuse reflectance (Lambert part): what an irradiance E is multiplied by, over pi, for outgoing luminance.
  Rgb diffuse_reflectance() const { return diffuse_; }
  bool has_diffuse() const { return max_component(diffuse_) > 0; }
  bool has_specular() const;  ///< delta lobes: mirror, smooth glass
  bool has_gloss() const;     ///< neither diffuse nor delta
  /// evaluate() without the Lambert part.
  Rgb evaluate_gloss(const Vec3& wo, const Vec3& wi) const;
  /// sample()/density() restricted to the glossy lobes.
  bool sample_gloss(const Vec3& wo, const Vec2& u, BsdfSample& result) const;

 private:
  float diffuse_choice(const Vec3& wo) const;
  const Material* material_;
  Frame frame_;
  Vec3 geometric_normal_;
  Rgb diffuse_{0}, specular_{0};  // resolved: kd x texture; ks or f0
  float alpha_x_ = 0, alpha_y_ = 0, ior_ = 1.5f;
  bool front_ = true;
};

}  // namespace phos
