// The precision that a static page keeps of each field of a message: one table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "view/message/format.h"

namespace phos::inline view {

/// How a field is stored. The number is the one in the file.
enum class Coding : std::uint8_t {
  bytes = 0,       ///< u8, exact
  numbers = 1,     ///< u32, exact
  rounded = 2,     ///< f32, rounded to a number of bits after the leading one; 23: exact
  box = 3,         ///< f32, in even steps from the least value of its component to the greatest
  octahedral = 4,  ///< a unit vector, to 1e-4 rad (encode_octahedral())
};

struct FieldCoding {
  Coding coding = Coding::rounded;
  unsigned bits = 0;  ///< of rounded after the leading one, of box in all; 1 to 24
};

struct CodedField {
  MessageKind kind;
  std::string_view table, name;
  FieldCoding coding;
};

/// The fields that lose precision.
std::span<const CodedField> coded_fields();
/// Of any field of a kind: exact where coded_fields() lacks it.
FieldCoding coding_of(MessageKind kind, const MessageField& field);

/// To the nearest number with this many bits after the leading one (0 to 23), halves away from zero: off by
/// 2^-(bits + 1) of it at most. Towards zero where that is beyond the greatest float. Not-a-number and
/// numbers below 2^-126 may lose more.
float rounded_to(float value, unsigned bits);
/// The step, 0 to 2^bits - 1, nearest to a value from lo to hi; 0 where these are equal. At most 24 bits.
std::uint32_t step_of(float value, float lo, float hi, unsigned bits);

}  // namespace phos::inline view
