// The types of a tensor's numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace phos::inline file {

enum class Dtype { u8, u16, i32, u32, i64, u64, f32, f64 };
std::size_t dtype_size(Dtype);
const char* dtype_name(Dtype);  ///< "U8", "F32", ... as safetensors writes them

template <class T>
constexpr Dtype dtype_of();
template <>
constexpr Dtype dtype_of<std::uint8_t>() {
  return Dtype::u8;
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
constexpr Dtype dtype_of<float>() {
  return Dtype::f32;
}
template <>
constexpr Dtype dtype_of<double>() {
  return Dtype::f64;
}

/// Calls visit(T()) with the type of such numbers.
template <class Visit>
auto with_type_of(Dtype dtype, const Visit& visit) {
  switch (dtype) {
    case Dtype::u8:
      return visit(std::uint8_t());
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
    case Dtype::f32:
      return visit(float());
    case Dtype::f64:
      break;
  }
  return visit(double());
}

}  // namespace phos::inline file
