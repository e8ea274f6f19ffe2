// A disc about a sensor, and the light paths that cross it.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "reference/disc_light.h"
#include "reference/light_path.h"

namespace phos::inline reference {

/// The part of a sensor's plane that it sees within a radius: sectors of a disc, each up to the first surface
/// in its way. Illuminance there is the flux that crosses the part from the front over its area, without a
/// cosine. Only light counts that came by way of a mirror, glass or sharp gloss.
class SensorDisc {
 public:
  /// Looks how far the plane is free, up to `most_m`: along both sides and the middle of each sector.
  SensorDisc(const RayScene& rays, const SurfacePoint& sensor, float most_m);

  /// Area of the part within radius_m, m2.
  double area_m2(double radius_m) const;
  float most_m() const { return most_m_; }

  struct Crossing {
    double aside_m = 0;     ///< from the sensor
    double reach_m = 0;     ///< how far the plane is free there
    double cosine = 1;      ///< of the angle of incidence
    double distance_m = 0;  ///< along the path, since the reflection
  };
  /// False where the segment does not cross the part within most_m().
  bool cross(const SharpSegment& segment, Crossing& crossing) const;

  double radius_m(std::size_t i) const {
    return static_cast<double>(most_m_) * std::exp2(-0.5 * static_cast<double>(i));
  }
  std::array<double, kDiscRadii> areas_m2() const;

  /// The light that `paths` bring to the discs of all radii, weighted against the light that eye paths find
  /// (BidirectionalTracer::irradiance() with the same `eta`): a weight for each path, whatever the radius.
  DiscPass light(const LightPaths& paths, double eta, std::int64_t bounces) const;
  /// Of the weights, for discs of a radius and so many light paths for each of the sensor's.
  double eta(double radius_m, double light_paths_each) const { return light_paths_each * area_m2(radius_m); }

  /// The largest radius at which the light of `paths` agrees with any smaller radius, to within the noise
  /// of these (Lepski's rule): where noise and bias are alike. most_m() where next to no path comes.
  double balanced_radius_m(const LightPaths& paths) const;

 private:
  static constexpr std::size_t kSectors = 64;
  Vec3 centre_{0};
  Frame frame_;
  float slack_m_ = 0, most_m_ = 0;
  std::array<float, kSectors> reach_m_{};
};

}  // namespace phos::inline reference
