// Light from infinitely far away, by direction: an environment map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vector.h"

namespace phos {

/// Luminance over the sphere, constant over each texel of an equirectangular map: every sum over it is exact,
/// and a sun of one texel is a sun of one texel. +Y is up: row 0 is the topmost. As in OpenEXR and Mitsuba,
/// the middle of the picture shows +Z, and +X a quarter of the width to the left of it. The map is turned
/// about +Y by `rotation_rad`, counter-clockwise seen from above: +Z goes towards +X.
class Environment {
 public:
  /// cd/m2, row by row. There must be width x height texels, finite and not negative.
  Environment(int width, int height, std::vector<Rgb> texels, double rotation_rad = 0);

  int width() const { return width_; }
  int height() const { return height_; }
  double rotation_rad() const { return rotation_rad_; }
  const std::vector<Rgb>& texels() const { return texels_; }

  /// Luminance seen in a direction (unit), cd/m2.
  Rgb luminance(const Vec3& direction) const { return texels_[texel_at(direction)]; }

  struct Sample {
    Vec3 direction{0, 1, 0};  ///< unit, towards the environment
    Rgb luminance{0};         ///< cd/m2
    float density = 0;        ///< per sr
  };
  /// A direction in which a point looks for light: half of them with density in proportion to the luminance,
  /// half to what of it is below four times its mean, so that the sky is still seen where a small sun is
  /// hidden (of a map without such peaks, all by luminance). Rows by u.y, columns by u.x, both monotonous, so
  /// that strata of `u` are strata of the sphere. Density 0 where the map is black.
  Sample sample(const Vec2& u) const;
  /// Density per sr with which sample() chooses a direction.
  float density(const Vec3& direction) const { return density_of(texel_at(direction)); }
  /// A direction with density in proportion to the luminance alone: photons that start with it carry alike.
  Sample sample_flux(const Vec2& u) const;

  /// Integral of the luminance over the sphere, lx (cd/m2 sr).
  const DVec3& integral_lx() const { return integral_lx_; }
  /// Irradiance of an unoccluded surface that faces up, lx.
  DVec3 irradiance_up_lx() const;

 private:
  /// Chooses texels with probabilities in proportion to a weight per sr.
  struct Table {
    std::vector<double> row_cdf;    // ends at 1; empty if all weights are 0
    std::vector<float> column_cdf;  // of each row, ends at 1
  };
  template <class Weight>
  Table make_table(const Weight& weight) const;
  Sample draw(const Table& table, const Vec2& u) const;
  std::size_t texel_at(const Vec3& direction) const;
  float density_of(std::size_t texel) const;
  double texel_sr(int row) const;
  void integrate();

  int width_, height_;
  double rotation_rad_;
  std::vector<Rgb> texels_;
  // sin^2(theta / 2) at the upper edge of each row, and at the last one's lower.
  std::vector<double> row_edge_;
  DVec3 integral_lx_{0};
  double luminous_lx_ = 0;          // luminance of the integral
  double cap_ = 0, capped_lx_ = 0;  // cd/m2; luminance of the integral of what is below it. 0: no peaks
  Table by_flux_, by_both_;         // the second is empty where there are no peaks
};

/// An environment map as it was read.
struct EnvironmentFile {
  Environment map;
  std::size_t outside_gamut = 0;  ///< texels of colours outside Rec.709, made less saturated
};

/// Reads an equirectangular map, twice as wide as high: Radiance .hdr (times 179 lm/W) or OpenEXR (taken as
/// cd/m2), times `scale`. Colours that Rec.709 cannot say without a negative component (Radiance's primaries
/// are wider) are mixed with grey of their luminance until none is below 0. Throws Error(bad_input) for a
/// file that is missing, damaged or of another shape, or that has texels that are no light: negative (of CIE
/// X, Y or Z) or not finite.
EnvironmentFile read_environment(const std::string& path, double scale = 1, double rotation_rad = 0);

}  // namespace phos
