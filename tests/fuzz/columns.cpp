#include "columns.h"

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/layout.h"
#include "reading.h"

namespace phos::fuzz {
namespace {

template <class T>
void add_as(ContainerWriter& file, const std::string& name, const Column& c) {
  file.add<T>(name, {reinterpret_cast<const T*>(c.bytes.data()), c.bytes.size() / sizeof(T)}, c.shape,
              c.unit);
}

void add(ContainerWriter& file, const std::string& name, const Column& c) {
  switch (c.dtype) {
    case Dtype::u8:
      return add_as<std::uint8_t>(file, name, c);
    case Dtype::u16:
      return add_as<std::uint16_t>(file, name, c);
    case Dtype::i32:
      return add_as<std::int32_t>(file, name, c);
    case Dtype::u32:
      return add_as<std::uint32_t>(file, name, c);
    case Dtype::i64:
      return add_as<std::int64_t>(file, name, c);
    case Dtype::u64:
      return add_as<std::uint64_t>(file, name, c);
    case Dtype::f32:
      return add_as<float>(file, name, c);
    case Dtype::f64:
      return add_as<double>(file, name, c);
  }
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
