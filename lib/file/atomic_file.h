// A file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/last_words.h"

namespace phos::inline file {

/// Writes to a temporary file beside `path`; commit() syncs and renames it into place. Destroyed without
/// commit(), it removes the temporary and leaves the file at `path`. Every failure (no folder, no right, full
/// disk) throws Error(bad_input) with the reason, which the system gives at the call that fails. A `path`
/// that is not a regular file (/dev/stdout, a pipe) is written directly. The temporary is locked while its
/// writer lives: one that nobody holds was left by a process killed outright, and the next on the same
/// machine that writes into that folder removes it.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  void write(std::span<const std::byte> bytes);
  void write(std::string_view s) { write(std::as_bytes(std::span(s.data(), s.size()))); }
  void commit();
  /// The file beside `path`, for another program to write; "" where `path` is written directly.
  const std::string& temporary() const { return temporary_; }

 private:
  std::string path_, temporary_;
  GoesWithProcess goes_;
  int fd_ = -1;
};

/// Throws Error(bad_input) at once if nothing could be written at `path` (before hours of work are spent).
/// Removes from its folder the temporaries of killed processes.
void require_writable(const std::string& path);
/// Whole file as text. Throws Error(bad_input).
std::string read_text(const std::string& path);

}  // namespace phos::inline file
