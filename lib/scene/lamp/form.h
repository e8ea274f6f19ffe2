// Light of lamps with nothing in its way, in closed form.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"
#include "scene/lamp/panel.h"

namespace phos::inline scene {

/// Projected solid angle of a plane polygon seen from the origin by a surface that faces n (unit), sr:
/// pi times the form factor (Lambert 1760; Arvo 1995, eq. 2.10), the part below the horizon of n cut off.
/// Corners are counter-clockwise as seen from the side that counts as positive; negative seen from behind. 0
/// for a polygon through the origin.
double projected_solid_angle(std::span<const DVec3> corners, const DVec3& n);

/// Unoccluded irradiance from an area light.
class LampForm {
 public:
  explicit LampForm(const LampPanel& panel);
  LampForm(const Scene& scene, const Light& light) : LampForm(LampPanel(scene, light)) {}
  /// Is there a closed form worth its time: an area light of one luminance and few patches? Corners of a
  /// lamp that hide each other are left to the test of visibility.
  bool closed() const { return !polygon_.empty(); }
  /// cd/m2
  const Rgb& luminance() const { return luminance_; }
  /// Projected solid angle, sr: irradiance over luminance, of the part that turns its shining side to p.
  float projected_solid_angle(const Vec3& p, const Vec3& n) const;

 private:
  struct Polygon {
    DVec3 corner[4], normal;
    unsigned corners;
  };
  std::vector<Polygon> polygon_;
  Rgb luminance_{0};
  bool double_sided_ = false;
};

}  // namespace phos::inline scene
