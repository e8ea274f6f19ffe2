// Writing and reading tensors as the table of their kind says.
#pragma once

#include <span>
#include <string>

#include "file/container.h"
#include "file/kinds/shape_pattern.h"

namespace phos::inline file {

/// Collects the tensors of a file of one kind. Type, shape and unit come from the rows of the table. Aborts
/// for a tensor without a row, with another type, or with numbers that do not fill the row's shape. Spans
/// must stay alive until write().
class TensorWriter {
 public:
  explicit TensorWriter(FileKind kind) : kind_(kind) {}
  /// The extent that a symbol of shapes stands for. An extent that is not stated follows from the first
  /// tensor whose shape holds the symbol.
  void extent(const std::string& symbol, std::uint64_t n) { extents_[symbol] = n; }
  template <class T>
  void add(const std::string& name, std::span<const T> values) {
    add_bytes(name, dtype_of<T>(), std::as_bytes(values));
  }
  /// A tensor of floats whose rows end in three numbers.
  void add_vectors(const std::string& name, std::span<const Vec3> v) {
    add_bytes(name, Dtype::f32, std::as_bytes(v));
  }
  /// As ContainerWriter::write(), with the kind and the version of the table.
  void write(const std::string& path, Provenance provenance) const;
  /// As ContainerWriter::write_mapped().
  void write_mapped(const std::string& path, Provenance provenance) const;

 private:
  void complete(Provenance& provenance) const;
  void add_bytes(const std::string& name, Dtype dtype, std::span<const std::byte> bytes);
  FileKind kind_;
  Extents extents_;
  ContainerWriter file_;
};

/// The tensors of a file, present and shaped as the table of its kind says. Container::require_sound() checks
/// their values.
class TensorReader {
 public:
  /// Throws Error(bad_input) as require_layout().
  explicit TensorReader(const Container& file);
  const Container& file() const { return file_; }
  bool has(const std::string& name) const { return file_.has(name); }
  /// The type of its numbers: the type of the row, or the compact type. Throws Error(bad_input) where the
  /// file has no such tensor.
  Dtype type_of(const std::string& name) const;
  /// The extent that a symbol of shapes stands for; 0 where no tensor of the file has the symbol.
  std::uint64_t extent(const std::string& symbol) const;
  /// The numbers in place. Throws Error(bad_input) where the file has no such tensor. Aborts for a tensor
  /// without a row, or that has not the type T.
  template <class T>
  std::span<const T> values(const std::string& name) const {
    const Tensor& t = require(name, dtype_of<T>());
    return {reinterpret_cast<const T*>(t.bytes.data()), t.bytes.size() / sizeof(T)};
  }
  /// Floats whose rows end in three numbers.
  std::span<const Vec3> vectors(const std::string& name) const {
    const std::span<const float> v = values<float>(name);
    return {reinterpret_cast<const Vec3*>(v.data()), v.size() / 3};
  }

 private:
  const Tensor& require(const std::string& name, Dtype dtype) const;
  Container file_;
  Extents extents_;
};

}  // namespace phos::inline file
