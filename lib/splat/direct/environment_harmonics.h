// Light of an environment map by harmonics, as from an open place: no rays, no noise, no shadows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hsh/conversion.h"
#include "radiance/brdf/table.h"
#include "scene/material/bsdf.h"
#include "scene/rays.h"
#include "scene/sky/environment.h"

namespace phos::inline splat {

/// How the environment lights the surfaces that the eye sees.
enum class EnvironmentBy : unsigned char {
  traced,  ///< by rays
  hsh,     ///< by hemispherical harmonics; the map has bands enough for them
  sh,      ///< by spherical harmonics, to compare with
};

/// SH coefficients of the map, RGB side by side [order^2][3], cd/m2 sqrt(sr), in environment_frame(). Exact
/// for a luminance that is constant over each texel. Throws Error(usage) for an order outside 1 ..
/// HarmonicBasis::kMaxOrder. Parallel; the same numbers on any number of threads.
std::vector<float> project_environment(const Environment& map, int order);
/// +Y of the world is z.
inline Frame environment_frame() { return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}; }

/// The map's harmonics, rotated to the frame of a point, and combined with its reflection by a dot product
/// (Gautron et al. 2004, section 6). Const, usable from any thread.
class EnvironmentHarmonics {
 public:
  /// hsh: reflection of the first `order` bands of HSH, light of SH of twice as many, which leaves 10 % more
  /// error than infinitely many would. sh: light of the first `order` bands of SH, and all bands of HSH that
  /// the tables have, so that they stand for the reflection's SH. Materials without a table are projected
  /// here, to that order (phos-brdf's default error). Throws Error(usage) for an order outside 1 .. 30.
  EnvironmentHarmonics(const Scene& scene, const Environment& map, EnvironmentBy by, int order,
                       std::span<const BrdfTable> tables);

  struct Light {
    Rgb irradiance_lx{0};  ///< on the shading normal's side
    Rgb gloss{0};          ///< cd/m2 towards the viewer, through the glossy lobes; below zero under a coat
    bool clamped = false;  ///< ringing had made the light darker than black
  };
  /// Nothing where it has to be traced: the tables say so, or the viewer is below the shading normal's
  /// horizon.
  std::optional<Light> light(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo) const;

  /// Of an unoccluded surface, unit normal, lx.
  Rgb irradiance_lx(const Vec3& normal) const;
  /// HSH coefficients of the light in a frame, RGB side by side.
  std::vector<float> incident(const Frame& frame) const;

 private:
  const BrdfTable* table_of(std::uint32_t material) const;

  std::uint64_t id_;  // no two of them have the same
  int sh_order_;
  std::vector<BrdfTable> tables_;
  std::vector<std::int32_t> table_of_;  // per material, -1: none
  std::vector<float> map_, lambert_;    // SH of the luminance, and of the irradiance as a function of normals
  std::optional<HarmonicConversion> to_hsh_;
};

}  // namespace phos::inline splat
