#include "estimate/harmonics/cosine_fit.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "hsh/basis.h"

namespace phos::inline estimate {
namespace {

std::size_t at(int l, int m) { return static_cast<std::size_t>(harmonic_index(l, m)); }

}  // namespace

CosineFit::CosineFit(int order)
    : order_(order), before_(static_cast<std::size_t>(harmonic_count(order))), pivot_(before_) {
  for (int m = 1 - order; m < order; ++m) {
    for (int l = std::abs(m); l < order; ++l) {
      double diagonal = 0.5;
      if (l > std::abs(m)) {
        const double beside = 0.5 * std::sqrt(double(l * l - m * m) / (4 * l * l - 1));
        before_[at(l, m)] = beside * pivot_[at(l - 1, m)];
        diagonal -= beside * before_[at(l, m)];
      }
      pivot_[at(l, m)] = 1 / diagonal;
    }
  }
}

void CosineFit::solve(std::vector<double>& moments) const {
  const auto add = [&](std::size_t to, double share, std::size_t from) {
    for (std::size_t c = 0; c < 3; ++c) moments[3 * to + c] += share * moments[3 * from + c];
  };
  for (int m = 1 - order_; m < order_; ++m) {
    const int first = std::abs(m);
    for (int l = first + 1; l < order_; ++l) add(at(l, m), -before_[at(l, m)], at(l - 1, m));
    for (int l = first; l < order_; ++l)
      for (std::size_t c = 0; c < 3; ++c) moments[3 * at(l, m) + c] *= pivot_[at(l, m)];
    for (int l = order_ - 2; l >= first; --l) add(at(l, m), -before_[at(l + 1, m)], at(l + 1, m));
  }
}

}  // namespace phos::inline estimate
