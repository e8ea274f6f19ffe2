#include "view/message/reader.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace phos::inline view {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are little-endian");

template <class T>
T value_at(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <class T>
std::vector<T> values_in(std::string_view bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

template <class... Args>
[[noreturn]] void refuse(const Args&... args) {
  throw Error(ExitCode::bad_input, "message", text(args...));
}

}  // namespace

bool states_kind(std::string_view bytes, MessageKind kind) {
  return bytes.size() >= kMessageHeaderBytes &&
         value_at<std::uint16_t>(bytes, 6) == static_cast<std::uint16_t>(kind);
}

MessageReader::MessageReader(std::string_view bytes, MessageKind kind)
    : layout_(layout_of(kind)), parts_(layout_.fields.size()) {
  if (bytes.size() < kMessageHeaderBytes) refuse("is cut off within its header");
  if (bytes.substr(0, kMessageMagic.size()) != kMessageMagic) refuse("does not begin with ", kMessageMagic);
  if (const auto version = value_at<std::uint16_t>(bytes, 4); version != kMessageVersion)
    refuse("is of version ", version, ", not of ", kMessageVersion, "; load the page anew");
  if (const auto is = value_at<std::uint16_t>(bytes, 6); is != static_cast<std::uint16_t>(kind))
    refuse("is of kind ", is, ", not of ", static_cast<int>(kind), " (", layout_.name, ")");
  if (const auto stated = value_at<std::uint64_t>(bytes, 8); stated != bytes.size())
    refuse("states ", stated, " bytes and has ", bytes.size());
  read_parts(bytes.substr(kMessageHeaderBytes));
  require_even_tables();
  for (std::size_t i = 0; i < parts_.size(); ++i) require_sound(layout_.fields[i], parts_[i]);
}

void MessageReader::read_parts(std::string_view rest) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const MessageField& field = layout_.fields[i];
    if (rest.size() < 8) refuse("is cut off before ", field.table, ".", field.name);
    const auto rows = value_at<std::uint64_t>(rest, 0);
    rest.remove_prefix(8);
    const std::size_t row_bytes = bytes_of(field.type) * field.components;
    if (rows > rest.size() / row_bytes) refuse("is cut off within ", field.table, ".", field.name);
    const std::size_t bytes = static_cast<std::size_t>(rows) * row_bytes, padded = (bytes + 7) / 8 * 8;
    if (padded > rest.size()) refuse("is cut off after ", field.table, ".", field.name);
    parts_[i] = {static_cast<std::size_t>(rows), rest.substr(0, bytes)};
    if (rest.substr(bytes, padded - bytes).find_first_not_of('\0') != std::string_view::npos)
      refuse("has no zeros after ", field.table, ".", field.name);
    rest.remove_prefix(padded);
  }
  if (!rest.empty()) refuse("has ", rest.size(), " bytes after its last field");
}

void MessageReader::require_even_tables() const {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const MessageField& field = layout_.fields[i];
    const std::size_t rows = this->rows(field.table);
    if (parts_[i].rows != rows && !(field.optional && parts_[i].rows == 0))
      refuse("has ", parts_[i].rows, " rows of ", field.table, ".", field.name, ", and the table has ", rows);
  }
}

void MessageReader::require_sound(const MessageField& field, const Part& part) const {
  const std::size_t size = part.values.size() / bytes_of(field.type);
  if (field.type == FieldType::f32)
    for (std::size_t i = 0; i < size; ++i) {
      const auto value = value_at<float>(part.values, i * sizeof(float));
      if (!std::isfinite(value) && !(field.may_be_unknown && std::isnan(value)))
        refuse("has a number that is not finite: row ", i / field.components, " of ", field.table, ".",
               field.name);
    }
  if (field.refers_to.empty()) return;
  const std::size_t most = rows(field.refers_to);
  for (std::size_t i = 0; i < size; ++i)
    if (const auto value = value_at<std::uint32_t>(part.values, i * 4); value >= most && value != kNoRow)
      refuse("refers to row ", value, " of ", field.refers_to, ", which has ", most, ": row ",
             i / field.components, " of ", field.table, ".", field.name);
}

std::size_t MessageReader::rows(std::string_view table) const {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (layout_.fields[i].table == table && !layout_.fields[i].optional) return parts_[i].rows;
  PHOS_CHECK(false, layout_.name, " has no table ", table);
}

const MessageReader::Part& MessageReader::part(std::string_view table, std::string_view name,
                                               FieldType type) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const MessageField& field = layout_.fields[i];
    if (field.table == table && field.name == name && field.type == type) return parts_[i];
  }
  PHOS_CHECK(false, layout_.name, " has no ", table, ".", name);
}

std::vector<float> MessageReader::floats(std::string_view table, std::string_view name) const {
  return values_in<float>(part(table, name, FieldType::f32).values);
}

std::vector<std::uint32_t> MessageReader::numbers(std::string_view table, std::string_view name) const {
  return values_in<std::uint32_t>(part(table, name, FieldType::u32).values);
}

std::string_view MessageReader::bytes(std::string_view table, std::string_view name) const {
  return part(table, name, FieldType::u8).values;
}

}  // namespace phos::inline view
