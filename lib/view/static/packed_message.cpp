#include "view/static/packed_message.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "core/vector.h"
#include "view/message/reader.h"
#include "view/static/coding.h"

namespace phos::inline view {
namespace {

using Numbers = std::vector<std::uint32_t>;

template <class T>
void append(std::string& s, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  s.append(bytes, sizeof value);
}

/// Row by row to component by component.
template <class T>
std::vector<T> by_component(const std::vector<T>& values, std::size_t components) {
  std::vector<T> turned;
  turned.reserve(values.size());
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t i = c; i < values.size(); i += components) turned.push_back(values[i]);
  return turned;
}

/// Differences to the number before, with the sign in the lowest bit.
Numbers differences(const Numbers& values) {
  Numbers coded;
  coded.reserve(values.size());
  std::uint32_t before = 0;
  for (const std::uint32_t value : values) {
    const std::uint32_t difference = value - before;
    coded.push_back(difference << 1 ^ (difference >> 31 ? ~0u : 0u));
    before = value;
  }
  return coded;
}

void add_planes(std::string& s, const Numbers& values) {
  for (int shift = 0; shift < 32; shift += 8)
    for (const std::uint32_t value : values) s += static_cast<char>(value >> shift & 255);
}

Numbers steps(const std::vector<float>& values, std::size_t components, unsigned bits, std::string& ends) {
  Numbers codes(values.size());
  for (std::size_t c = 0; c < components; ++c) {
    float lo = values.empty() ? 0 : values[c], hi = lo;
    for (std::size_t i = c; i < values.size(); i += components)
      lo = std::min(lo, values[i]), hi = std::max(hi, values[i]);
    append(ends, lo), append(ends, hi);
    for (std::size_t i = c; i < values.size(); i += components) codes[i] = step_of(values[i], lo, hi, bits);
  }
  return codes;
}

Numbers directions(const std::vector<float>& unit) {
  Numbers codes;
  for (std::size_t i = 0; i < unit.size(); i += 3) {
    const std::uint32_t both = encode_octahedral({unit[i], unit[i + 1], unit[i + 2]});
    codes.push_back(both & 0xffff), codes.push_back(both >> 16);
  }
  return codes;
}

void add_field(std::string& s, const MessageReader& message, MessageKind kind, const MessageField& field) {
  const FieldCoding coding = coding_of(kind, field);
  const auto floats = [&] { return message.floats(field.table, field.name); };
  std::size_t rows = 0, components = field.components;
  std::string ends, values;
  switch (coding.coding) {
    case Coding::bytes: {
      const std::string_view bytes = message.bytes(field.table, field.name);
      rows = bytes.size() / components;
      char before = 0;
      for (const char byte : by_component(std::vector<char>(bytes.begin(), bytes.end()), components))
        values += static_cast<char>(byte - before), before = byte;
      break;
    }
    case Coding::numbers: {
      const Numbers numbers = message.numbers(field.table, field.name);
      rows = numbers.size() / components;
      add_planes(values, differences(by_component(numbers, components)));
      break;
    }
    case Coding::rounded: {
      Numbers patterns;
      for (const float value : floats())
        patterns.push_back(std::bit_cast<std::uint32_t>(rounded_to(value, coding.bits)));
      rows = patterns.size() / components;
      add_planes(values, by_component(patterns, components));
      break;
    }
    case Coding::box: {
      const Numbers codes = steps(floats(), components, coding.bits, ends);
      rows = codes.size() / components;
      add_planes(values, differences(by_component(codes, components)));
      break;
    }
    case Coding::octahedral: {
      PHOS_CHECK(components == 3, field.table, ".", field.name);
      components = 2;
      const Numbers codes = directions(floats());
      rows = codes.size() / components;
      add_planes(values, differences(by_component(codes, components)));
      break;
    }
  }
  append(s, std::uint64_t{rows});
  append(s, coding.coding);
  append(s, static_cast<std::uint8_t>(coding.bits));
  append(s, static_cast<std::uint16_t>(components));
  append(s, std::uint32_t{0});
  s += ends;
  s += values;
}

}  // namespace

bool is_message(std::string_view bytes) { return bytes.substr(0, kMessageMagic.size()) == kMessageMagic; }

std::string packed_message(std::string_view message) {
  if (message.size() < kMessageHeaderBytes || !is_message(message))
    throw Error(ExitCode::bad_input, "message", text("does not begin with ", kMessageMagic));
  std::uint16_t number = 0;
  std::memcpy(&number, message.data() + kMessageMagic.size() + sizeof number, sizeof number);
  for (const MessageLayout& layout : message_layouts()) {
    if (static_cast<std::uint16_t>(layout.kind) != number) continue;
    const MessageReader reader(message, layout.kind);
    std::string packed(kPackedMagic);
    packed += message.substr(kPackedMagic.size(), kMessageHeaderBytes - kPackedMagic.size());
    for (const MessageField& field : layout.fields) add_field(packed, reader, layout.kind, field);
    return packed;
  }
  throw Error(ExitCode::bad_input, "message", text("is of kind ", number, ", which is none"));
}

}  // namespace phos::inline view
