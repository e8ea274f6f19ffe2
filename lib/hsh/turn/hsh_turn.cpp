#include "hsh/turn/hsh_turn.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hsh/basis.h"
#include "hsh/conversion.h"
#include "hsh/quadrature.h"
#include "hsh/turn/sh_turn.h"

namespace phos::inline hsh {
namespace {

using std::numbers::pi;

/// The harmonics at one direction, cosines and sines apart.
class Apart {
 public:
  explicit Apart(int order)
      : cosine(Turn::cosine_index(order, 0)),
        sine(Turn::sine_index(order, 1)),
        basis_(order),
        all_(static_cast<std::size_t>(basis_.count())) {}
  void evaluate(const DVec3& w) {
    basis_.evaluate(BasisKind::hsh, w.x, w.y, w.z, all_.data());
    double *c = cosine.data(), *s = sine.data();
    for (int l = 0; l < basis_.order(); ++l) {
      const double* centre = all_.data() + harmonic_index(l, 0);
      for (int m = 0; m <= l; ++m) *c++ = centre[m];
      for (int m = 1; m <= l; ++m) *s++ = centre[-m];
    }
  }
  std::vector<double> cosine, sine;

 private:
  HarmonicBasis<double> basis_;
  std::vector<double> all_;
};

/// Sums weight times the products of all harmonics at one direction and all at another, some pairs of
/// directions at once: the matrix passes by once for all of them. finish() after the last.
class Products {
 public:
  explicit Products(Turn& turn) : turn_(turn), a_(kAtOnce, Apart(turn.order)), b_(a_) {}
  void add(double weight, const DVec3& a, const DVec3& b) {
    a_[filled_].evaluate(a), b_[filled_].evaluate(b);
    weight_[filled_++] = weight;
    if (filled_ == kAtOnce) finish();
  }
  void finish() {
    std::fill(weight_ + filled_, weight_ + kAtOnce, 0.);  // earlier nodes left values there
    filled_ = 0;
    add_products(turn_.cosine, &Apart::cosine);
    add_products(turn_.sine, &Apart::sine);
  }

 private:
  static constexpr std::size_t kAtOnce = 8;
  void add_products(std::vector<double>& matrix, std::vector<double> Apart::*part) const {
    const std::size_t n = (a_[0].*part).size();
    const double* b[kAtOnce];
    for (std::size_t k = 0; k < kAtOnce; ++k) b[k] = (b_[k].*part).data();
    double* row = matrix.data();
    for (std::size_t i = 0; i < n; ++i, row += n) {
      double f[kAtOnce];
      for (std::size_t k = 0; k < kAtOnce; ++k) f[k] = weight_[k] * (a_[k].*part)[i];
      for (std::size_t j = 0; j < n; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < kAtOnce; ++k) sum += f[k] * b[k][j];
        row[j] += sum;
      }
    }
  }

  Turn& turn_;
  std::vector<Apart> a_, b_;
  double weight_[kAtOnce];
  std::size_t filled_ = 0;
};

/// A range of psi for quadrature, as [0, 1] mapped to it.
struct PsiMap {
  int points;
  std::function<double(double)> psi, derivative;
};

/// Angles about the y axis: w = (sin theta cos psi, cos theta, sin theta sin psi). What comes from R^-1 w has
/// psi + beta. All is even in y (products of cosines and products of sines are), so theta goes from 0 to pi/2
/// alone; theta = pi/2 u^2 makes the roots of z that harmonics hold smooth in u. Calls at(sin theta,
/// cos theta, psi, weight).
template <class At>
void integrate_lune(int order, const PsiMap& map, const At& at) {
  std::vector<double> u, u_weight, v, v_weight;
  gauss_legendre(2 * order + 16, u, u_weight);
  gauss_legendre(map.points, v, v_weight);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double s = 0.5 * (u[i] + 1), theta = pi / 2 * s * s;
    const double rho = std::sin(theta), y = std::cos(theta);
    const double theta_weight = 2 * 0.5 * u_weight[i] * pi * s * rho;  // twice: y and -y
    for (std::size_t k = 0; k < v.size(); ++k) {
      const double t = 0.5 * (v[k] + 1);
      at(rho, y, map.psi(t), theta_weight * 0.5 * v_weight[k] * map.derivative(t));
    }
  }
}

