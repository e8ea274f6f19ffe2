// Openings through which light from infinitely far away is aimed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/vector.h"
#include "scene/opening/portal.h"
#include "scene/sky/environment.h"

namespace phos::inline photon {

/// Aims lines of light at portals. A line is a direction and a place on a plane across it; its density is per
/// sr and m2 of that plane. Lines that meet several portals are drawn by each of them: crossings() is how
/// many.
class Portals {
 public:
  /// Directions in proportion to their luminance times the portals' area seen from there.
  Portals(std::span<const Portal> pieces, const Environment& light);

  /// Flux of the environment's light through all portals, were nothing in its way, lm (luminance of RGB),
  /// roughly.
  double flux_lm() const { return flux_lm_; }

  /// Where the light comes from, unit.
  Vec3 sample_direction(const Vec2& u) const { return guide_->sample_flux(u).direction; }
  /// A point on a portal, by the area of each that light in `direction` sees. False: it sees none.
  bool sample_point(const Vec3& direction, float u_piece, const Vec2& u, Vec3& point) const;
  /// Density with which a line through `point` is aimed: sr^-1 m^-2.
  double density(const Vec3& point, const Vec3& direction) const;

 private:
  /// Area of a piece across a direction of travel, m2.
  double seen_m2(std::size_t piece, const DVec3& direction) const;
  double seen_m2(const Vec3& direction) const;
  int crossings(const Vec3& point, const Vec3& direction) const;

  std::vector<Portal> pieces_;
  std::vector<DVec3> area_m2_;        // vectors, by winding or inwards
  std::optional<Environment> guide_;  // light times the visible area of the portals from there
  double flux_lm_ = 0;
};

}  // namespace phos::inline photon
