// Noise and bias of a result, told apart by running it twice and judging it by two references.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"

namespace phos::inline plan {

/// Mean squares over all values; with a and b of independent noise about one mean m, and references p and q
/// about the truth t, noise = mean (a - b)^2 / 2 is the variance, and bias = mean ((a - p)(b - q) + (a - q)(b
/// - p)) / 2 is the square of m - t: neither holds the references' noise on average, so bias can come out
/// below 0.
struct Separated {
  double noise2 = 0, bias2 = 0;
  double noise2_sigma = 0, bias2_sigma = 0;  ///< standard errors, from how blocks of places differ
  double reference2 = 0;                     ///< variance of one reference
  std::size_t values = 0;

  double total2() const { return noise2 + bias2; }
  /// In units of `magnitude` squared.
  Separated over(double magnitude) const;
};

/// Values of the same places in the same order, neighbours beside each other; `block` of them are taken as
/// one draw. A place where any is not finite is passed over.
Separated separate(std::span<const double> a, std::span<const double> b, std::span<const double> p,
                   std::span<const double> q, std::size_t block);

double mean_magnitude(std::span<const double> a, std::span<const double> b);

/// Components of a layer ("" is the beauty) in tiles of 8 x 8 pixels, without the pixels that show a lamp in
/// `reference`. Zeros for a layer that is not there.
std::vector<double> tiled_values(const Image& image, const std::string& layer, const Image& reference);
inline constexpr std::size_t kTileValues = 3 * 8 * 8;

}  // namespace phos::inline plan
