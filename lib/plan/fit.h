// Coefficients of a sum of known terms, none of them negative, from few measurements.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace phos::inline plan {

/// One measurement: value = sum over terms of coefficient x term, within `sigma` (one standard deviation).
struct FitRow {
  std::vector<double> term;
  double value = 0, sigma = 1;
};

/// The coefficients, none below 0, of the least sum of squared deviations in units of sigma: every set of
/// terms is tried and the best that needs no negative one is taken, so at most kMaxTerms. A term that no row
/// tells from the others is 0. All rows must have as many terms.
std::vector<double> fit_nonnegative(std::span<const FitRow> rows);
inline constexpr std::size_t kMaxTerms = 10;

/// What draws of the same measurements give: each value moved by a normal deviate of its sigma, and fitted
/// anew. `best` is their mean: a term that the best fit alone would leave out, though the measurements do not
/// exclude it, has a share in it. `misfit` widens every sigma where the terms do not describe the rows: root
/// of chi^2 per degree of freedom, at least 1.
struct Fit {
  std::vector<double> best;
  std::vector<std::vector<double>> draws;
  double misfit = 1;

  /// Those of a draw, or, beyond the last, the best.
  std::vector<double>& of(std::size_t guess) { return guess < draws.size() ? draws[guess] : best; }
  const std::vector<double>& of(std::size_t guess) const {
    return guess < draws.size() ? draws[guess] : best;
  }
};
Fit fit_with_draws(std::span<const FitRow> rows, std::size_t draws, std::uint64_t seed);

}  // namespace phos::inline plan
