// A luminaire's luminous intensity by direction, as measured.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// Intensities at the nodes of a grid over the sphere. The luminaire's own axes: x is horizontal angle 0
/// (C0), y is C90, z is up; it points down. With the poles' axes a0, a1 and p, a direction is cos(polar) p +
/// sin(polar) (cos(azimuth) a0 + sin(azimuth) a1).
struct PhotometricGrid {
  /// What the polar angle is counted from (LM-63, CIE 121). c: p = -z, azimuth C from x to y, as of nearly
  /// all files. b: p = y, azimuth is the vertical angle from -z to x. a: p = -x, azimuth is the horizontal
  /// angle from -z to -y. Horizontal angles of b and a run clockwise seen from above.
  enum class Poles { c, b, a };
  Poles poles = Poles::c;
  std::vector<double> azimuth_deg;  ///< at least 2, over at most 360; 360 apart: all around
  std::vector<double> polar_deg;    ///< at least 2, in [0, 180]
  std::vector<float> candela;  ///< of azimuth i and polar angle j: [i * polar_deg.size() + j]; not negative
};

/// By so much angles of a grid must ascend: floats in radians tell them apart.
inline constexpr double kLeastStep_deg = 1e-3;

/// The bilinear interpolant of a grid in its two angles; 0 beyond them. Const and usable from any thread.
class Photometry {
 public:
  /// The grid's ranges must hold (checked); a sum of squares beyond double's range is not looked for.
  explicit Photometry(const PhotometricGrid& grid);

  /// Intensity towards a unit direction in the luminaire's axes, cd.
  float candela(const Vec3& direction) const;
  /// Integral of candela() over the sphere, exact but for rounding, lm.
  double flux_lm() const { return flux_lm_; }
  /// Share of the flux that goes below the horizontal (z < 0); 0 without flux. Exact for grids whose nodes
  /// hold the horizontal or end before it, else by the middles of cells.
  double downward_share() const { return downward_share_; }
  /// Greatest intensity, cd, and a direction that has it.
  float peak_cd() const { return peak_cd_; }
  const Vec3& peak_direction() const { return peak_direction_; }

  /// A unit direction with density candela() / flux_lm() per sr. flux_lm() must be above 0.
  Vec3 sample(const Vec2& u) const;
  /// Does light go anywhere into the half-space of unit `axis`? True too where only an edge of a lit cell
  /// does.
  bool shines_towards(const Vec3& axis) const;
  /// The same all around the z axis?
  bool rotational() const { return rotational_; }

  /// Identifies the distribution: equal for equal grids.
  const std::string& hash() const { return hash_; }

 private:
  /// Index of the interval of ascending `nodes` that holds x, which lies within them.
  static std::size_t interval(const std::vector<float>& nodes, float x);
  Vec3 direction(double azimuth_rad, double cos_polar, double sin_polar) const;
  void integrate();
  void find_peak();
  float at(std::size_t i, std::size_t j) const { return candela_[i * polar_rad_.size() + j]; }

  Vec3 a0_, a1_, pole_;
  bool rotational_ = false, closed_ = false;  // closed: all around
  std::vector<float> azimuth_rad_, polar_rad_;
  std::vector<float> candela_;  // [azimuth][polar]
  std::vector<double> below_;   // [azimuth][polar]: of I sin(polar) up to the node, lm per rad of azimuth
  std::vector<double> azimuth_cdf_;  // lm up to the node
  double flux_lm_ = 0, downward_share_ = 0;
  float peak_cd_ = 0;
  Vec3 peak_direction_{0, 0, -1};
  std::string hash_;
};

/// Whole angles about the vertical axis in the plane of azimuth C `c_deg` and its opposite, within which the
/// intensity reaches half and a tenth of the plane's greatest: from the outermost direction on one side to
/// the outermost on the other, of the lower half-space and of directions that go on from there without a gap
/// (of a lamp that shines more strongly up: about the zenith, of the upper one). 0 where the plane is dark.
struct BeamAngles {
  double half_deg = 0, tenth_deg = 0;
};
BeamAngles beam_angles(const Photometry& photometry, double c_deg);

/// Unit direction of C-plane `c_deg` at `gamma_deg` from straight down, in the luminaire's axes.
Vec3 c_gamma_direction(double c_deg, double gamma_deg);

}  // namespace phos::inline scene
