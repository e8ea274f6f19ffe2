#include "file/scratch/scratch_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <new>

#include "core/error.h"
#include "file/mapped_file.h"
#include "file/same_file.h"

namespace phos::inline file {
namespace {

constexpr std::size_t kCollected = std::size_t{64} << 10;

std::string folder_for(const std::string& output) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(output, ignored);
  if (standard_stream(output) >= 0 || (exists(status) && !is_regular_file(status)))
    return std::filesystem::temp_directory_path(ignored).string();
  std::filesystem::path path = std::filesystem::weakly_canonical(output, ignored);
  if (ignored) path = output;
  return path.has_parent_path() ? path.parent_path().string() : ".";
}

/// Without a name from the beginning, or, where the file system has no such files, from the next moment on.
int open_nameless(const std::string& folder) {
  const int fd = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (fd >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return fd;
  std::string name = folder + "/.phos-scratch-XXXXXX";
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

ScratchFile::ScratchFile(const std::string& output)
    : folder_(folder_for(output)), fd_(open_nameless(folder_)) {
  if (fd_ < 0) fail("make", errno);
}

ScratchFile::~ScratchFile() {
  if (!mapping_.empty()) ::munmap(const_cast<std::byte*>(mapping_.data()), mapping_.size());
  if (fd_ >= 0) ::close(fd_);
}

void ScratchFile::fail(const char* what, int error) const {
  const bool full = error == ENOSPC || error == EDQUOT;
  throw Error(
      ExitCode::bad_input, folder_,
      text("cannot ", what, " a temporary file: ", system_message(error), "; ",
           full ? "free some space, or write the output to another disk" : "write the output elsewhere"));
}

void ScratchFile::write(std::span<const std::byte> bytes) {
  PHOS_CHECK(mapping_.empty(), folder_);
  if (bytes.size() >= kCollected) {
    flush();
    put(size_, bytes);
    size_ += bytes.size();
    return;
  }
  size_ += bytes.size();
  unwritten_.insert(unwritten_.end(), bytes.begin(), bytes.end());
  if (unwritten_.size() >= kCollected) flush();
}

void ScratchFile::flush() {
  put(size_ - unwritten_.size(), unwritten_);
  unwritten_.clear();
}

void ScratchFile::put(std::uint64_t at, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", errno);
    at += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void ScratchFile::read_at(std::uint64_t at, std::span<std::byte> bytes) {
  flush();
  PHOS_CHECK(at + bytes.size() <= size_, at, " + ", bytes.size(), " of ", size_);
  while (!bytes.empty()) {
    const ssize_t n = ::pread(fd_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("read", n < 0 ? errno : EIO);
    at += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void ScratchFile::write_at(std::uint64_t at, std::span<const std::byte> bytes) {
  flush();
  PHOS_CHECK(mapping_.empty() && at + bytes.size() <= size_, at, " + ", bytes.size(), " of ", size_);
  put(at, bytes);
}

std::span<const std::byte> ScratchFile::map() {
  flush();
  unwritten_ = {};
  if (!mapping_.empty() || size_ == 0) return mapping_;
  void* const mapping = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, fd_, 0);
  if (mapping == MAP_FAILED && errno == ENOMEM) throw std::bad_alloc();
  if (mapping == MAP_FAILED) fail("map", errno);
  mapping_ = {static_cast<const std::byte*>(mapping), static_cast<std::size_t>(size_)};
  return mapping_;
}

}  // namespace phos::inline file
