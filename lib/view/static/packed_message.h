// A message (view/message/format.h) in the form that a static page holds, for a compressor.
//
// Little-endian:
//   magic    u8[4]  "phop"
//   version  u16    of the message
//   kind     u16    MessageKind
//   bytes    u64    of the message
//   then each field of the kind, in the order of its table:
//     rows        u64
//     coding      u8      Coding
//     bits        u8      of FieldCoding
//     components  u16     of a row as it is stored: two of an octahedral vector
//     zeros       u8[4]
//     box alone: the least and the greatest value of each component, f32[2]
//     values
// Values stand component by component, and within a component row by row, as numbers of one byte (Coding::
// bytes) or four. Of these, all lowest bytes stand first, then all second bytes, and so on. Coding::rounded
// stores the bits of the float. The others store the difference to the number before it, modulo its range;
// that of a number of four bytes with the sign in the lowest bit (0, -1, 1, -2, ...).
// The page makes the message of it: lib/view/page/unpack.js.
#pragma once

#include <string>
#include <string_view>

namespace phos::inline view {

inline constexpr std::string_view kPackedMagic = "phop";

/// Does a file begin as a message does?
bool is_message(std::string_view bytes);
/// Values lose the precision that coding_of() lets go of. Throws Error(bad_input) for bytes that are no whole
/// message.
std::string packed_message(std::string_view message);

}  // namespace phos::inline view