/// From a horizon (`psi` = distance from it) to `beta`, with the roots of z at both horizons made smooth:
/// psi = pi sin^2.
PsiMap from_horizon(int order, double beta) {
  const double end = std::asin(std::sqrt(std::min(1., beta / pi)));
  return {2 * order + 16 + static_cast<int>(20 * end),
          [=](double t) { return pi * std::sin(end * t) * std::sin(end * t); },
          [=](double t) { return end * pi * std::sin(2 * end * t); }};
}

/// What was and stays above the horizon: psi in (0, pi - beta). The mirror image x -> -x, which swaps the two
/// horizons, gives one half from the other. psi = beta sinh^2 makes the roots of z here (psi) and before the
/// turn (psi + beta) smooth.
Turn kept(int order, double beta) {
  Turn turn(order);
  if (beta >= pi) return turn;
  Products products(turn);
  const double end = std::asinh(std::sqrt((pi - beta) / (2 * beta)));
  const PsiMap map{2 * order + 8 + static_cast<int>(12 * end),
                   [=](double t) { return beta * std::sinh(end * t) * std::sinh(end * t); },
                   [=](double t) { return end * beta * std::sinh(2 * end * t); }};
  integrate_lune(order, map, [&](double rho, double y, double psi, double w) {
    products.add(w, {rho * std::cos(psi), y, rho * std::sin(psi)},
                 {rho * std::cos(psi + beta), y, rho * std::sin(psi + beta)});
  });
  products.finish();
  const auto add_mirrored = [&](std::vector<double>& matrix, int least_m) {
    std::vector<int> parity;
    for (int l = 0; l < order; ++l)
      for (int m = least_m; m <= l; ++m) parity.push_back(m % 2);
    const std::size_t n = parity.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const double sign = parity[i] == parity[j] ? 1 : -1;
        const double a = matrix[i * n + j], b = matrix[j * n + i];
        matrix[i * n + j] = a + sign * b, matrix[j * n + i] = b + sign * a;
      }
  };
  add_mirrored(turn.cosine, 0), add_mirrored(turn.sine, 1);
  return turn;
}

/// Adds the part that is now above the horizon and was below: psi in (pi - beta, pi), filled with the
/// function's value on the old horizon, which is one value: H_l0 = (-1)^l sqrt((2l+1) / 2 pi), the others 0.
void fill_constant(Turn& turn, double beta) {
  Apart here(turn.order);
  const std::size_t n = turn.cosines();
  std::vector<double> seen(n, 0.);
  integrate_lune(turn.order, from_horizon(turn.order, beta), [&](double rho, double y, double psi, double w) {
    here.evaluate({-rho * std::cos(psi), y, rho * std::sin(psi)});
    for (std::size_t i = 0; i < n; ++i) seen[i] += w * here.cosine[i];
  });
  for (int l = 0; l < turn.order; ++l) {
    const double horizon = (l % 2 == 0 ? 1 : -1) * std::sqrt((2 * l + 1) / (2 * pi));
    for (std::size_t i = 0; i < n; ++i) turn.cosine[i * n + Turn::cosine_index(l, 0)] += seen[i] * horizon;
  }
}

/// The same with the function mirrored at the old horizon. sin^2 makes the roots at both horizons smooth.
void fill_even(Turn& turn, double beta) {
  Products products(turn);
  const PsiMap map{2 * turn.order + 16 + static_cast<int>(12 * beta),
                   [=](double t) { return beta * std::sin(pi / 2 * t) * std::sin(pi / 2 * t); },
                   [=](double t) { return beta * pi / 2 * std::sin(pi * t); }};
  integrate_lune(turn.order, map, [&](double rho, double y, double psi, double w) {
    products.add(w, {-rho * std::cos(psi), y, rho * std::sin(psi)},
                 {-rho * std::cos(beta - psi), y, rho * std::sin(beta - psi)});
  });
  products.finish();
}

