#include "hsh/turn/sh_turn.h"

#include <cmath>
#include <numbers>

#include "hsh/basis.h"

namespace phos::inline hsh {
namespace {

/// d^l_{j,k} for l = j, j + 1, ...: one step of
///   d^{l+1} = grow ((cos beta - shift) d^l - shrink d^{l-1}).
struct Recurrence {
  double before = 0, here = 0;
  void step(double grow, double cosine_less_shift, double shrink) {
    const double next = grow * (cosine_less_shift * here - shrink * before);
    before = here, here = next;
  }
};

}  // namespace

ShTurn::ShTurn(int order, double beta) {
  const HarmonicBasis<double> within_range(order);
  values_.assign(start(order), 0.);
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  // sqrt(i), 1 / sqrt(i), and the powers of the cosine and the sine of half the angle.
  const std::size_t size = 2 * at(order) + 1;
  std::vector<double> root(size, 0.), inverse(size, 0.), cosines(size, 1.), sines(size, 1.);
  for (std::size_t i = 1; i < size; ++i) {
    root[i] = std::sqrt(static_cast<double>(i)), inverse[i] = 1 / root[i];
    cosines[i] = cosines[i - 1] * std::cos(beta / 2), sines[i] = sines[i - 1] * std::sin(beta / 2);
  }
  const double x = std::cos(beta);
  for (int j = 0; j < order; ++j) {
    double binomial_root = 1;  // of 2j over j - k
    for (int k = j; k >= 0; --k) {
      // d^j_{j,k} = sqrt(2j over j - k) cos^(j+k) (-sin)^(j-k), and the same for -k; then upwards.
      const double sign = (j - k) % 2 == 0 ? 1 : -1;
      Recurrence plus{0, sign * binomial_root * cosines[at(j + k)] * sines[at(j - k)]};
      Recurrence minus{0, sign * binomial_root * cosines[at(j - k)] * sines[at(j + k)]};
      if (k > 0) binomial_root *= root[at(j + k)] * inverse[at(j - k + 1)];
      for (int l = j;; ++l) {
        // Real harmonics: cosines d_{j,k} + (-1)^k d_{j,-k}, sines the difference; j and k exchanged change
        // the sign by (-1)^(j-k).
        double *const c = values_.data() + start(l), *const s = c + (l + 1) * (l + 1);
        const double other = k % 2 == 0 ? minus.here : -minus.here;
        const double cosine = k > 0 ? plus.here + other : plus.here * (j > 0 ? std::numbers::sqrt2 : 1);
        c[j * (l + 1) + k] = cosine, c[k * (l + 1) + j] = sign * cosine;
        if (k > 0) {
          const double sine = plus.here - other;
          s[(j - 1) * l + k - 1] = sine, s[(k - 1) * l + j - 1] = sign * sine;
        }
        if (l + 1 == order) break;
        const double here = static_cast<double>(l) * (2 * l + 1), next = (l + 1.) * (2 * l + 1);
        const double grow = next * inverse[at(l + 1 - j)] * inverse[at(l + 1 + j)] * inverse[at(l + 1 - k)] *
                            inverse[at(l + 1 + k)];
        const double shrink =
            l == j ? 0 : root[at(l - j)] * root[at(l + j)] * root[at(l - k)] * root[at(l + k)] / here;
        const double shift = k == 0 ? 0 : static_cast<double>(j * k) / (l * (l + 1.));
        plus.step(grow, x - shift, shrink), minus.step(grow, x + shift, shrink);
      }
    }
  }
}

}  // namespace phos::inline hsh
