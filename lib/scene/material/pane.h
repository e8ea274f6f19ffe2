// Reflection and transmission of plane-parallel panes, each state of polarisation by itself.
#pragma once

#include <memory>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// Share of unpolarised light, by channel, that a pane or a pack of panes lets through and sends back, for
/// light across (0) and in (1) the plane of incidence. Light goes straight on: `pass` is the same from both
/// sides.
struct PaneLayer {
  Rgb pass[2]{Rgb(0), Rgb(0)};
  Rgb back[2]{Rgb(0), Rgb(0)};         ///< off the side that the light comes to
  Rgb back_behind[2]{Rgb(0), Rgb(0)};  ///< off the other side

  /// Of unpolarised light: the mean of both states of polarisation of the result.
  Rgb transmittance() const { return 0.5f * (pass[0] + pass[1]); }
  Rgb reflectance() const { return 0.5f * (back[0] + back[1]); }
};

/// Reflectance of one face of a dielectric across (s) and in (p) the plane of incidence (Born and
/// Wolf 1.5.2).
struct FaceReflectance {
  float s = 1, p = 1;
  float cos_refracted = 0;  ///< 0 at total reflection, where s = p = 1
  float mean() const { return 0.5f * (s + p); }
};
/// `ior`: index beyond the face over the index before it, above 0. `cosine` of incidence, in [0, 1].
FaceReflectance face_reflectance(float cosine, float ior);

/// A pane of index `ior` (1 or more) with all interreflection between its faces: T = (1-R)^2 a / (1 - R^2
/// a^2), R_pane = R + R (1-R)^2 a^2 / (1 - R^2 a^2) for each polarisation. `inside`: internal transmittance
/// of one passage along the normal, in [0, 1]; a = inside^(1 / cos of refraction).
PaneLayer pane_layer(float cosine, float ior, const Rgb& inside);

/// Internal transmittance along the normal of a pane that passes `normal_transmittance` of light along its
/// normal. More than a pane without absorption can pass, (1-R)/(1+R), gives more than 1: not a pane.
double internal_transmittance(double normal_transmittance, double ior);

/// Light that meets `first`, then `second`, with all interreflection between the two parallel layers:
/// T = Ta Tb / (1 - Ra Rb), R = Ra + Ta^2 Rb / (1 - Ra Rb) for each polarisation.
PaneLayer stack(const PaneLayer& first, const PaneLayer& second);

/// Transmittance of a pane by angle of incidence, as glass makers tabulate it: a monotone cubic through the
/// points (Fritsch and Carlson 1980, in degrees), 0 at 90 degrees.
class TransmittanceCurve {
 public:
  struct Point {
    double angle_deg, transmittance;
  };
  /// Points by growing angle, the first at 0, transmittances in [0, 1]; (90, 0) is added if it is not there.
  /// Throws std::runtime_error with the fault for other points.
  explicit TransmittanceCurve(std::vector<Point> points);
  /// `cosine` of incidence, in [0, 1].
  float at(float cosine) const;
  const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Point> points_;
  std::vector<double> slope_;  // at each point, per degree
};

}  // namespace phos::inline scene
