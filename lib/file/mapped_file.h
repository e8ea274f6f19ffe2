// A file's bytes in memory, of any kind of file.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace phos::inline file {

/// Read-only bytes of a file: mapped, or read into memory where it cannot be mapped (a pipe). Aligned to 64
/// bytes. Where a mapped file fails later (its disk does, or another program cut it short), the process ends
/// with one line that names it and ExitCode::bad_input, once install_read_error_handler() was called.
class MappedFile {
 public:
  /// Throws Error(bad_input): missing, a folder, unreadable.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::span<const std::byte> bytes() const { return bytes_; }
  /// As release_pages(), where the file is mapped.
  void release(std::span<const std::byte> part) const;

 private:
  struct alignas(64) Block {
    std::byte bytes[64];
  };
  void read_all(int fd, const std::string& path);
  void watch(const std::string& path);
  std::span<const std::byte> bytes_;
  std::unique_ptr<Block[]> copy_;
  void* mapping_ = nullptr;
  int watched_ = -1;
};

/// Takes the pages that lie wholly in `bytes` out of the memory of the process. The system reads them again
/// where they are touched. `bytes` must be of a mapping of a file.
void release_pages(std::span<const std::byte> bytes);

void install_read_error_handler();
/// Throws Error(bad_input) for a file without bytes, which could be of any kind, and for one that is missing.
void require_bytes(const std::string& path);

/// "No space left on device" and so on for an errno.
std::string system_message(int error);

}  // namespace phos::inline file
