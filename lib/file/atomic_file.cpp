#include "file/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>

#include "core/error.h"
#include "file/hash.h"
#include "file/mapped_file.h"
#include "file/same_file.h"

namespace phos::inline file {

namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  const char* remedy = "choose another path";
  if (error == ENOSPC || error == EDQUOT) remedy = "free some space, or choose another path";
  if (error == ENOENT || error == ENOTDIR) remedy = "make the folder first, or choose another path";
  throw Error(ExitCode::bad_input, path, "cannot write: " + system_message(error) + "; " + remedy);
}

/// Folder of a path, with its final '/'; "" is the current one.
std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

/// Where a symbolic link leads, so that the link stays and its target is replaced.
std::string without_links(const std::string& path) {
  struct stat info {};
  if (::lstat(path.c_str(), &info) != 0 || !S_ISLNK(info.st_mode)) return path;
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), std::free);
  return real ? std::string(real.get()) : path;
}

struct Temporary {
  int fd;
  std::string path;
  GoesWithProcess goes;
};

/// True once the file is ours alone and still has its name; a file system without locks counts as that.
bool held(int fd) {
  struct stat info {};
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  return ::fstat(fd, &info) == 0 && info.st_nlink > 0;
}

/// How the names of this machine's temporaries begin: another one's locks may not be seen in a shared folder.
std::string own_prefix() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return text(".phos-", hash_text(host).hex().substr(0, 8), "-");
}

/// An empty new file beside `path`. The name is short, so that it is legal wherever `path` is.
Temporary make_temporary(const std::string& path) {
  static std::atomic<unsigned> number{0};
  for (;;) {
    std::string name = text(folder_of(path), own_prefix(), ::getpid(), "-", number++, ".tmp");
    const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) {
      GoesWithProcess goes(name);
      if (held(fd)) return {fd, std::move(name), std::move(goes)};
      ::close(fd);  // a process that tidies up took it for abandoned
      continue;
    }
    if (errno != EEXIST && errno != EINTR) fail(path, errno);
  }
}

/// Removes this machine's temporaries that nobody holds (their process was killed). Looks once at each
/// folder.
void remove_abandoned(const std::string& path) {
  static std::mutex mutex;
  static std::set<std::string> tidied;
  const std::string folder = folder_of(path).empty() ? "./" : folder_of(path);
  const std::lock_guard lock(mutex);
  if (!tidied.insert(folder).second) return;
  const std::string prefix = own_prefix();
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(".tmp")) continue;
    const int fd = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0) continue;
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(entry.path().c_str());
    ::close(fd);
  }
}

/// True if `path` exists and is to be written in place (a device, a pipe). Throws for a folder or a
/// write-protected file.
bool in_place(const std::string& path, mode_t* mode) {
  struct stat info {};
  if (path.empty()) throw Error(ExitCode::bad_input, "", "cannot write: the output path is empty");
  if (::stat(path.c_str(), &info) != 0) {
    if (errno != ENOENT) fail(path, errno);
    return false;
  }
  if (S_ISDIR(info.st_mode)) fail(path, EISDIR);
  if (::access(path.c_str(), W_OK) != 0) fail(path, errno);
  if (mode != nullptr) *mode = info.st_mode & 07777;
  return !S_ISREG(info.st_mode);
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  // Opening a standard stream anew would lose the place that a shell redirection left it at.
  if (const int stream = standard_stream(path_); stream >= 0) {
    fd_ = ::fcntl(stream, F_DUPFD_CLOEXEC, 0);
    if (fd_ < 0) fail(path_, errno);
    return;
  }
  path_ = without_links(path_);
  mode_t mode = 0;
  if (in_place(path_, &mode)) {
    fd_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) fail(path_, errno);
    return;
  }
  remove_abandoned(path_);
  Temporary temporary = make_temporary(path_);
  fd_ = temporary.fd;
  temporary_ = std::move(temporary.path), goes_ = std::move(temporary.goes);
  if (mode != 0) static_cast<void>(::fchmod(fd_, mode));  // keep the rights of the file that is replaced
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (fd_ >= 0) ::close(fd_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  PHOS_CHECK(fd_ >= 0, path_, " is committed");
  while (!bytes.empty()) {
    const std::size_t most = std::min<std::size_t>(bytes.size(), std::size_t{1} << 30);
    const ssize_t n = ::write(fd_, bytes.data(), most);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void AtomicFile::commit() {
  PHOS_CHECK(fd_ >= 0, path_, " is committed twice");
  const bool atomic = !temporary_.empty();
  // Some file systems cannot sync and say so; that is no failure to write.
  if (atomic && ::fsync(fd_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
    fail(path_, errno);
  if (atomic) {
    // A close reports errors that some file systems find late. Our own descriptor stays: it holds the lock.
    if (const int copy = ::fcntl(fd_, F_DUPFD_CLOEXEC, 0); copy >= 0 && ::close(copy) != 0 && errno != EINTR)
      fail(path_, errno);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, errno);
    temporary_.clear(), goes_.release();
  }
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0 && errno != EINTR && !atomic) fail(path_, errno);
  if (!atomic) return;
  const std::string folder = folder_of(path_);
  const int folder_fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_fd >= 0) {
    ::fsync(folder_fd);  // best effort: the name survives a power cut
    ::close(folder_fd);
  }
}

void require_writable(const std::string& path) {
  if (standard_stream(path) >= 0) return;
  const std::string real = without_links(path);
  if (in_place(real, nullptr)) return;
  remove_abandoned(real);
  const Temporary temporary = make_temporary(real);
  ::unlink(temporary.path.c_str());
  ::close(temporary.fd);
}

std::string read_text(const std::string& path) {
  const MappedFile file(path);
  return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

}  // namespace phos::inline file