Turn unturned(int order) {
  Turn turn(order);
  for (std::size_t i = 0; i < turn.cosines(); ++i) turn.cosine[i * turn.cosines() + i] = 1;
  for (std::size_t i = 0; i < turn.sines(); ++i) turn.sine[i * turn.sines() + i] = 1;
  return turn;
}

/// The function less the part that will go below the horizon: psi in (0, beta).
Turn without_digon(int order, double beta) {
  Turn turn = unturned(order);
  Products products(turn);
  integrate_lune(order, from_horizon(order, beta), [&](double rho, double y, double psi, double w) {
    const DVec3 here(rho * std::cos(psi), y, rho * std::sin(psi));
    products.add(-w, here, here);
  });
  products.finish();
  return turn;
}

/// HSH follow SH on the mapped sphere; an angle that is mapped in the same way is right at the pole alone.
Turn digon(int order, double beta) {
  const double mapped = 2 * std::asin(std::min(1., std::numbers::sqrt2 * std::sin(beta / 2)));
  const ShTurn bands(order, mapped);
  const Turn cut = without_digon(order, beta);
  Turn turn(order);
  const auto multiply = [](const double* band, int band_size, std::size_t first,
                           const std::vector<double>& from, std::size_t n, std::vector<double>& to) {
    const auto size = static_cast<std::size_t>(band_size);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t k = 0; k < size; ++k)
        for (std::size_t j = 0; j < n; ++j)
          to[(first + i) * n + j] += band[i * size + k] * from[(first + k) * n + j];
  };
  for (int l = 0; l < order; ++l) {
    multiply(bands.cosine(l), l + 1, Turn::cosine_index(l, 0), cut.cosine, cut.cosines(), turn.cosine);
    multiply(bands.sine(l), l, Turn::sine_index(l, 1), cut.sine, cut.sines(), turn.sine);
  }
  return turn;
}

/// C D C^T: to SH, turned, and back.
Turn via_sh(int order, double beta) {
  const int sh_order = std::min(2 * order, HarmonicBasis<double>::kMaxOrder);
  const HarmonicConversion c(order, sh_order);
  const ShTurn bands(sh_order, beta);
  Turn turn(order);
  for (int m = 0; m < order; ++m)
    for (int n = 0; n < order; ++n)
      for (int l = m; l < order; ++l)
        for (int k = n; k < order; ++k) {
          double cosine = 0, sine = 0;
          for (int s = std::max(m, n); s < sh_order; ++s) {
            const double cc = c.row(m, l)[s - m] * c.row(n, k)[s - n];
            cosine += cc * bands.cosine(s)[m * (s + 1) + n];
            if (m > 0 && n > 0) sine += cc * bands.sine(s)[(m - 1) * s + n - 1];
          }
          turn.cosine[Turn::cosine_index(l, m) * turn.cosines() + Turn::cosine_index(k, n)] = cosine;
          if (m > 0 && n > 0)
            turn.sine[Turn::sine_index(l, m) * turn.sines() + Turn::sine_index(k, n)] = sine;
        }
  return turn;
}

}  // namespace

Turn hsh_turn(int order, HshRotation method, double beta) {
  if (method == HshRotation::via_sh) return via_sh(order, beta);
  if (method == HshRotation::digon) return digon(order, beta);
  if (beta <= 0) return unturned(order);
  Turn turn = kept(order, beta);
  if (method == HshRotation::constant_fill) fill_constant(turn, beta);
  if (method == HshRotation::even_fill) fill_even(turn, beta);
  return turn;
}

}  // namespace phos::inline hsh
