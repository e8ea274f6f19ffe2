// What the recurrences of the harmonics need; shared by the plain and the vectorised evaluation.
#pragma once

#include <cstddef>
#include <vector>

#include "hsh/basis.h"

namespace phos {

/// Y_l^m = Q_l^m(z) C_m(x, y), C_m + i S_m = (x + i y)^m; the same table serves every order.
/// By harmonic_index(l, m), m >= 0: Q_l^m = a z Q_{l-1}^m - b Q_{l-2}^m and dQ_l^m/dz = d Q_l^{m+1}.
/// By m: Q_m^m = start of SH, and of HSH sqrt(2) times that (the map below halves the area).
template <class Real>
struct BasisTables {
  std::vector<Real> a, b, d, start_sh, start_hsh;
  const std::vector<Real>& start(BasisKind kind) const {
    return kind == BasisKind::sh ? start_sh : start_hsh;
  }
};
template <class Real>
const BasisTables<Real>& basis_tables();

/// `n` directions, structure of arrays, as HarmonicBasis::evaluate_batch.
template <class Real>
using BasisKernel = void(const BasisTables<Real>& tables, BasisKind kind, int order, std::size_t n,
                         const Real* x, const Real* y, const Real* z, Real* out);

}  // namespace phos
