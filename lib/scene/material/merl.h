// Measured isotropic reflection: tables in the layout of the MERL database (Matusik et al. 2003).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// One material's table, over the half vector's angle from the normal (denser towards it: theta_h grows with
/// the square of its index), and the angles of the incident direction about the half vector (Rusinkiewicz
/// 1998). Values stand for the middles of their cells and are interpolated linearly between them; the table
/// is reciprocal by its period of pi in phi_d. Directions are local, z the normal.
///
/// Light is split in a Lambert part, the lower quartile of pi f over pairs of directions (most pairs reach
/// at least that), and the rest, which is signed and is called the gloss.
class MerlBrdf {
 public:
  static constexpr int kThetaH = 90, kThetaD = 90, kPhiD = 180;

  /// `bytes` of a file: three int32 (90, 90, 180), then 90 x 90 x 180 doubles for each of red, green and
  /// blue, which are multiplied by 1/1500, 1.15/1500 and 1.66/1500. Negative samples are no data: the cell
  /// takes the value of the nearest one that has some. Throws Error(bad_input) naming `path`: truncated,
  /// too long, of other sizes, not finite, or without any data.
  MerlBrdf(std::string_view bytes, const std::string& path);

  /// The same material with other colours: each value of pi f replaced by its `colour`.
  MerlBrdf recoloured(const std::function<Rgb(const Rgb&)>& colour) const;

  /// f(o, i) in 1/sr, o.z and i.z > 0.
  Rgb evaluate(const Vec3& o, const Vec3& i) const;
  /// Diffuse reflectance of the Lambert part.
  Rgb lambert() const { return lambert_; }
  /// evaluate() without the Lambert part.
  Rgb gloss(const Vec3& o, const Vec3& i) const { return evaluate(o, i) - lambert_ / kPi; }
  /// Is there more to it than the Lambert part?
  bool glossy() const { return glossy_; }

  /// Draws i for the gloss from a mixture of a GGX and a cosine lobe, which are fitted for least variance.
  /// False: below the surface.
  bool sample_gloss(const Vec3& o, const Vec2& u, Vec3& i) const;
  /// Its density per sr, above 0 for every i above the surface; integrates to one minus the part that is lost
  /// below.
  float gloss_density(const Vec3& o, const Vec3& i) const;
  /// Roughness of that GGX lobe.
  float alpha() const { return alpha_; }

  /// Reflectance for light from (or towards) an angle of that cosine.
  Rgb albedo(float cos_theta) const;
  /// Luminance of the gloss' reflectance, counting negative values as positive.
  float gloss_albedo(float cos_theta) const;
  /// Reflectance of diffuse light.
  Rgb mean_albedo() const;
  /// Largest albedo of any channel.
  float largest_albedo() const;
  /// Angles of the table whose albedo is above 1 (by more than the quadrature's error).
  std::uint64_t gaining_angles() const;
  /// Does some angle reflect more than it gets (measurements do, near grazing)? Then how much and where, in
  /// words; else empty. Nothing is scaled.
  std::string energy_gain() const;
  /// How those words begin.
  static constexpr const char* kGainsEnergy = "gains energy: ";

  /// Cells without data, and how many of them light can reach (both directions above the surface).
  std::uint64_t empty_cells() const { return empty_cells_; }
  std::uint64_t empty_reachable_cells() const { return empty_reachable_cells_; }
  /// Hash of the file's bytes.
  const std::string& contents() const { return contents_; }
  std::uint64_t memory_bytes() const { return value_.size() * sizeof(Rgb); }

 private:
  static constexpr int kAngles = 25;  // of the albedo tables, even steps of the cosine from grazing to 1
  static float angle_cosine(int k) { return std::fmax(static_cast<float>(k) / (kAngles - 1), 0.01f); }
  void digest();
  void fill_empty(const std::vector<bool>& empty);
  void find_lambert();
  void fit_lobe();
  void tabulate_albedo();
  template <class T>
  T over_cosine(const std::vector<T>& table, float cos_theta) const;

  std::vector<Rgb> value_;  // [theta_h][theta_d][phi_d]
  Rgb lambert_{0};
  float alpha_ = 1, broad_share_ = 1;
  bool glossy_ = false;
  std::vector<Rgb> albedo_;
  std::vector<float> gloss_albedo_;
  std::uint64_t empty_cells_ = 0, empty_reachable_cells_ = 0;
  std::string contents_;
};

/// Reads a file. Throws Error(bad_input), also for one that is no regular file.
MerlBrdf read_merl(const std::string& path);

}  // namespace phos::inline scene
