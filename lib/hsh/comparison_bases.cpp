#include "hsh/comparison_bases.h"

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos::inline hsh {

namespace {

constexpr int kMaxOrder = HarmonicBasis<double>::kMaxOrder;

/// Jacobi polynomials of t = 2z - 1, orthonormal for the weight (1-z)^a z^b on [0, 1]: p[0 .. count).
/// `norm2` is the integral of the weight.
void jacobi(int a, int b, double norm2, double t, int count, double* p) {
  const auto off_diagonal = [&](int k) {  // of the Jacobi matrix
    const double s = 2. * k + a + b;
    return std::sqrt(4. * k * (k + a) * (k + b) * (k + a + b) / (s * s * (s + 1) * (s - 1)));
  };
  double below = 0;  // off_diagonal(k) p[k - 1]
  p[0] = 1 / std::sqrt(norm2);
  for (int k = 0; k + 1 < count; ++k) {
    const double s = 2. * k + a + b;
    const double middle = a == b ? 0 : (1. * b * b - 1. * a * a) / (s * (s + 2));
    const double next = off_diagonal(k + 1);
    p[k + 1] = ((t - middle) * p[k] - below) / next;
    below = next * p[k];
  }
}

/// Leaves NaN as it is.
double clamp(double v, double lo, double hi) { return v < lo ? lo : v > hi ? hi : v; }

bool half(ComparisonBasis basis) {
  return basis == ComparisonBasis::even_sh || basis == ComparisonBasis::zernike;
}

/// Index of (degree, m) in the order stated.
int index_of(ComparisonBasis basis, int degree, int m) {
  return half(basis) ? degree * (degree + 1) / 2 + (degree + m) / 2 : harmonic_index(degree, m);
}

void evaluate_harmonics(ComparisonBasis basis, int order, double x, double y, double z, double* out) {
  const HarmonicBasis<double> harmonics(order);
  if (basis != ComparisonBasis::even_sh) {
    harmonics.evaluate(basis == ComparisonBasis::hsh ? BasisKind::hsh : BasisKind::sh, x, y, z, out);
    return;
  }
  double all[harmonic_count(kMaxOrder)];
  harmonics.evaluate(BasisKind::sh, x, y, z, all);
  for (int l = 0; l < order; ++l) {
    for (int m = -l; m <= l; m += 2) {
      out[index_of(basis, l, m)] = std::numbers::sqrt2 * all[harmonic_index(l, m)];
    }
  }
}

/// Of the three families R(z) cos(m phi): (1-z)^(m/2) e^(i m phi) is ((x + iy) / sqrt(1+z))^m, which needs no
/// angle.
void evaluate_jacobi(ComparisonBasis basis, int order, double x, double y, double z, double* out) {
  const bool adjoint = basis == ComparisonBasis::makhotkin_adjoint;
  const int step = basis == ComparisonBasis::zernike ? 2 : 1;
  const double scale = (adjoint ? std::sqrt(z) : 1) / std::sqrt(1 + z);
  double radial[kMaxOrder];
  double c = adjoint ? std::sqrt(z) : 1, s = 0;  // with the factor z^((m+1)/2) of the adjoint
  double norm2 = adjoint ? 0.5 : 1;              // of (1-z)^m z^b: B(m+1, b+1)
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      const double turned = scale * (x * c - y * s);
      s = scale * (x * s + y * c);
      c = turned;
      norm2 *= adjoint ? m * (m + 1.) / ((2. * m + 1) * (2. * m + 2)) : m / (m + 1.);
    }
    const int count = (order - m + step - 1) / step;
    jacobi(m, adjoint ? m + 1 : 0, norm2, 2 * z - 1, count, radial);
    const double azimuth = 1 / std::sqrt((m == 0 ? 2 : 1) * std::numbers::pi);
    for (int k = 0; k < count; ++k) {
      const int degree = m + step * k;
      out[index_of(basis, degree, m)] = azimuth * radial[k] * c;
      if (m > 0) out[index_of(basis, degree, -m)] = azimuth * radial[k] * s;
    }
  }
}

}  // namespace

std::string name(ComparisonBasis basis) {
  switch (basis) {
    case ComparisonBasis::hsh:
      return "hsh";
    case ComparisonBasis::sh:
      return "sh";
    case ComparisonBasis::even_sh:
      return "even-sh";
    case ComparisonBasis::zernike:
      return "zernike";
    case ComparisonBasis::makhotkin_m0:
      return "makhotkin-m0";
    case ComparisonBasis::makhotkin_adjoint:
      return "makhotkin-adjoint";
  }
  PHOS_CHECK(false, static_cast<int>(basis));
  return {};
}

int comparison_count(ComparisonBasis basis, int order) {
  return half(basis) ? order * (order + 1) / 2 : harmonic_count(order);
}

void evaluate_comparison(ComparisonBasis basis, int order, double x, double y, double z, double* out) {
  HarmonicBasis<double>{order};  // checks the order
  if (basis == ComparisonBasis::hsh || basis == ComparisonBasis::sh || basis == ComparisonBasis::even_sh) {
    evaluate_harmonics(basis, order, x, y, z, out);
  } else {
    evaluate_jacobi(basis, order, clamp(x, -1, 1), clamp(y, -1, 1), clamp(z, 0, 1), out);
  }
}

std::vector<double> accuracy_by_order(const DirectionalFunction& f, ComparisonBasis basis, int order,
                                      const Quadrature& hemisphere) {
  const std::size_t count = static_cast<std::size_t>(comparison_count(basis, order));
  std::vector<double> c(count), values(count);
  double energy = 0;
  for (std::size_t k = 0; k < hemisphere.size(); ++k) {
    const double x = hemisphere.x[k], y = hemisphere.y[k], z = hemisphere.z[k];
    const double v = f(x, y, z), weighted = v * hemisphere.weight[k];
    evaluate_comparison(basis, order, x, y, z, values.data());
    for (std::size_t i = 0; i < count; ++i) c[i] += weighted * values[i];
    energy += v * weighted;
  }
  std::vector<double> accuracy(static_cast<std::size_t>(order), 1);
  double held = 0;
  std::size_t i = 0;
  for (int n = 1; n <= order && energy > 0; ++n) {
    for (; i < static_cast<std::size_t>(comparison_count(basis, n)); ++i) held += c[i] * c[i];
    accuracy[static_cast<std::size_t>(n - 1)] = held / energy;
  }
  return accuracy;
}

}  // namespace phos::inline hsh
