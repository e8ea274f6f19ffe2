#include "file/kinds/tensor_io.h"

#include "core/error.h"
#include "file/kinds/sound.h"

namespace phos::inline file {

void TensorWriter::add_bytes(const std::string& name, Dtype dtype, std::span<const std::byte> bytes) {
  const TensorRow* row = find_row(kind_, name);
  PHOS_CHECK(row, "tensor \"", name, "\" has no row in the table of ", name_of(kind_));
  PHOS_CHECK(row->has_type(dtype), name, " is ", dtype_name(dtype), ", not ", type_words(*row));
  Shape shape = shape_of(*row, table_of(name), bytes.size() / dtype_size(dtype), extents_);
  const std::string_view unit = dtype == row->dtype ? row->unit : row->compact->unit;
  file_.add(name, {dtype, std::move(shape), std::string(unit), bytes});
}

void TensorWriter::complete(Provenance& provenance) const {
  provenance.kind = kind_;
  provenance.version = row_of(kind_).version;
}

void TensorWriter::write(const std::string& path, Provenance provenance) const {
  complete(provenance);
  file_.write(path, provenance);
}

void TensorWriter::write_mapped(const std::string& path, Provenance provenance) const {
  complete(provenance);
  file_.write_mapped(path, provenance);
}

TensorReader::TensorReader(const Container& file) : file_(file), extents_(require_layout(file)) {}

std::uint64_t TensorReader::extent(const std::string& symbol) const {
  const auto found = extents_.find(symbol);
  return found == extents_.end() ? 0 : found->second;
}

Dtype TensorReader::type_of(const std::string& name) const { return require_tensor(file_, name).dtype; }

const Tensor& TensorReader::require(const std::string& name, Dtype dtype) const {
  const TensorRow* row = find_row(file_.provenance().kind, name);
  PHOS_CHECK(row && row->has_type(dtype), name, " is read as ", dtype_name(dtype), " from a file of ",
             name_of(file_.provenance().kind));
  const Tensor& tensor = require_tensor(file_, name);
  PHOS_CHECK(tensor.dtype == dtype, name, " is read as ", dtype_name(dtype), " and is ",
             dtype_name(tensor.dtype));
  return tensor;
}

}  // namespace phos::inline file
