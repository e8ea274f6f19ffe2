// Whether radiance records or rays compute the gloss of surfaces, per material and direction.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/counters.h"
#include "hsh/rotation.h"
#include "radiance/brdf/table.h"

namespace phos {
class Options;
}

namespace phos::inline scene {
struct Scene;
struct SurfacePoint;
}  // namespace phos::inline scene

namespace phos::inline radiance {

enum class GlossBy : unsigned char {
  traced,     ///< rays
  cached,     ///< radiance records, also for lobes that their bands blur
  automatic,  ///< records where a lobe's bands hold it, rays elsewhere
};
void declare_options(Options& options, GlossBy& by);

/// What was chosen for a glossy material, and why.
struct GlossChoice {
  std::uint32_t material = 0;
  int order = 0;            ///< of its radiance records; 0: none, its gloss is traced
  double traced_share = 1;  ///< of the directions above the horizon
  std::string why;          ///< "orders 6 to 9 hold 95 % of every lobe"
};

/// The glossy part of f cos of one point towards one viewer, as HSH.
struct GlossLobe {
  Frame frame;                      ///< make_frame(point.smooth_normal), the frame of records there
  int order = 0;                    ///< its bands
  std::vector<float> coefficients;  ///< [order^2][3], 1/sqrt(sr)
  /// 1/sr: light that leaves is at least this times the irradiance; less is ringing. Below 0 under a coat,
  /// which takes light from the Lambert part.
  Rgb least{0};
};

/// Tables of the materials whose gloss reads radiance records. Const, usable from any thread.
class GlossTables {
 public:
  GlossTables() = default;  ///< every lobe is traced
  /// `tables`: of this scene (a .brdf file); materials that it lacks are projected here, and so are, with
  /// GlossBy::cached, materials of which it leaves directions to rays (with bands cut off at max_order).
  /// Events as of project_brdf. Throws Error(usage) for an order out of range.
  GlossTables(const Scene& scene, std::span<const BrdfTable> tables, GlossBy by,
              const BrdfTableOptions& options, Counters& counters);

  /// Bands of the records that a material wants; 0: it wants none.
  int order(std::uint32_t material) const;
  /// All different ones but 0, ascending.
  std::vector<int> orders() const;
  /// Per glossy material.
  const std::vector<GlossChoice>& choices() const { return choices_; }
  const BrdfTable* table(std::uint32_t material) const;  ///< null: traced in every direction
  /// GlossLobe::least of a material that has a table.
  const Rgb& least(std::uint32_t material) const {
    return least_[static_cast<std::size_t>(table_of_[material])];
  }
  /// The lobe towards wo (unit, world). False: it is traced (the table says so, there is none, the viewer is
  /// below the shading normal's horizon, or that normal below the smooth one's). Where a normal map turns the
  /// shading normal away from the smooth one, the lobe is rotated.
  bool lobe(const SurfacePoint& point, const Vec3& wo, GlossLobe& lobe) const;

 private:
  std::vector<BrdfTable> tables_;
  std::vector<Rgb> least_;              // of each table, 1/sr
  std::vector<std::int32_t> table_of_;  // per material, -1: none
  std::vector<GlossChoice> choices_;
  std::vector<HshRotator> turns_;  // of orders 1, 2, ...
};

}  // namespace phos::inline radiance
