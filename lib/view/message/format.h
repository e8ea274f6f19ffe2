// What phos-view and its page send each other: every kind of message and every field of it, as one table. The
// C++ writer and reader and the script of the page (/format.json) all go by this table.
//
// A message is little-endian:
//   magic    u8[4]  "phov"
//   version  u16    kMessageVersion
//   kind     u16    MessageKind
//   bytes    u64    of the whole message
//   then each field of the kind, in the order of the table:
//     rows   u64
//     values rows x components of the type, row by row; zeros up to a multiple of 8 bytes
// The fields of one table have the same number of rows. An optional field may have no rows instead. Numbers
// are finite.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace phos::inline view {

inline constexpr std::string_view kMessageMagic = "phov";
inline constexpr std::uint16_t kMessageVersion = 2;
inline constexpr std::size_t kMessageHeaderBytes = 16;

enum class MessageKind : std::uint16_t {
  scene = 1,     ///< to the page: geometry, materials, lamps, cameras
  records = 2,   ///< to the page: irradiance records
  question = 3,  ///< to the server: the light where a ray lands
  reading = 4,   ///< to the page: the answer
  gloss = 7,     ///< to the page: radiance records, and the lobes that read them
};

enum class FieldType : std::uint8_t { u8, u32, f32 };

struct MessageField {
  std::string_view table, name;
  FieldType type = FieldType::f32;
  unsigned components = 1;
  std::string_view unit;            ///< "" for numbers without one
  std::string_view meaning;         ///< with the values of flags and kinds
  bool optional = false;            ///< no rows: every row has the value that `meaning` states
  bool may_be_unknown = false;      ///< a number may be NaN: it is not known
  std::string_view refers_to = {};  ///< table whose rows the numbers count; kNoRow: none
};

/// Of a field that refers to a table: to none of its rows.
inline constexpr std::uint32_t kNoRow = 0xffffffff;

// Values of fields. The shape of a sample is a PlaceShape (splat/direct/lamp_places.h).
enum MaterialFlag : std::uint32_t {
  kTwoSidedEmission = 1,
  kMasked = 2,  ///< alpha below the cutoff is a hole
  kClear = 4,   ///< more light passes than is reflected: drawn see-through, and throws no shadow
};
/// Lobes in which lamps shine.
enum class GlintKind : std::uint32_t { none = 0, phong = 1, ggx = 2, ward = 3 };
/// Cosines of incidence of the table `specular`, and numbers of a row.
inline constexpr unsigned kSpecularCosines = 33, kSpecularFloats = 3 * kSpecularCosines;
/// Sides of the table of the sky.
inline constexpr unsigned kSkyColumns = 256, kSkyRows = 128;

struct MessageLayout {
  MessageKind kind;
  std::string_view name;
  std::span<const MessageField> fields;
};

std::span<const MessageLayout> message_layouts();
const MessageLayout& layout_of(MessageKind kind);
/// Bytes of a component.
std::size_t bytes_of(FieldType type);
/// The table for the page: {"version":1,"kinds":[{"kind":1,"name":"scene","fields":[{"table":..,...}]}]}
std::string message_format_json();

}  // namespace phos::inline view
