#include "hsh/slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hsh/basis.h"

namespace phos::inline hsh {
namespace {

constexpr float kLeastZ = 0x1p-20f;

float root(float z) { return std::sqrt(z * (1 + z)); }

/// Both ladder operators and the product of a SH with sin(theta) e^(i phi) turn the complex Y_l^m into
///   x: (up Y_l'^(m+1) + down Y_l'^(m-1)) / 2,   y: (up Y_l'^(m+1) - down Y_l'^(m-1)) / (2 i).
struct Ladder {
  int l;  // l'
  bool q;
  double up, down;
};

/// What makes cos(phi) d/dtheta - sin(phi) cot(theta) d/dphi (A: half of L+ - L-), and the x component of the
/// gradient on the sphere (B: (laplacian of (x Y) - x laplacian of Y - Y laplacian of x) / 2) of Y_l^m.
std::vector<Ladder> ladders(int l, int m) {
  const auto root = [](double v) { return std::sqrt(std::max(v, 0.0)); };
  const double above = (2. * l + 1) * (2. * l + 3), below = (2. * l - 1) * (2. * l + 1);
  std::vector<Ladder> all{{l, false, root((l - m) * (l + m + 1.)), -root((l + m) * (l - m + 1.))},
                          {l + 1, true, l * root((l + m + 1.) * (l + m + 2) / above),
                           -l * root((l - m + 1.) * (l - m + 2) / above)}};
  if (l > 0)
    all.push_back({l - 1, true, (l + 1) * root((l - m) * (l - m - 1.) / below),
                   -(l + 1) * root((l + m) * (l + m - 1.) / below)});
  return all;
}

}  // namespace

float HshSlopes::p(float z) { return 3 / (4 * root(std::max(z, kLeastZ))); }

float HshSlopes::q(float z) {
  const float above = std::max(z, kLeastZ);
  return (3 + 2 * above) / (4 * root(above));
}

HshSlopes::HshSlopes(int order) {
  for (int l = 0; l < order; ++l) {
    for (int m = -l; m <= l; ++m) {
      // Real harmonics are sqrt(2) times the real (m > 0) and imaginary (m < 0) parts of the complex ones.
      const bool sine = m < 0;
      const int n = std::abs(m);
      const auto put = [&](const Ladder& to, int to_n, bool to_sine, bool y, double factor) {
        if (factor == 0 || to_n > to.l || (to_n == 0 && to_sine)) return;
        if (to_n == 0 && n > 0) factor *= std::numbers::sqrt2;
        if (n == 0) factor *= std::numbers::sqrt2;  // where the terms up and down are each other's mirror
        terms_.push_back({static_cast<std::size_t>(harmonic_index(l, m)),
                          static_cast<std::size_t>(harmonic_index(to.l, to_sine ? -to_n : to_n)), to.q, y,
                          factor / 2});
      };
      for (const Ladder& to : ladders(l, n)) {
        put(to, n + 1, sine, false, to.up);
        put(to, n + 1, !sine, true, sine ? -to.up : to.up);
        if (n == 0) continue;
        put(to, n - 1, sine, false, to.down);
        put(to, n - 1, !sine, true, sine ? to.down : -to.down);
      }
    }
  }
}

void HshSlopes::subtract(std::span<const double> with_p, std::span<const double> with_q, std::size_t stride,
                         std::span<double> x, std::span<double> y) const {
  for (const Term& t : terms_) {
    const double* from = &(t.q ? with_q : with_p)[t.from * stride];
    double* to = &(t.y ? y : x)[3 * t.of];
    for (std::size_t c = 0; c < 3; ++c) to[c] -= t.factor * from[c];
  }
}

}  // namespace phos::inline hsh
