// Illuminance by the density of light paths about a sensor, looked at within many radii at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "reference/moments.h"

namespace phos::inline reference {

/// Radii fall by sqrt(2), from the largest of a disc.
inline constexpr std::size_t kDiscRadii = 24;

/// What one pass of light paths brings to the discs of all radii about a sensor.
struct DiscPass {
  std::array<DVec3, kDiscRadii> lux{};            ///< flux within a radius over its area and the paths
  std::array<std::uint32_t, kDiscRadii> paths{};  ///< that crossed there
};

/// All light of a sensor over the passes, of its discs within one radius or another.
class DiscLight {
 public:
  /// Without a disc.
  DiscLight() : rows_(1) {}
  /// `area_m2` of the discs; those without area are not looked at.
  explicit DiscLight(const std::array<double, kDiscRadii>& area_m2);

  /// `rest`: the sensor's light but for its disc's, of the same pass, lx.
  void add(const DVec3& rest, const DiscPass& disc);

  struct Estimate {
    DVec3 lux{0};    ///< of the rest and the disc
    DVec3 error{0};  ///< standard error with the estimated bias of the disc
    double illuminance_lx = 0, stderr_lx = 0;
  };
  /// By the largest radius within which the disc's light agrees with all smaller discs, to within their noise
  /// (Lepski's rule): where noise and bias are alike. The bias stated is the largest difference from discs of
  /// 1/2 to 1/16 of its area, as far as it is more than noise. An edge of light that is nearer than the
  /// distance between paths is not seen.
  Estimate estimate() const;

 private:
  static constexpr std::size_t kLuminance = 3;
  double noise_lx(std::size_t radius, double paths) const;
  double expected_paths(std::size_t of, std::size_t within) const;
  std::size_t chosen() const;

  struct Row {  // of a radius; by channel and luminance
    double area_m2 = 0;
    Moments disc[4], all[4];
    std::uint64_t paths = 0;
  };
  std::vector<Row> rows_;
};

}  // namespace phos::inline reference
