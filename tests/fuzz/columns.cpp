#include "columns.h"

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/layout.h"
#include "reading.h"

namespace phos::fuzz {
namespace {

void add(ContainerWriter& file, const std::string& name, const Column& c) {
  file.add(name, {c.dtype, c.shape, c.unit, c.bytes});
}

}  // namespace

std::size_t Column::row_bytes() const {
  if (shape.empty()) return 0;
  std::size_t n = dtype_size(dtype);
  for (std::size_t i = 1; i < shape.size(); ++i) n *= static_cast<std::size_t>(shape[i]);
  return n;
}

void Column::settle_rows() {
  const std::size_t row = row_bytes();
  if (row == 0) return;
  shape[0] = bytes.size() / row;
  bytes.resize(static_cast<std::size_t>(shape[0]) * row);
}

std::optional<Columns> take_apart(std::string_view bytes) {
  const auto file = std::as_bytes(std::span(bytes.data(), bytes.size()));
  try {
    const LayoutHeader header = read_layout_header(file, "input");
    Columns all{from_metadata(header.metadata, "input"), {}};
    for (const auto& [name, tensor] : read_layout_tensors(header, file, "input"))
      if (!name.empty())
        all.column[name] = {
            tensor.dtype, tensor.shape, tensor.unit, {tensor.bytes.begin(), tensor.bytes.end()}};
    return all;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string sealed(const Columns& columns) {
  ContainerWriter file;
  for (const auto& [name, column] : columns.column) add(file, name, column);
  const std::string path = scratch() + "/sealed";
  file.write(path, columns.provenance);
  return read_text(path);
}

}  // namespace phos::fuzz
