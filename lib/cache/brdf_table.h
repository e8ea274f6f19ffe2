// Glossy reflection as hemispherical harmonics: for each direction of view, the coefficients of the
// cosine-weighted lobe, and the order that it needs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/vector.h"
#include "file/container.h"
#include "scene/scene.h"

namespace phos {

struct BrdfTableOptions {
  double error = 0.05;           ///< energy of the lobe that a direction's order may leave out, relative
  std::int64_t max_order = 10;   ///< a direction that needs more is marked "trace"
  std::int64_t resolution = 32;  ///< of the parabolic grid, and rows of an isotropic table
};

/// c_i(wo) = integral of (glossy part of f)(wo, wi) cos(theta_i) H_i(wi) dwi, local frame of the surface,
/// RGB; no Lambert part. An isotropic table holds wo = (sin t, 0, cos t) alone (its sin coefficients are 0)
/// and is turned about z; others hold the parabolic map of all wo (FORMULAS 5).
struct BrdfTable {
  std::string material;
  std::uint32_t material_index = 0;
  bool isotropic = true;
  int resolution = 32;
  int order = 0;                     ///< the highest of all directions; 0: every direction is traced
  std::vector<std::uint8_t> orders;  ///< per entry: n of HSH; 0 = trace it
  std::vector<float> error;          ///< per entry: energy left out, relative
  std::vector<float> coefficients;   ///< [entry][order^2][3]
  std::size_t entries() const { return orders.size(); }
};

/// Projects the glossy part of one material (its textures at their mean; said in `note` of the report).
/// Parallel.
BrdfTable project_brdf(const Scene& scene, std::uint32_t material, const BrdfTableOptions& options,
                       Counters& counters);

/// Reads the table: interpolated in wo, bilinear. Const, usable from any thread.
class BrdfLookup {
 public:
  explicit BrdfLookup(const BrdfTable& table);
  /// Order towards wo (local, unit, z > 0), the largest of the entries around; 0: trace it.
  int order(const Vec3& wo) const;
  /// Luminance towards wo: sum over i of c_i(wo) L_i; incident RGB coefficients [light_order^2][3], cd/m2.
  /// Bands that one side lacks count nothing. Not clamped: may be slightly negative by ringing.
  Rgb outgoing(const Vec3& wo, std::span<const float> incident) const;

 private:
  const BrdfTable& table_;
};

/// The `.brdf` file. No table: an empty file ("nothing glossy here").
std::vector<BrdfTable> read_brdf(const Container& file);

}  // namespace phos
