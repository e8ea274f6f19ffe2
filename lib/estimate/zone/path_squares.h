// The variance of sums over a zone's photons, of which several may be of one path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"

namespace phos::inline estimate {

/// Which photons of a zone are of one path.
struct ZonePaths {
  std::vector<std::uint32_t> path;  ///< of each photon, numbered from 0; empty: paths are not known
  std::size_t paths = 0;
  /// `family` of each photon (Photons::family); empty: not known.
  void set(std::span<const std::uint32_t> family);
  bool known() const { return !path.empty(); }
};

/// Sum over paths of the square of what a path's photons add to a sum. Paths land as a Poisson process, so
/// that it is the variance of the sum, and estimates it without bias (Campbell's theorem). Where paths are
/// not known each photon counts alone: PhotonNoise::spread() tells what that leaves out.
class PathSquares {
 public:
  /// `of` must outlive it.
  explicit PathSquares(const ZonePaths& of) : of_(of), sum_of_path_(of.paths) {}

  /// Adds what this photon of the zone adds to the sum.
  void add(std::size_t photon, const DVec3& term) {
    const double light = grey(term);
    grey_alone_ += light * light;
    if (of_.known())
      sum_of_path_[of_.path[photon]] += term;
    else
      alone_ += term * term;
  }
  /// By channel.
  DVec3 squares() const;
  /// Of luminance.
  double grey_squares() const;
  /// grey_squares() over what it were if each photon were of another path; 1 where paths are not known, or
  /// nothing was added.
  double spread() const;

 private:
  static double grey(const DVec3& light) { return static_cast<double>(luminance(Rgb(light))); }

  const ZonePaths& of_;
  std::vector<DVec3> sum_of_path_;
  DVec3 alone_{0};
  double grey_alone_ = 0;
};

}  // namespace phos::inline estimate
