// The message of a packed one (view/static/packed_message.h), by code of its own.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "view/static/coding.h"

namespace phos::test {

class Unpacker {
 public:
  explicit Unpacker(std::string_view packed) : rest_(packed) {}

  std::string message() {
    message_ = "phov" + std::string(rest_.substr(4, 12));
    rest_.remove_prefix(16);
    while (!rest_.empty()) unpack_field();
    return message_;
  }

 private:
  template <class T>
  T take() {
    T value;
    if (rest_.size() < sizeof value) throw std::runtime_error("cut off");
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  template <class T>
  void put(T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    message_.append(bytes.data(), bytes.size());
  }
  /// Component by component, as they are stored.
  std::vector<std::uint32_t> take_numbers(std::size_t count, bool differences) {
    std::vector<std::uint32_t> values(count);
    for (unsigned shift = 0; shift < 32; shift += 8)
      for (std::uint32_t& value : values) value |= std::uint32_t{take<std::uint8_t>()} << shift;
    std::uint32_t sum = 0;
    if (differences)
      for (std::uint32_t& value : values) value = sum += value % 2 ? ~(value / 2) : value / 2;
    return values;
  }

  void unpack_field() {
    const auto rows = static_cast<std::size_t>(take<std::uint64_t>());
    const auto coding = take<Coding>();
    const auto bits = take<std::uint8_t>();
    const std::size_t components = take<std::uint16_t>(), count = rows * components;
    if (take<std::uint32_t>() != 0) throw std::runtime_error("no zeros");
    put(std::uint64_t{rows});
    if (coding == Coding::bytes) {
      std::string values(count, '\0');
      std::uint8_t sum = 0;
      for (char& value : values)
        value = static_cast<char>(sum = static_cast<std::uint8_t>(sum + take<std::uint8_t>()));
      for (std::size_t i = 0; i < count; ++i) message_ += values[i % components * rows + i / components];
    } else {
      std::vector<Vec2> ends;
      if (coding == Coding::box)
        for (std::size_t c = 0; c < components; ++c) {
          const float lo = take<float>();
          ends.emplace_back(lo, take<float>());
        }
      const std::vector<std::uint32_t> values = take_numbers(count, coding != Coding::rounded);
      for (std::size_t i = 0; i < rows; ++i) {
        if (coding == Coding::octahedral) {
          put(decode_octahedral(values[i] | values[rows + i] << 16));
          continue;
        }
        for (std::size_t c = 0; c < components; ++c) {
          const std::uint32_t value = values[c * rows + i];
          if (coding != Coding::box) {
            put(value);
            continue;
          }
          const double lo = static_cast<double>(ends[c].x), hi = static_cast<double>(ends[c].y);
          put(static_cast<float>(lo + (hi - lo) * (value / static_cast<double>((1u << bits) - 1))));
        }
      }
    }
    message_.resize((message_.size() + 7) / 8 * 8, '\0');
  }

  std::string_view rest_;
  std::string message_;
};

}  // namespace phos::test
