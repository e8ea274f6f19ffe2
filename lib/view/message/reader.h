// Reading a message that anybody may have sent (view/message/format.h).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "view/message/format.h"

namespace phos::inline view {

/// Does a message state this kind? It may be damaged nevertheless.
bool states_kind(std::string_view bytes, MessageKind kind);

class MessageReader {
 public:
  /// Throws Error(bad_input) unless `bytes` are a whole message of this kind: header, lengths, rows of the
  /// tables, numbers (finite, or NaN where a field may be unknown), and references within their tables. Needs
  /// no more memory than the message. Keeps a reference to `bytes`.
  MessageReader(std::string_view bytes, MessageKind kind);

  std::size_t rows(std::string_view table) const;
  /// All values of a field, row by row. Aborts for a field that the kind lacks, or of another type.
  std::vector<float> floats(std::string_view table, std::string_view name) const;
  std::vector<std::uint32_t> numbers(std::string_view table, std::string_view name) const;
  std::string_view bytes(std::string_view table, std::string_view name) const;

 private:
  struct Part {
    std::size_t rows = 0;
    std::string_view values;
  };
  void read_parts(std::string_view rest);
  void require_even_tables() const;
  void require_sound(const MessageField& field, const Part& part) const;
  const Part& part(std::string_view table, std::string_view name, FieldType type) const;

  const MessageLayout& layout_;
  std::vector<Part> parts_;  // of each field
};

}  // namespace phos::inline view
