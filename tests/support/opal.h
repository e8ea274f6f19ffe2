// Sheets that pass light diffusely, with their closed forms.
#pragma once

#include "support/scenes.h"

namespace phos::test {

/// Lambert's on both sides: reflects `kd`, passes `kt`.
inline std::uint32_t add_opal(Scene& scene, float kd, float kt) {
  const std::uint32_t material = add_lambert(scene, "opal", kd);
  scene.material[material].diffuse_transmission = 1;
  scene.material[material].diffuse_transmission_colour = Rgb(kt);
  return material;
}

/// A sheet of 2 x 2 m, 1.5 m over a black floor, a point lamp 1 m over the sheet's middle. What the sheet
/// sends down: L = kt I h / (pi (h2 + r2)^1.5), E = int L cos2 / d2 dA (docs/methods.md#g3-5).
struct OpalUnderALamp {
  static constexpr float kHeight = 1.5f, kIntensity_cd = 1000, kKt = 0.5f;
  Scene scene;

  explicit OpalUnderALamp(float kd = 0, float floor_albedo = 0) {
    begin_instance(scene, "floor", add_lambert(scene, "floor", floor_albedo));
    add_quad(scene, {-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
    begin_instance(scene, "sheet", add_opal(scene, kd, kKt));
    add_quad(scene, {-1, kHeight, -1}, {0, 0, 2}, {2, 0, 0});
    add_point_light(scene, {0, kHeight + 1, 0}, kIntensity_cd);
    finalize(scene);
  }

  static double luminance_below(double x, double z) {
    return static_cast<double>(kKt) / std::numbers::pi *
           point_over_plane_lx(static_cast<double>(kIntensity_cd), 1, std::hypot(x, z));
  }
  /// On the floor at (x, 0), from the sheet alone.
  static double floor_lx(double at) {
    constexpr int kCells = 400;
    constexpr double kSide = 2.0 / kCells, kH = static_cast<double>(kHeight);
    double sum = 0;
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j) {
        const double x = -1 + (i + 0.5) * kSide, z = -1 + (j + 0.5) * kSide;
        const double d2 = (x - at) * (x - at) + z * z + kH * kH;
        sum += luminance_below(x, z) * kH * kH / (d2 * d2) * kSide * kSide;
      }
    return sum;
  }
};

/// A room of black walls that shine with 100 cd/m2, and a sheet in it that absorbs nothing: pi L everywhere.
struct OpalFurnace {
  static constexpr double kIrradiance_lx = 100 * std::numbers::pi;
  Scene scene;

  OpalFurnace() {
    begin_instance(scene, "room", add_lambert(scene, "room", 0, 100));
    add_room(scene, {-1, 0, -1}, {1, 2, 1});
    begin_instance(scene, "sheet", add_opal(scene, 0.4f, 0.6f));
    add_quad(scene, {-0.9f, 0.7f, -0.9f}, {0, 0, 1.8f}, {1.8f, 0, 0});
    finalize(scene);
  }
  /// On the sheet's sides, below and above it.
  static std::vector<Check> places() {
    return {{{0.2f, 0.7f, 0.1f}, {0, 1, 0}},
            {{0.2f, 0.7f, 0.1f}, {0, -1, 0}},
            {{0.1f, 0.3f, 0}, {0, 1, 0}},
            {{0.1f, 1.5f, 0}, {0, -1, 0}}};
  }
};

}  // namespace phos::test
