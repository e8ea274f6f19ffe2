#include "hsh/basis.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "hsh/basis_kernel.h"

namespace phos {

namespace {

template <class Real>
BasisTables<Real> make_tables() {
  constexpr int order = HarmonicBasis<Real>::kMaxOrder;
  BasisTables<Real> t;
  t.a.resize(harmonic_count(order));
  t.b.resize(harmonic_count(order));
  t.d.resize(harmonic_count(order));
  double start = 1 / std::sqrt(4 * std::numbers::pi);
  for (int m = 0; m < order; ++m) {
    // The factor sqrt(2) of every m > 0 and the Condon-Shortley phase come in here.
    if (m > 0) start *= -std::sqrt((2. * m + 1) / (2. * m) * (m == 1 ? 2 : 1));
    t.start_sh.push_back(static_cast<Real>(start));
    t.start_hsh.push_back(static_cast<Real>(std::numbers::sqrt2 * start));
    for (int l = m; l < order; ++l) {
      const std::size_t i = static_cast<std::size_t>(harmonic_index(l, m));
      if (l > m) {
        const double a = std::sqrt((4. * l * l - 1) / (1. * l * l - 1. * m * m));
        const double k = l - 1;
        t.a[i] = static_cast<Real>(a);
        t.b[i] = static_cast<Real>(a * std::sqrt((k * k - 1. * m * m) / (4 * k * k - 1)));
      }
      t.d[i] = static_cast<Real>(-std::sqrt((l - m) * (l + m + 1.) / (m == 0 ? 2 : 1)));
    }
  }
  return t;
}

/// Leaves NaN as it is.
template <class Real>
Real clamp(Real v, Real lo, Real hi) {
  return v < lo ? lo : v > hi ? hi : v;
}

/// Where the hemisphere's direction lies on the sphere: (2 h x, 2 h y, 2 z - 1), h = sqrt(z / (1 + z)), an
/// equal-area map up to the factor 2 under which HSH are sqrt(2) SH. For SH the direction itself. Components
/// are held in [-1, 1], which changes no unit direction and keeps every other from overflowing.
template <class Real>
struct Mapped {
  Real x, y, z, h;
  Mapped(BasisKind kind, Real dx, Real dy, Real dz) : x(dx), y(dy), z(dz), h(0) {
    if (kind == BasisKind::hsh) {
      const Real up = clamp<Real>(dz, 0, 1);
      h = std::sqrt(up / (1 + up));
      x = 2 * h * x;
      y = 2 * h * y;
      z = 2 * up - 1;
    }
    x = clamp<Real>(x, -1, 1);
    y = clamp<Real>(y, -1, 1);
    z = clamp<Real>(z, -1, 1);
  }
};

}  // namespace

template <class Real>
const BasisTables<Real>& basis_tables() {
  static const BasisTables<Real> tables = make_tables<Real>();
  return tables;
}

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
  const Mapped<Real> p(kind, x, y, z);
  Real c = 1, s = 0;
  for (int m = 0; m < order_; ++m) {
    Real q = t.start(kind)[static_cast<std::size_t>(m)], before = 0;
    for (int l = m; l < order_; ++l) {
      const std::size_t i = static_cast<std::size_t>(harmonic_index(l, m));
      if (l > m) {
        const Real next = t.a[i] * p.z * q - t.b[i] * before;
        before = q;
        q = next;
      }
      if (m > 0) out[harmonic_index(l, -m)] = q * s;
      out[i] = q * c;
    }
    const Real turned = p.x * c - p.y * s;
    s = p.x * s + p.y * c;
    c = turned;
  }
}

