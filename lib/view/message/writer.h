// Writing a message (view/message/format.h).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "view/message/format.h"

namespace phos::inline view {

class MessageWriter {
 public:
  explicit MessageWriter(MessageKind kind);

  /// All values of a field, row by row. Fields may come in any order. Fields that are never added have no
  /// rows. Aborts for a field that the kind lacks, or of another type.
  void add(std::string_view table, std::string_view name, std::span<const float> values);
  void add(std::string_view table, std::string_view name, std::span<const std::uint32_t> values);
  void add(std::string_view table, std::string_view name, std::span<const std::uint8_t> values);
  template <class T>
  void add(std::string_view table, std::string_view name, const std::vector<T>& values) {
    add(table, name, std::span<const T>(values));
  }
  void add(std::string_view table, std::string_view name, const std::vector<Vec3>& values);
  /// The message. Aborts where the fields of a table do not have the same number of rows.
  std::string message() const;

 private:
  void add_bytes(std::string_view table, std::string_view name, FieldType type, const void* data,
                 std::size_t bytes);

  const MessageLayout& layout_;
  std::vector<std::string> values_;  // of each field
};

}  // namespace phos::inline view
