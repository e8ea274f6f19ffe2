#include "file/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "core/last_words.h"

namespace phos::inline file {

namespace {

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void fail(const std::string& path, int error) {
  throw Error(ExitCode::bad_input, path,
              "cannot read: " + system_message(error) + (error == ENOENT ? "; check the path" : ""));
}

/// Mappings as a signal handler can read them. Beyond this many a failing file is not named.
constexpr int kWatched = 64;
struct Watch {
  std::atomic<const std::byte*> begin{nullptr};
  std::atomic<std::size_t> size{0};
  char path[512];
};
Watch watches[kWatched];
std::atomic<bool> taken[kWatched];

void on_read_error(int, siginfo_t* info, void*) {
  const auto* at = static_cast<const std::byte*>(info->si_addr);
  const char* path = "an input";
  for (const Watch& w : watches) {
    const std::byte* begin = w.begin;
    if (begin != nullptr && at >= begin && at < begin + w.size) path = w.path;
  }
  end_now(ExitCode::bad_input,
          "cannot be read any more: its disk failed, or another program cut it short; make it again", path);
}

}  // namespace

void install_read_error_handler() {
  struct sigaction action = {};
  action.sa_sigaction = on_read_error;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGBUS, &action, nullptr);
}

void require_bytes(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) fail(path, errno);
  if (S_ISREG(info.st_mode) && info.st_size == 0)
    throw Error(ExitCode::bad_input, path, "the file is empty; make it again");
}

std::string system_message(int error) { return std::system_category().message(error); }

MappedFile::MappedFile(const std::string& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat info {};
  if (file.fd < 0 || ::fstat(file.fd, &info) != 0) fail(path, errno);
  if (S_ISDIR(info.st_mode))
    throw Error(ExitCode::bad_input, path, "cannot read: it is a folder, not a file; name a file");
  const auto size = static_cast<std::size_t>(info.st_size);
  if (S_ISREG(info.st_mode) && size > 0) {
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.fd, 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      bytes_ = {static_cast<const std::byte*>(mapping), size};
      watch(path);
      return;
    }
  }
  read_all(file.fd, path);
}

void MappedFile::read_all(int fd, const std::string& path) {
  std::size_t capacity = 0, size = 0;  // in blocks; in bytes
  for (;;) {
    if (size == capacity * sizeof(Block)) {
      const std::size_t larger = std::max<std::size_t>(1024, 2 * capacity);
      std::unique_ptr<Block[]> grown(new Block[larger]);
      if (size > 0) std::memcpy(grown.get(), copy_.get(), size);
      copy_ = std::move(grown);
      capacity = larger;
    }
    auto* bytes = reinterpret_cast<std::byte*>(copy_.get());
    const ssize_t n = ::read(fd, bytes + size, capacity * sizeof(Block) - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, errno);
    if (n == 0) {
      bytes_ = {bytes, size};
      return;
    }
    size += static_cast<std::size_t>(n);
  }
}

void MappedFile::watch(const std::string& path) {
  for (int i = 0; i < kWatched; ++i) {
    if (taken[i].exchange(true)) continue;
    std::strncpy(watches[i].path, path.c_str(), sizeof watches[i].path - 1);
    watches[i].size = bytes_.size(), watches[i].begin = bytes_.data();
    watched_ = i;
    return;
  }
}

void release_pages(std::span<const std::byte> bytes) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
  const std::uintptr_t begin = (address + page - 1) / page * page,
                       end = (address + bytes.size()) / page * page;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
}

void MappedFile::release(std::span<const std::byte> part) const {
  if (mapping_ != nullptr) release_pages(part);
}

MappedFile::~MappedFile() {
  if (watched_ >= 0) watches[watched_].begin = nullptr, taken[watched_] = false;
  if (mapping_ != nullptr) ::munmap(mapping_, bytes_.size());
}

}  // namespace phos::inline file
