#include "hsh/basis.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#define PHOS_HSH_KERNEL evaluate_batch_plain
#define PHOS_HSH_GRADIENT_KERNEL evaluate_gradients_plain
#include "hsh/basis_kernel.inc"

namespace phos::inline hsh {

template <class Real>
BasisTables<Real>::BasisTables() {
  double start = 1 / std::sqrt(4 * std::numbers::pi);
  for (int m = 0; m < kMaxOrder; ++m) {
    // The factor sqrt(2) of every m > 0 and the Condon-Shortley phase come in here.
    if (m > 0) start *= -std::sqrt((2. * m + 1) / (2. * m) * (m == 1 ? 2 : 1));
    start_sh[m] = static_cast<Real>(start);
    start_hsh[m] = static_cast<Real>(std::numbers::sqrt2 * start);
    for (int l = m; l < kMaxOrder; ++l) {
      const int i = harmonic_index(l, m);
      if (l > m) {
        const double up = std::sqrt((4. * l * l - 1) / (1. * l * l - 1. * m * m)), k = l - 1;
        a[i] = static_cast<Real>(up);
        b[i] = static_cast<Real>(up * std::sqrt((k * k - 1. * m * m) / (4 * k * k - 1)));
      }
      d[i] = static_cast<Real>(-std::sqrt((l - m) * (l + m + 1.) / (m == 0 ? 2 : 1)));
    }
  }
}

template <class Real>
const BasisTables<Real>& basis_tables() {
  static const BasisTables<Real> tables;
  return tables;
}

namespace {

#ifdef PHOS_HSH_AVX2
/// Whether this machine can run what basis_avx2.cpp holds.
const bool kAvx2 =
    __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#endif

}  // namespace

template <class Real>
HarmonicBasis<Real>::HarmonicBasis(int order) : order_(order) {
  if (order < 1 || order > kMaxOrder) {
    throw Error(ExitCode::usage, "",
                text("harmonics of order ", order, "; give an order from 1 to ", kMaxOrder));
  }
}

template <class Real>
void HarmonicBasis<Real>::evaluate(BasisKind kind, Real x, Real y, Real z, Real* out) const {
  evaluate_block<Real, 1>(basis_tables<Real>(), kind, order_, 1, &x, &y, &z, out, 1);
}

template <class Real>
void HarmonicBasis<Real>::evaluate(BasisKind kind, Real x, Real y, Real z, Real* out, Real* gx, Real* gy,
                                   Real* gz) const {
  evaluate_gradient_block<Real, 1>(basis_tables<Real>(), kind, order_, 1, &x, &y, &z, out, gx, gy, gz, 1);
}

template <class Real>
void HarmonicBasis<Real>::evaluate_batch(BasisKind kind, std::size_t n, const Real* x, const Real* y,
                                         const Real* z, Real* out) const {
  const BasisTables<Real>& t = basis_tables<Real>();
#ifdef PHOS_HSH_AVX2
  if (kAvx2) return evaluate_batch_avx2(t, kind, order_, n, x, y, z, out);
#endif
  evaluate_batch_plain(t, kind, order_, n, x, y, z, out);
}

template <class Real>
void HarmonicBasis<Real>::evaluate_batch(BasisKind kind, std::size_t n, const Real* x, const Real* y,
                                         const Real* z, Real* out, Real* gx, Real* gy, Real* gz) const {
  const BasisTables<Real>& t = basis_tables<Real>();
#ifdef PHOS_HSH_AVX2
  if (kAvx2) return evaluate_gradients_avx2(t, kind, order_, n, x, y, z, out, gx, gy, gz);
#endif
  evaluate_gradients_plain(t, kind, order_, n, x, y, z, out, gx, gy, gz);
}

template const BasisTables<float>& basis_tables<float>();
template const BasisTables<double>& basis_tables<double>();
template class HarmonicBasis<float>;
template class HarmonicBasis<double>;

}  // namespace phos::inline hsh
