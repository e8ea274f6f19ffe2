// record/weight.inc for loops over places: Real is float or a vector of floats, units are given as their
// inverses. Nothing here is shared between sources, because some are compiled for newer machines than others.
// Values of vectors are handed over by value; all functions are inlined, and sources are compiled with
// -Wno-psabi.
#pragma once

#define PHOS_INLINED __attribute__((always_inline)) inline

namespace phos::inline record {
namespace {

/// Numbers of 8 places.
inline constexpr int kLanes = 8;
typedef float Lanes __attribute__((vector_size(4 * kLanes)));

/// A vector at a place, or a vector at each of the places.
template <class Real>
struct LaneVec {
  Real x, y, z;
};

PHOS_INLINED LaneVec<float> of_record(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
template <class Real>
PHOS_INLINED LaneVec<Real> operator+(const LaneVec<Real>& a, const LaneVec<float>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
PHOS_INLINED LaneVec<Real> operator-(const LaneVec<Real>& a, const LaneVec<float>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
PHOS_INLINED A dot(const LaneVec<A>& a, const LaneVec<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
PHOS_INLINED float root(float x) { return __builtin_sqrtf(x); }
PHOS_INLINED Lanes root(Lanes x) {
  for (int k = 0; k < kLanes; ++k) x[k] = __builtin_sqrtf(x[k]);
  return x;
}
template <class Real, class Unit>
PHOS_INLINED Real in_units(Real x, Unit inverse) {
  return x * inverse;
}

#define CONSTANT constexpr
#define FORMULA      \
  template <class R> \
  PHOS_INLINED
#define Real R
#define Vec LaneVec<R>
#define Own float
#define OwnVec LaneVec<float>
#include "record/weight.inc"
#undef CONSTANT
#undef FORMULA
#undef Real
#undef Vec
#undef Own
#undef OwnVec

/// The shares that the axes of a footprint have of a vector (x, y) of the tangent plane, w[k] of axis k.
template <class R>
PHOS_INLINED void shares_of_axes(R x, R y, R* w) {
  w[0] = share_of_axis(x, y), w[4] = share_of_axis(-x, y);
  w[2] = share_of_axis(y, x), w[6] = share_of_axis(-y, x);
  w[1] = share_of_diagonal(x, y), w[3] = share_of_diagonal(-x, y);
  w[5] = share_of_diagonal(-x, -y), w[7] = share_of_diagonal(x, -y);
}

}  // namespace
}  // namespace phos::inline record

#undef PHOS_INLINED
