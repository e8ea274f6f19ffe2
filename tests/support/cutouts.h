// Lamps of which the alpha of their material leaves only a part.
#pragma once

#include "support/scenes.h"

namespace phos::test {

/// rectangle_light_parallel() with an alpha of 1 on the half with x < a / 2, and of `other` on the rest of
/// the lamp (a texture of two texels). The light comes from both halves. The share of the second half that
/// is there is 0 under a mask with `other` below 0.5, and `other` under blending.
inline AnalyticScene half_cut_out(Material::Alpha mode, float other) {
  constexpr float kA = 2, kB = 3, kC = 1.5f;
  AnalyticScene s = rectangle_light_parallel(kA, kB, kC);
  const AnalyticScene half = rectangle_light_parallel(kA / 2, kB, kC), whole = s;
  s.name = text("lamp with alpha ", other, " on a half");
  Texture texture;
  texture.width = 2, texture.height = 1, texture.nearest = true;
  texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
  texture.texels = {Vec4(1), Vec4(1, 1, 1, other)};
  s.scene.texture.push_back(texture);
  Material& lamp = s.scene.material[1];
  lamp.alpha_mode = mode, lamp.base_colour.texture = 0;
  for (const Vec3& p : s.scene.position) s.scene.uv0.emplace_back(p.x / kA, p.z / kB);
  finalize(s.scene);
  const bool hole = mode == Material::Alpha::mask && other < lamp.alpha_cutoff;
  const double share = mode == Material::Alpha::blend ? double(other) : hole ? 0 : 1;
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    const double first = half.irradiance_lx(p, n);
    return first + share * (whole.irradiance_lx(p, n) - first);
  };
  s.checks.clear();
  for (const Vec2& x : {Vec2{0, 0}, Vec2{1, 1.5f}, Vec2{1.5f, 1.5f}, Vec2{2.45f, 1.5f}, Vec2{-0.75f, -0.75f}})
    s.check_at({x.x, 0, x.y}, {0, 1, 0});
  return s;
}

/// Mask and blending, with nothing, a part and all of the second half there.
inline std::vector<AnalyticScene> cut_out_lamps() {
  using Alpha = Material::Alpha;
  return {half_cut_out(Alpha::mask, 0), half_cut_out(Alpha::mask, 0.6f), half_cut_out(Alpha::blend, 0),
          half_cut_out(Alpha::blend, 0.4f), half_cut_out(Alpha::opaque, 0)};
}

}  // namespace phos::test
