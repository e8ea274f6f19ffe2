#include "view/message/writer.h"

#include <bit>
#include <cstring>
#include <map>

#include "core/error.h"

namespace phos::inline view {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are little-endian");

template <class T>
void append(std::string& s, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  s.append(bytes, sizeof value);
}

}  // namespace

MessageWriter::MessageWriter(MessageKind kind) : layout_(layout_of(kind)), values_(layout_.fields.size()) {}

void MessageWriter::add_bytes(std::string_view table, std::string_view name, FieldType type, const void* data,
                              std::size_t bytes) {
  for (std::size_t i = 0; i < layout_.fields.size(); ++i) {
    const MessageField& field = layout_.fields[i];
    if (field.table != table || field.name != name) continue;
    PHOS_CHECK(field.type == type && bytes % (bytes_of(type) * field.components) == 0, table, ".", name, ": ",
               bytes, " bytes");
    values_[i].assign(static_cast<const char*>(data), bytes);
    return;
  }
  PHOS_CHECK(false, layout_.name, " has no ", table, ".", name);
}

void MessageWriter::add(std::string_view table, std::string_view name, std::span<const float> values) {
  add_bytes(table, name, FieldType::f32, values.data(), values.size_bytes());
}

void MessageWriter::add(std::string_view table, std::string_view name,
                        std::span<const std::uint32_t> values) {
  add_bytes(table, name, FieldType::u32, values.data(), values.size_bytes());
}

void MessageWriter::add(std::string_view table, std::string_view name, std::span<const std::uint8_t> values) {
  add_bytes(table, name, FieldType::u8, values.data(), values.size_bytes());
}

void MessageWriter::add(std::string_view table, std::string_view name, const std::vector<Vec3>& values) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float));
  add_bytes(table, name, FieldType::f32, values.data(), values.size() * sizeof(Vec3));
}

std::string MessageWriter::message() const {
  std::string s(kMessageMagic);
  append(s, kMessageVersion);
  append(s, static_cast<std::uint16_t>(layout_.kind));
  append(s, std::uint64_t{0});
  std::map<std::string_view, std::uint64_t> rows_of;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const MessageField& field = layout_.fields[i];
    const std::uint64_t rows = values_[i].size() / (bytes_of(field.type) * field.components);
    if (rows > 0 || !field.optional) {
      const auto [known, first] = rows_of.emplace(field.table, rows);
      PHOS_CHECK(first || known->second == rows, field.table, ".", field.name, ": ", rows, " rows");
    }
    append(s, rows);
    s += values_[i];
    s.resize((s.size() + 7) / 8 * 8, '\0');
  }
  const std::uint64_t bytes = s.size();
  std::memcpy(s.data() + kMessageHeaderBytes - sizeof bytes, &bytes, sizeof bytes);
  return s;
}

}  // namespace phos::inline view
