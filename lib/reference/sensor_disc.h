// A disc about a sensor, and the light paths that cross it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reference/light_path.h"

namespace phos {

/// The part of a sensor's plane that it sees within a radius: sectors of a disc, each up to what stands in
/// its way. Illuminance there is the flux that crosses it from the front over its area, without a cosine.
/// Only light counts that came by way of a mirror, glass or sharp gloss.
class SensorDisc {
 public:
  /// Looks how far the plane is free, up to `most_m`.
  SensorDisc(const RayScene& rays, const SurfacePoint& sensor, float most_m);

  /// Of what lies within radius_m, m2.
  double area_m2(double radius_m) const;
  float most_m() const { return most_m_; }

  struct Crossing {
    double aside_m = 0;     ///< from the sensor
    double reach_m = 0;     ///< how far the plane is free there
    double cosine = 1;      ///< of the angle of incidence
    double distance_m = 0;  ///< along the path, since the reflection
  };
  /// False where the segment does not cross what most_m() holds.
  bool cross(const SharpSegment& segment, Crossing& crossing) const;

  struct Light {
    Rgb lux{0};   ///< over the half of the area within radius_m / sqrt(2)
    Rgb bias{0};  ///< of the whole, less that of the half: an estimate of the bias of the latter
  };
  /// What `paths` bring to it, weighted against what eye paths find (BidirectionalTracer::irradiance() with
  /// this eta() and as many light paths for each of the sensor's).
  Light light(const LightPaths& paths, double radius_m, double light_paths_each, std::int64_t bounces) const;
  double eta(double radius_m, double light_paths_each) const {
    return 0.5 * light_paths_each * area_m2(radius_m);
  }

  /// The largest radius at which the light of `paths` is still that of any smaller one, to within the noise
  /// of these (Lepski's rule): where noise and bias are alike. most_m() where next to no path comes.
  double balanced_radius_m(const LightPaths& paths) const;

 private:
  static constexpr std::size_t kSectors = 64;
  Vec3 centre_{0};
  Frame frame_;
  float slack_m_ = 0, most_m_ = 0;
  std::array<float, kSectors> reach_m_{};
};

}  // namespace phos