template <class Real>
void HarmonicBasis<Real>::evaluate(BasisKind kind, Real x, Real y, Real z, Real* out, Real* gx, Real* gy,
                                   Real* gz) const {
  const BasisTables<Real>& t = basis_tables<Real>();
  const bool hemisphere = kind == BasisKind::hsh;
  const Mapped<Real> p(kind, x, y, z);
  x = clamp<Real>(x, -1, 1);
  y = clamp<Real>(y, -1, 1);
  z = clamp<Real>(z, hemisphere ? 0 : -1, 1);

  // (C_m, S_m), and for HSH also (C_m, S_m) / h^2: 4 (2h)^(m-2) (x + iy)^m, which diverges for m = 1 alone.
  Real c[kMaxOrder], s[kMaxOrder], c_h2[kMaxOrder] = {}, s_h2[kMaxOrder] = {};
  c[0] = 1;
  s[0] = 0;
  for (int m = 1; m < order_; ++m) {
    c[m] = p.x * c[m - 1] - p.y * s[m - 1];
    s[m] = p.x * s[m - 1] + p.y * c[m - 1];
    if (m == 1 && p.h > 0) {
      c_h2[m] = 2 * x / p.h;
      s_h2[m] = 2 * y / p.h;
    } else if (m == 2) {
      c_h2[m] = 4 * (x * x - y * y);
      s_h2[m] = 8 * x * y;
    } else if (m > 2) {
      c_h2[m] = p.x * c_h2[m - 1] - p.y * s_h2[m - 1];
      s_h2[m] = p.x * s_h2[m - 1] + p.y * c_h2[m - 1];
    }
  }

  Real column[2][kMaxOrder];  // Q_l^m of m and of m + 1
  for (int m = order_ - 1; m >= 0; --m) {
    Real* const q = column[m & 1];
    const Real* const q_next = column[~m & 1];
    for (int l = m; l < order_; ++l) {
      const std::size_t i = static_cast<std::size_t>(harmonic_index(l, m));
      q[l] = l == m ? t.start(kind)[static_cast<std::size_t>(m)]
                    : t.a[i] * p.z * q[l - 1] - t.b[i] * (l > m + 1 ? q[l - 2] : 0);
      const Real dq = l > m ? t.d[i] * q_next[l] : 0;
      // One function f = Q(z) B(x, y) of the mapped direction, from B, its derivatives and B / h^2.
      const auto put = [&](int index, Real b, Real b_x, Real b_y, Real b_h2) {
        Real fx = q[l] * b_x, fy = q[l] * b_y, fz = dq * b, along;
        if (hemisphere) {
          const Real up = 1 + z, euler = static_cast<Real>(m) * q[l];  // x B_x + y B_y = m B
          fx *= 2 * p.h;
          fy *= 2 * p.h;
          fz = 2 * fz;
          along = x * fx + y * fy + (euler * b / (2 * up) + z * fz);
          fz += euler * b_h2 / (2 * up * up);
        } else {
          along = x * fx + y * fy + z * fz;
        }
        out[index] = q[l] * b;
        gx[index] = fx - x * along;
        gy[index] = fy - y * along;
        if (gz) gz[index] = fz - z * along;
      };
      const Real k = static_cast<Real>(m), below_c = m > 0 ? c[m - 1] : 0, below_s = m > 0 ? s[m - 1] : 0;
      put(harmonic_index(l, m), c[m], k * below_c, -k * below_s, c_h2[m]);
      if (m > 0) put(harmonic_index(l, -m), s[m], k * below_s, k * below_c, s_h2[m]);
    }
  }
}

template <class Real>
void HarmonicBasis<Real>::evaluate_batch(BasisKind kind, std::size_t n, const Real* x, const Real* y,
                                         const Real* z, Real* out) const {
  Real values[harmonic_count(kMaxOrder)];
  for (std::size_t k = 0; k < n; ++k) {
    evaluate(kind, x[k], y[k], z[k], values);
    for (int i = 0; i < count(); ++i) out[static_cast<std::size_t>(i) * n + k] = values[i];
  }
}

template const BasisTables<float>& basis_tables<float>();
template const BasisTables<double>& basis_tables<double>();
template class HarmonicBasis<float>;
template class HarmonicBasis<double>;

}  // namespace phos
