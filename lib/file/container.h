// The one container of every cache: safetensors layout, with phos metadata.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/json.h"
#include "core/vector.h"
#include "file/dtype.h"
#include "file/hash.h"
#include "file/kinds/kind.h"
#include "file/kinds/shape_pattern.h"
#include "file/provenance.h"

namespace phos::inline file {

struct Tensor {
  Dtype dtype = Dtype::f32;
  Shape shape;
  std::string unit;  ///< "m", "lx", "1", ...
  std::span<const std::byte> bytes;
  std::uint64_t elements() const;
};

/// Is this a phos file, or the beginning of one, which readers call truncated (by its content; false for a
/// missing or unreadable one)?
bool is_container(const std::string& path);

/// An open file, memory-mapped. Reading never trusts the file: sizes, offsets, overlaps and dtypes are
/// checked on open; checksums by verify(). Copies share the mapping.
class Container {
 public:
  /// Throws Error(bad_input) naming the fault: missing, not a phos file, truncated, damaged, another
  /// major version, a kind that this version does not know. Where a kind is given, another one is an error
  /// that names both.
  static Container open(const std::string& path, std::optional<FileKind> kind = {});

  const std::string& path() const;
  const Provenance& provenance() const;
  FileKind kind() const { return provenance().kind; }
  FileForm form() const { return form_of(provenance().extra); }
  bool has(const std::string& tensor) const;
  const std::map<std::string, Tensor>& tensors() const;

  /// The tensor's values, in place. Throws Error(bad_input) if it is absent, of another dtype, or its shape
  /// does not match `shape` (0 = any extent). Alignment is guaranteed.
  template <class T>
  std::span<const T> values(const std::string& name, const Shape& shape) const {
    const Tensor& t = require(name, dtype_of<T>(), shape);
    return {reinterpret_cast<const T*>(t.bytes.data()), t.bytes.size() / sizeof(T)};
  }
  /// An [n,3] f32 tensor as vectors.
  std::span<const Vec3> vectors(const std::string& name) const {
    const std::span<const float> v = values<float>(name, {0, 3});
    return {reinterpret_cast<const Vec3*>(v.data()), v.size() / 3};
  }
  /// Checks every tensor's checksum. Throws Error(bad_input) naming the first that differs.
  void verify() const;
  /// verify(), and checks that every tensor is there, with numbers as the table of the kind
  /// (file/kinds/tensor_row.h) says. Throws Error(bad_input) naming the first that is not. Looks only once.
  void require_sound() const;
  /// The same, one tensor after another, with about `window` bytes of the file in memory at a time; looks
  /// anew at each call.
  void require_sound_in(std::size_t window) const;
  /// Takes a part of the file, such as rows of a tensor, out of memory until it is read again.
  void release(std::span<const std::byte> part) const;

 private:
  const Tensor& require(const std::string& name, Dtype dtype, const Shape& shape) const;
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// Collects any columns and writes them atomically; TensorWriter (file/kinds/tensor_io.h) writes the columns
/// of a kind. Spans must stay alive until write().
class ContainerWriter {
 public:
  template <class T>
  void add(const std::string& name, std::span<const T> values, Shape shape, const std::string& unit) {
    add(name, {dtype_of<T>(), std::move(shape), unit, std::as_bytes(values)});
  }
  void add_vectors(const std::string& name, std::span<const Vec3> v, const std::string& unit) {
    add<float>(name, {reinterpret_cast<const float*>(v.data()), 3 * v.size()}, {v.size(), 3}, unit);
  }
  void add(const std::string& name, Tensor tensor);
  /// Same tensors and provenance give the same bytes. Throws Error(bad_input) if it cannot be written.
  void write(const std::string& path, const Provenance& provenance) const;
  /// The same for tensors that all lie in mapped files (ScratchFile): their pages leave memory behind the
  /// writer.
  void write_mapped(const std::string& path, const Provenance& provenance) const;

 private:
  void write(const std::string& path, const Provenance& provenance, bool mapped) const;
  std::map<std::string, Tensor> tensors_;
};

static_assert(sizeof(Vec3) == 12);

}  // namespace phos::inline file
