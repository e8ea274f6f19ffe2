// Wigner's d^l(beta) by its recurrence over l, and from it the matrices of real harmonics.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "hsh/turn.h"

namespace phos {
namespace {

/// sqrt(binomial(2j, j - m)) cos^(j+m) (+-sin)^(j-m) of half the angle: d^j_{j,m} with sine = -sin(beta / 2).
double top_row(int j, int m, double cosine, double sine) {
  double binomial = 1;
  for (int k = 1; k <= j - m; ++k) binomial *= static_cast<double>(j + m + k) / k;
  return std::sqrt(binomial) * std::pow(cosine, j + m) * std::pow(sine, j - m);
}

/// d^l_{m,n}(beta) for l = 0 .. order - 1 (0 where l < |m| or |n|), m >= 0.
void wigner_d(int order, int m, int n, double beta, std::vector<double>& d) {
  std::fill(d.begin(), d.end(), 0.);
  const int first = std::max(m, std::abs(n));
  if (first >= order) return;
  const double c = std::cos(beta / 2), s = std::sin(beta / 2), x = std::cos(beta);
  d[static_cast<std::size_t>(first)] = m >= std::abs(n) ? top_row(m, n, c, -s)
                                       : n > m          ? top_row(n, m, c, s)
                                                        : top_row(-n, -m, c, -s);
  for (int l = first; l + 1 < order; ++l) {
    const double next = (l + 1.) * (l + 1.), here = static_cast<double>(l) * l, mm = m * m, nn = n * n;
    const double shift = m * n == 0 ? 0. : static_cast<double>(m * n) / (here + l);
    const double before = l == first ? 0
                                     : std::sqrt((here - mm) * (here - nn)) / (here * 2 + l) *
                                           d[static_cast<std::size_t>(l - 1)];
    d[static_cast<std::size_t>(l + 1)] = (l + 1.) * (2 * l + 1.) / std::sqrt((next - mm) * (next - nn)) *
                                         ((x - shift) * d[static_cast<std::size_t>(l)] - before);
  }
}

}  // namespace

std::vector<BandTurn> sh_turn(int order, double beta) {
  std::vector<BandTurn> bands;
  for (std::size_t l = 0; l < static_cast<std::size_t>(order); ++l)
    bands.push_back({std::vector<double>((l + 1) * (l + 1)), std::vector<double>(l * l)});
  std::vector<double> plus(static_cast<std::size_t>(order)), minus(plus.size());
  for (int m = 0; m < order; ++m)
    for (int n = 0; n < order; ++n) {
      wigner_d(order, m, n, beta, plus);
      if (m > 0 && n > 0) wigner_d(order, m, -n, beta, minus);
      const double sign = n % 2 == 0 ? 1 : -1;
      for (int band = std::max(m, n); band < order; ++band) {
        const auto l = static_cast<std::size_t>(band), i = static_cast<std::size_t>(m),
                   j = static_cast<std::size_t>(n);
        if (m == 0 || n == 0) {
          bands[l].cosine[i * (l + 1) + j] = plus[l] * (m == n ? 1 : std::sqrt(2.));
        } else {
          bands[l].cosine[i * (l + 1) + j] = plus[l] + sign * minus[l];
          bands[l].sine[(i - 1) * l + j - 1] = plus[l] - sign * minus[l];
        }
      }
    }
  return bands;
}

}  // namespace phos
