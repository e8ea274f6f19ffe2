// A file for what does not fit in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace phos::inline file {

/// A file without a name that goes with the process, however that ends. It lies in the folder of an output,
/// where there is room for the output; in the system's folder for temporary files where the output is no
/// regular file. Every failure (no right, full disk) throws Error(bad_input) with the reason; map() throws
/// std::bad_alloc where the address space is full.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& output);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Appends. Small pieces are collected: flush() brings them to the file, as the calls below do.
  void write(std::span<const std::byte> bytes);
  template <class T>
  void write_values(std::span<const T> values) {
    write(std::as_bytes(values));
  }
  void flush();
  /// Bytes that were appended.
  std::uint64_t size() const { return size_; }

  /// Bytes from `at` on; they must be there.
  void read_at(std::uint64_t at, std::span<std::byte> bytes);
  /// Puts bytes in place of those from `at` on, which must be there.
  void write_at(std::uint64_t at, std::span<const std::byte> bytes);

  /// All bytes, mapped; nothing may be written any more. release_pages() takes parts out of memory.
  std::span<const std::byte> map();
  template <class T>
  std::span<const T> map_values() {
    const std::span<const std::byte> bytes = map();
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

 private:
  [[noreturn]] void fail(const char* what, int error) const;
  void put(std::uint64_t at, std::span<const std::byte> bytes);
  std::string folder_;
  std::vector<std::byte> unwritten_;
  std::uint64_t size_ = 0;
  std::span<const std::byte> mapping_;
  int fd_ = -1;
};

}  // namespace phos::inline file
