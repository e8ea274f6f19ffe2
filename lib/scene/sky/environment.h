// Light from infinitely far away, by direction: an environment map and a sun.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// Luminance over the sphere, constant over each texel of an equirectangular map: every sum over it is exact,
/// and a sun of one texel is a sun of one texel. +Y is up: row 0 is the topmost. As in OpenEXR and Mitsuba,
/// the middle of the picture shows +Z, and +X a quarter of the width to the left. The map is turned
/// about +Y by `rotation_rad`, counter-clockwise seen from above: +Z goes towards +X. A sun, if there is one,
/// is no texel but an exact disc: its luminance is added to the map's.
class Environment {
 public:
  struct Sun {
    DVec3 towards{0, 1, 0};  ///< its middle, unit
    double radius_rad = 0;   ///< half its angle across, above 0
    Rgb illuminance_lx{0};   ///< of a surface that faces it
  };

  /// cd/m2, row by row. There must be width x height texels, finite and not negative.
  Environment(int width, int height, std::vector<Rgb> texels, double rotation_rad = 0,
              const std::optional<Sun>& sun = std::nullopt);

  int width() const { return width_; }
  int height() const { return height_; }
  double rotation_rad() const { return rotation_rad_; }
  const std::vector<Rgb>& texels() const { return texels_; }
  const std::optional<Sun>& sun() const { return sun_; }
  /// Same text, same light: it identifies a map that was computed, instead of the last bits of its texels.
  /// Empty for other maps.
  const std::string& recipe() const { return recipe_; }
  void set_recipe(std::string recipe) { recipe_ = std::move(recipe); }

  /// Luminance seen in a direction (unit), cd/m2, the sun included.
  Rgb luminance(const Vec3& direction) const {
    const Rgb& map = texels_[texel_at(direction)];
    return sun_ && in_sun(direction) ? map + sun_cd_m2_ : map;
  }

  /// The same without the sun.
  const Rgb& map_luminance(const Vec3& direction) const { return texels_[texel_at(direction)]; }

  struct Sample {
    Vec3 direction{0, 1, 0};  ///< unit, towards the environment
    Rgb luminance{0};         ///< cd/m2
    float density = 0;        ///< per sr
  };
  /// A direction in which a point looks for light: half of them with density in proportion to the luminance,
  /// half to the part of it below four times its mean, so that the sky is still seen where a small sun is
  /// hidden (of a map without such peaks, all by luminance). A sun gets its share of the light, but at most
  /// half of them, the smallest u.y. Rows by u.y, columns by u.x, both monotonous, so that strata of `u` are
  /// strata of the sphere. Density 0 where all is black.
  Sample sample(const Vec2& u) const;
  /// Density per sr with which sample() chooses a direction.
  float density(const Vec3& direction) const;
  /// Part of them that are of the sun, 0 without one; the solid angle of its disc; is a direction in it; one
  /// of those, uniform.
  double sun_chance() const { return sun_chance_; }
  double sun_sr() const { return sun_sr_; }
  bool in_sun(const Vec3& direction) const;
  Vec3 sample_sun(const Vec2& u) const;
  /// Has the map parts brighter than four times its mean?
  bool has_spots() const { return cap_ > 0; }
  /// A direction with density in proportion to the luminance alone: photons that start with it carry alike.
  Sample sample_flux(const Vec2& u) const;

  /// Density per sr with which sample_flux() chooses a direction.
  double flux_density(const Vec3& direction) const;
  /// Direction of the middle of a texel.
  Vec3 middle(int column, int row) const;

  /// Integral of the luminance over the sphere, lx (cd/m2 sr), the sun included.
  const DVec3& integral_lx() const { return integral_lx_; }
  /// Luminance of its illuminance without the sun, lx.
  double map_lx() const { return luminous_lx_; }
  /// Irradiance of an unoccluded surface that faces up, lx, by the map alone.
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
  void add_sun();
  double texel_sr(int row) const;
  void integrate();

  int width_, height_;
  double rotation_rad_;
  std::vector<Rgb> texels_;
  // sin^2(theta / 2) at the upper edge of each row, and at the last one's lower.
  std::vector<double> row_edge_;
  DVec3 integral_lx_{0};
  double luminous_lx_ = 0;          // luminance of the map's integral
  double cap_ = 0, capped_lx_ = 0;  // cd/m2; luminance of the integral of what is below it. 0: no peaks
  Table by_flux_, by_both_;         // the second is empty where there are no peaks
  std::optional<Sun> sun_;
  Rgb sun_cd_m2_{0};
  double sun_chord2_ = -1;             // of directions within the disc to its middle, squared, at most
  double sun_sr_ = 0, sun_share_ = 0;  // of the flux
  double sun_chance_ = 0;              // in sample()
  std::string recipe_;
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

}  // namespace phos::inline scene
