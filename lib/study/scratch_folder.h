// A folder for files that nobody keeps.
#pragma once

#include <string>

namespace phos::inline study {

/// A folder that goes with it, with all that is in it. It is locked while it lives: one that nobody holds was
/// left by a killed process, and the first that is made in a process removes it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int lock_ = -1;
};

}  // namespace phos::inline study
