// What the recurrences of the harmonics need; shared by the plain and the vectorised evaluation.
#pragma once

#include <cstddef>

#include "hsh/basis.h"

namespace phos::inline hsh {

/// Y_l^m = Q_l^m(z) C_m(x, y), C_m + i S_m = (x + i y)^m; the same table serves every order.
template <class Real>
struct BasisTables {
  static constexpr int kMaxOrder = HarmonicBasis<Real>::kMaxOrder;
  /// By harmonic_index(l, m), m >= 0: Q_l^m = a z Q_{l-1}^m - b Q_{l-2}^m, and dQ_l^m/dz = d Q_l^{m+1}.
  Real a[harmonic_count(kMaxOrder)] = {}, b[harmonic_count(kMaxOrder)] = {},
       d[harmonic_count(kMaxOrder)] = {};
  /// By m: Q_m^m, constant. For HSH it is sqrt(2) times its value for SH, since the map halves the area.
  Real start_sh[kMaxOrder] = {}, start_hsh[kMaxOrder] = {};
  BasisTables();
};
/// Made once per process.
template <class Real>
const BasisTables<Real>& basis_tables();

/// HarmonicBasis::evaluate_batch.
template <class Real>
using BasisKernel = void(const BasisTables<Real>& tables, BasisKind kind, int order, std::size_t n,
                         const Real* x, const Real* y, const Real* z, Real* out);
template <class Real>
using GradientKernel = void(const BasisTables<Real>& tables, BasisKind kind, int order, std::size_t n,
                            const Real* x, const Real* y, const Real* z, Real* out, Real* gx, Real* gy,
                            Real* gz);
BasisKernel<float> evaluate_batch_plain;
BasisKernel<double> evaluate_batch_plain;
GradientKernel<float> evaluate_gradients_plain;
GradientKernel<double> evaluate_gradients_plain;
#ifdef PHOS_HSH_AVX2
BasisKernel<float> evaluate_batch_avx2;
BasisKernel<double> evaluate_batch_avx2;
GradientKernel<float> evaluate_gradients_avx2;
GradientKernel<double> evaluate_gradients_avx2;
#endif

}  // namespace phos::inline hsh
