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
class Options;
}

namespace phos::inline radiance {

/// What becomes of a direction whose lobe needs more bands than there may be.
enum class TooSharp : unsigned char {
  trace,  ///< it is marked "trace"
  cut,    ///< its bands are cut off at the highest order: a blurred lobe of the same albedo
};

struct BrdfTableOptions {
  double error = 0.01;           ///< energy of the lobe that a direction's order may leave out, relative
  std::int64_t max_order = 10;   ///< highest order of a direction
  std::int64_t resolution = 32;  ///< of the parabolic grid, and rows of an isotropic table
  TooSharp too_sharp = TooSharp::trace;
};
void declare_options(Options& options, BrdfTableOptions& brdf);

/// c_i(wo) = integral of (glossy part of f)(wo, wi) cos(theta_i) H_i(wi) dwi, local frame of the surface,
/// RGB; no Lambert part. An isotropic table holds wo = (sin t, 0, cos t) alone (its sin coefficients are 0)
/// and is turned about z: row k is tan(t/2) = k / (resolution - 1). Others hold the parabolic map of all wo:
/// entry (row j, column i) of the grid is x/(1+z) = 2 (i + 1/2) / resolution - 1, y/(1+z) in the same way by
/// j (docs/methods.md#j5). Directions at and below the horizon are taken at z = kLeastCosine; entries that no
/// lookup reads are 0.
struct BrdfTable {
  static constexpr float kLeastCosine = 1e-3f;

  std::string material;
  std::uint32_t material_index = 0;
  bool isotropic = true;
  int resolution = 32;
  int order = 0;                     ///< the highest of all directions; 0: every direction is traced
  std::vector<std::uint8_t> orders;  ///< per entry: n of HSH; 0 = trace it
  std::vector<float> error;          ///< per entry: energy left out, relative (by max_order, where traced)
  std::vector<float> coefficients;   ///< [entry][order^2][3], 1/sqrt(sr); 0 beyond the entry's own order
  float albedo = 0;                  ///< greatest over wo and colours, the Lambert part with it
  std::string note;                  ///< the directions that the table leaves out, "" if none

  std::size_t entries() const { return orders.size(); }
  /// wo that an entry stands for.
  Vec3 direction(std::size_t entry) const;
  /// Does an entry stand for a direction above the horizon? The others only serve to interpolate.
  bool inside(std::size_t entry) const;
  /// Can a lookup read an entry?
  bool used(std::size_t entry) const;
};

/// A table in figures; over the directions above the horizon.
struct BrdfSummary {
  int least_order = 0, greatest_order = 0;  ///< of directions that are not traced
  double mean_order = 0;
  double traced_share = 0;                 ///< of the entries
  double mean_error = 0, worst_error = 0;  ///< energy, of directions that are not traced
  std::uint64_t bytes = 0;                 ///< in the file
};
BrdfSummary summarize(const BrdfTable& table);

/// Reads the table: interpolated in wo, bilinear. Const, usable from any thread. Holds a reference.
class BrdfLookup {
 public:
  explicit BrdfLookup(const BrdfTable& table) : table_(table) {}
  /// Order towards wo (local, unit, z > 0), the largest of the entries around; 0: trace it (so as soon as
  /// one of them is traced).
  int order(const Vec3& wo) const;
  /// Luminance towards wo: sum over i of c_i(wo) L_i; incident RGB coefficients [light_order^2][3], cd/m2.
  /// Bands that one side lacks count nothing. Not clamped: may be slightly negative by ringing. Where
  /// order() is 0 it means nothing.
  Rgb outgoing(const Vec3& wo, std::span<const float> incident) const;
  /// c_i(wo), RGB side by side, [order^2][3] of the table's order.
  std::vector<float> coefficients(const Vec3& wo) const;
  /// Sets `out` to the c_i(wo) of order(wo), which it returns; 0: trace it, `out` is empty.
  int coefficients(const Vec3& wo, std::vector<float>& out) const;

 private:
  struct Around;
  Around around(const Vec3& wo) const;
  int order(const Around& around) const;
  void blend(const Around& around, const Vec3& wo, int order, std::vector<float>& out) const;
  const BrdfTable& table_;
};

}  // namespace phos::inline radiance
