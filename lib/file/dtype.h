// The types of a tensor's numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/half.h"

namespace phos::inline file {

enum class Dtype { u8, u16, i32, u32, i64, u64, f32, f64, i8, f16 };
/// All of them, in order.
inline constexpr Dtype kDtypes[] = {Dtype::u8,  Dtype::u16, Dtype::i32, Dtype::u32, Dtype::i64,
                                    Dtype::u64, Dtype::f32, Dtype::f64, Dtype::i8,  Dtype::f16};
std::size_t dtype_size(Dtype);
const char* dtype_name(Dtype);  ///< "U8", "F32", ... as safetensors writes them

template <class T>
constexpr Dtype dtype_of();
template <>
constexpr Dtype dtype_of<std::uint8_t>() {
  return Dtype::u8;
}
template <>
constexpr Dtype dtype_of<std::int8_t>() {
  return Dtype::i8;
}
template <>
constexpr Dtype dtype_of<std::uint16_t>() {
  return Dtype::u16;
}
template <>
constexpr Dtype dtype_of<std::int32_t>() {
  return Dtype::i32;
}
template <>
constexpr Dtype dtype_of<std::uint32_t>() {
  return Dtype::u32;
}
template <>
constexpr Dtype dtype_of<std::int64_t>() {
  return Dtype::i64;
}
template <>
constexpr Dtype dtype_of<std::uint64_t>() {
  return Dtype::u64;
}
template <>
constexpr Dtype dtype_of<Half>() {
  return Dtype::f16;
}
template <>
constexpr Dtype dtype_of<float>() {
  return Dtype::f32;
}
template <>
constexpr Dtype dtype_of<double>() {
  return Dtype::f64;
}

/// Are such numbers floats of any size?
constexpr bool is_float(Dtype dtype) {
  return dtype == Dtype::f16 || dtype == Dtype::f32 || dtype == Dtype::f64;
}

/// Calls visit(T()) with the type of such numbers.
template <class Visit>
auto with_type_of(Dtype dtype, const Visit& visit) {
  switch (dtype) {
    case Dtype::u8:
      return visit(std::uint8_t());
    case Dtype::i8:
      return visit(std::int8_t());
    case Dtype::u16:
      return visit(std::uint16_t());
    case Dtype::i32:
      return visit(std::int32_t());
    case Dtype::u32:
      return visit(std::uint32_t());
    case Dtype::i64:
      return visit(std::int64_t());
    case Dtype::u64:
      return visit(std::uint64_t());
    case Dtype::f16:
      return visit(Half());
    case Dtype::f32:
      return visit(float());
    case Dtype::f64:
      break;
  }
  return visit(double());
}

}  // namespace phos::inline file
