#include "file/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.h"

namespace phos {

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

}  // namespace

std::string system_message(int error) { return std::system_category().message(error); }

MappedFile::MappedFile(const std::string& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat info {};
  if (file.fd < 0 || ::fstat(file.fd, &info) != 0) fail(path, errno);
  if (S_ISDIR(info.st_mode))
    throw Error(ExitCode::bad_input, path, "cannot read: it is a folder, not a file");
  const auto size = static_cast<std::size_t>(info.st_size);
  if (S_ISREG(info.st_mode) && size > 0) {
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.fd, 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      bytes_ = {static_cast<const std::byte*>(mapping), size};
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

MappedFile::~MappedFile() {
  if (mapping_ != nullptr) ::munmap(mapping_, bytes_.size());
}

}  // namespace phos
