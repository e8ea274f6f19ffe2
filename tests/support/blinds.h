// A room whose window has a blind before it.
#pragma once

#include <cmath>
#include <vector>

#include "support/daylight.h"

namespace phos::test {

/// Of a window of 2 x 1.5 m, x from 1 to 3, y from 0.9 to 2.4, in the wall z = 0 of a black room of 4 x 2.7 x
/// 5 m: flat slats without thickness, as deep as the figure says, the middles 6 cm behind the wall. Their
/// inner edges are higher than the outer ones by `tilt_rad`.
struct BlindRoom {
  int slats = 20;
  float depth_m = 0.06f, tilt_rad = 0.5f;

  struct Edges {
    DVec3 outer, inner;  // at x = 1
  };
  Edges slat(int k) const {
    const DVec3 middle(1, 0.9 + 1.5 * (k + 0.5) / slats, 0.06);
    const double half = 0.5 * static_cast<double>(depth_m), a = static_cast<double>(tilt_rad);
    const DVec3 way(0, half * std::sin(a), half * std::cos(a));
    return {middle - way, middle + way};
  }
  /// Is the line free of slats, and through the window?
  bool passes(const DVec3& from, const DVec3& direction) const {
    const DVec3 at = from - from.z / direction.z * direction;
    if (!(at.x > 1 && at.x < 3 && at.y > 0.9 && at.y < 2.4)) return false;
    for (int k = 0; k < slats; ++k) {
      const Edges e = slat(k);
      // In the plane x = 0: on different sides of the line, the ends of a slat.
      const auto side = [&](const DVec3& p) {
        return direction.z * (p.y - from.y) - direction.y * (p.z - from.z);
      };
      if (side(e.outer) * side(e.inner) > 0) continue;
      const double s = side(e.outer) / (side(e.outer) - side(e.inner));
      const DVec3 p = e.outer + s * (e.inner - e.outer);
      const double x = from.x + (p.z - from.z) / direction.z * direction.x;
      if (x > 1 && x < 3) return false;
    }
    return true;
  }
  Scene scene(bool window = true) const {
    Scene scene;
    const std::uint32_t black = add_lambert(scene, "black", 0);
    begin_instance(scene, "room", black);
    add_quad(scene, {0, 0, 0}, {0, 0, 5}, {4, 0, 0});
    add_quad(scene, {0, 2.7f, 0}, {4, 0, 0}, {0, 0, 5});
    add_quad(scene, {0, 0, 0}, {0, 2.7f, 0}, {0, 0, 5});
    add_quad(scene, {4, 0, 0}, {0, 0, 5}, {0, 2.7f, 0});
    add_quad(scene, {0, 0, 5}, {0, 2.7f, 0}, {4, 0, 0});
    add_wall_with_hole(scene, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2.7f, 0.9f, 2.4f}, {4, 1, 3});
    if (!window) add_quad(scene, {1, 0.9f, 0}, {2, 0, 0}, {0, 1.5f, 0});
    begin_instance(scene, "blind", black);
    for (int k = 0; k < slats; ++k) {
      const Edges e = slat(k);
      add_quad(scene, Vec3(e.outer), {2, 0, 0}, Vec3(e.inner - e.outer));
    }
    return scene;
  }
};

}  // namespace phos::test
