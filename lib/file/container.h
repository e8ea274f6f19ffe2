// The one container of every cache: safetensors layout, with phos metadata.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/json.h"
#include "core/vector.h"
#include "file/hash.h"

namespace phos::inline file {

enum class Dtype { u8, u16, i32, u32, i64, u64, f32, f64 };
std::size_t dtype_size(Dtype);
const char* dtype_name(Dtype);  ///< "U8", "F32", ... as safetensors writes them

template <class T>
constexpr Dtype dtype_of();
template <>
constexpr Dtype dtype_of<std::uint8_t>() {
  return Dtype::u8;
}
template <>
constexpr Dtype dtype_of<std::uint16_t>() {
  return Dtype::u16;
}
template <>
constexpr Dtype dtype_of<std::int32_t>() {
  return Dtype::i32;
}
template <>
constexpr Dtype dtype_of<std::uint32_t>() {
  return Dtype::u32;
}
template <>
constexpr Dtype dtype_of<std::int64_t>() {
  return Dtype::i64;
}
template <>
constexpr Dtype dtype_of<std::uint64_t>() {
  return Dtype::u64;
}
template <>
constexpr Dtype dtype_of<float>() {
  return Dtype::f32;
}
template <>
constexpr Dtype dtype_of<double>() {
  return Dtype::f64;
}

using Shape = std::vector<std::uint64_t>;

struct Tensor {
  Dtype dtype = Dtype::f32;
  Shape shape;
  std::string unit;  ///< "m", "lx", "1", ...
  std::span<const std::byte> bytes;
  std::uint64_t elements() const;
};

/// What a file says about how it was made (its __metadata__). Nothing volatile.
struct Provenance {
  std::string kind;   ///< "photons", "irradiance", ...
  int version = 1;    ///< of the kind's layout
  std::string tool;   ///< "phos-photons 0.1.0"
  int algorithm = 0;  ///< of the tool: raised when the same command would give other numbers; 0 = not stated
  std::string command;                        ///< rebuilt from the resolved parameters
  Json parameters;                            ///< object
  std::map<std::string, std::string> inputs;  ///< role ("scene", "photons") -> content hash
  std::string scene_hash;
  Json scene_parts;  ///< what the scene hash is made of, so that a mismatch can be named (see scene/scene.h)
  Json history = Json::Array{};  ///< the provenance of each earlier stage, oldest first
  std::string key;               ///< what --reuse compares
  Json extra;                    ///< kind-specific scalars (object): totals, bounds, shard, ...
  Counters counters;
};

/// Provenance as text by name (the header of a container, the attributes of an EXR image): strings as they
/// are, the rest as JSON text. Empty values have no entry.
using Metadata = std::map<std::string, std::string>;
Metadata to_metadata(const Provenance& provenance);
/// Throws Error(bad_input) for an entry of another type.
Provenance from_metadata(const Metadata& metadata, const std::string& where);
/// What a later stage keeps of this one in its history.
Json history_entry(const Provenance& provenance);

/// The layout version of a kind that this library reads and writes.
inline constexpr int kLayoutVersion = 1;

/// Is this a phos file, or the beginning of one, which readers call truncated (by its content; false for a
/// missing or unreadable one)?
bool is_container(const std::string& path);

/// An open file, memory-mapped. Reading never trusts the file: sizes, offsets, overlaps and dtypes are
/// checked on open; checksums by verify(). Copies share the mapping.
class Container {
 public:
  /// Throws Error(bad_input) naming what is wrong: missing, not a phos file, truncated, damaged, another
  /// major version. If `kind` is not empty, another kind is an error that names both.
  static Container open(const std::string& path, const std::string& kind = "");

  const std::string& path() const;
  const Provenance& provenance() const;
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
  /// Checks one tensor's checksum (before bytes go to a library that trusts them).
  void verify(const std::string& name) const;

 private:
  const Tensor& require(const std::string& name, Dtype dtype, const Shape& shape) const;
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// Collects columns and writes them atomically. Spans must stay alive until write().
class ContainerWriter {
 public:
  template <class T>
  void add(const std::string& name, std::span<const T> values, Shape shape, const std::string& unit) {
    add_tensor(name, {dtype_of<T>(), std::move(shape), unit, std::as_bytes(values)});
  }
  void add_vectors(const std::string& name, std::span<const Vec3> v, const std::string& unit) {
    add<float>(name, {reinterpret_cast<const float*>(v.data()), 3 * v.size()}, {v.size(), 3}, unit);
  }
  /// Same tensors and provenance give the same bytes. Throws Error(bad_input) if it cannot be written.
  void write(const std::string& path, const Provenance& provenance) const;

 private:
  void add_tensor(const std::string& name, Tensor tensor);
  std::map<std::string, Tensor> tensors_;
};

/// Throws Error(mismatch) if the two scene hashes differ, saying which part changed ("node \"lamp\" moved").
void require_same_scene(const Container& file, const std::string& scene_path, const std::string& scene_hash,
                        const Json& scene_parts);

static_assert(sizeof(Vec3) == 12);

}  // namespace phos::inline file
