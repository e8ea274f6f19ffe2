// A container taken apart, and put together again with checksums that are right: what its writer might have
// written, had it meant harm.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "file/container.h"

namespace phos::fuzz {

struct Column {
  Dtype dtype = Dtype::f32;
  Shape shape;
  std::string unit;
  std::vector<std::byte> bytes;
  /// Bytes of one row; 0: there is no row, or it has no size.
  std::size_t row_bytes() const;
  /// As many rows as there are whole ones of the bytes.
  void settle_rows();
};

struct Columns {
  Provenance provenance;
  std::map<std::string, Column> column;
};

/// Nothing if the layout cannot be read; checksums do not count.
std::optional<Columns> take_apart(std::string_view bytes);
/// The file.
std::string sealed(const Columns& columns);

}  // namespace phos::fuzz
