// XXH3-128, which identifies contents, keys and checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace phos::inline file {

struct Hash128 {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Hash128&) const = default;
  /// 32 lower-case hexadecimal digits.
  std::string hex() const;
};

Hash128 hash_bytes(std::span<const std::byte> bytes);
inline Hash128 hash_text(std::string_view s) {
  return hash_bytes(std::as_bytes(std::span(s.data(), s.size())));
}
/// Of a file's contents. A phos container is identified by its header alone (which holds the checksums of its
/// data), so that this takes milliseconds. Throws Error(bad_input).
Hash128 hash_file(const std::string& path);

/// Hash of a sequence of values, for composing keys. Floats hash by their bits (-0 as 0).
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  void add_bytes(const void* data, std::size_t size);
  void add(std::string_view s);
  void add(float v);
  template <class T>
  requires std::is_integral_v<T> || std::is_enum_v<T>
  void add(T v) {
    const auto wide = static_cast<std::int64_t>(v);
    add_bytes(&wide, sizeof wide);
  }
  /// Elements must have no padding.
  template <class T>
  void add_span(std::span<const T> v) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(static_cast<std::int64_t>(v.size()));
    add_bytes(v.data(), v.size_bytes());
  }
  Hash128 finish() const;

 private:
  void* state_;
};

}  // namespace phos::inline file
