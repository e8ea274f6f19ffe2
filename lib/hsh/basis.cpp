#include "hsh/basis.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#define PHOS_HSH_KERNEL evaluate_batch_plain
#include "hsh/basis_kernel.inc"

namespace phos {

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

template <class Real>
BasisKernel<Real>* best_basis_kernel() {
#ifdef PHOS_HSH_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) {
    return evaluate_batch_avx2;
  }
#endif
  return evaluate_batch_plain;
}

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
  const BasisTables<Real>& t = basis_tables<Real>();
  map_to_sphere(kind, x, y, z);
  Real c = 1, s = 0;
  for (int m = 0; m < order_; ++m) {
    Real q = kind == BasisKind::sh ? t.start_sh[m] : t.start_hsh[m], before = 0;
    for (int l = m; l < order_; ++l) {
      const int i = harmonic_index(l, m);
      if (l > m) {
        const Real next = t.a[i] * z * q - t.b[i] * before;
        before = q;
        q = next;
      }
      out[i] = q * c;
      if (m > 0) out[harmonic_index(l, -m)] = q * s;
    }
    const Real turned = x * c - y * s;
    s = x * s + y * c;
    c = turned;
  }
}

template <class Real>
void HarmonicBasis<Real>::evaluate_batch(BasisKind kind, std::size_t n, const Real* x, const Real* y,
                                         const Real* z, Real* out) const {
  static BasisKernel<Real>* const kernel = best_basis_kernel<Real>();
  kernel(basis_tables<Real>(), kind, order_, n, x, y, z, out);
}

template <class Real>
void HarmonicBasis<Real>::evaluate(BasisKind kind, Real x, Real y, Real z, Real* out, Real* gx, Real* gy,
                                   Real* gz) const {
  const BasisTables<Real>& t = basis_tables<Real>();
  const bool hemisphere = kind == BasisKind::hsh;
  const Real* const start = hemisphere ? t.start_hsh : t.start_sh;
  x = clamp<Real>(x, -1, 1);
  y = clamp<Real>(y, -1, 1);
  z = clamp<Real>(z, hemisphere ? 0 : -1, 1);
  Real px = x, py = y, pz = z;
  const Real h = map_to_sphere(kind, px, py, pz);

  // (C_m, S_m), and for HSH also (C_m, S_m) / h^2 = 4 (2h)^(m-2) (x + iy)^m, which diverges for m = 1 alone.
  Real c[kMaxOrder], s[kMaxOrder], c_h2[kMaxOrder] = {}, s_h2[kMaxOrder] = {};
  c[0] = 1;
  s[0] = 0;
  for (int m = 1; m < order_; ++m) {
    c[m] = px * c[m - 1] - py * s[m - 1];
    s[m] = px * s[m - 1] + py * c[m - 1];
    if (m == 1 && h > 0) {
      c_h2[m] = 2 * x / h;
      s_h2[m] = 2 * y / h;
    } else if (m == 2) {
      c_h2[m] = 4 * (x * x - y * y);
      s_h2[m] = 8 * x * y;
    } else if (m > 2) {
      c_h2[m] = px * c_h2[m - 1] - py * s_h2[m - 1];
      s_h2[m] = px * s_h2[m - 1] + py * c_h2[m - 1];
    }
  }

  Real column[2][kMaxOrder];  // Q_l^m of m and of m + 1
  for (int m = order_ - 1; m >= 0; --m) {
    Real* const q = column[m & 1];
    const Real* const q_next = column[~m & 1];
    const Real k = static_cast<Real>(m), below_c = m > 0 ? c[m - 1] : 0, below_s = m > 0 ? s[m - 1] : 0;
    for (int l = m; l < order_; ++l) {
      const int i = harmonic_index(l, m);
      q[l] = l == m ? start[m] : t.a[i] * pz * q[l - 1] - t.b[i] * (l > m + 1 ? q[l - 2] : 0);
      const Real dq = l > m ? t.d[i] * q_next[l] : 0;
      // One function f = Q(z) B(x, y) of the mapped direction, from B, its derivatives and B / h^2.
      const auto put = [&](int index, Real b, Real b_x, Real b_y, Real b_h2) {
        Real fx = q[l] * b_x, fy = q[l] * b_y, fz = dq * b, along;
        if (hemisphere) {
          const Real up = 1 + z, turns = k * q[l];  // x B_x + y B_y = m B
          fx *= 2 * h;
          fy *= 2 * h;
          fz *= 2;
          along = x * fx + y * fy + (turns * b / (2 * up) + z * fz);
          fz += turns * b_h2 / (2 * up * up);
        } else {
          along = x * fx + y * fy + z * fz;
        }
        out[index] = q[l] * b;
        gx[index] = fx - x * along;
        gy[index] = fy - y * along;
        if (gz) gz[index] = fz - z * along;
      };
      put(i, c[m], k * below_c, -k * below_s, c_h2[m]);
      if (m > 0) put(harmonic_index(l, -m), s[m], k * below_s, k * below_c, s_h2[m]);
    }
  }
}

template const BasisTables<float>& basis_tables<float>();
template const BasisTables<double>& basis_tables<double>();
template class HarmonicBasis<float>;
template class HarmonicBasis<double>;

}  // namespace phos
