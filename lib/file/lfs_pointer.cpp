#include "file/lfs_pointer.h"

namespace phos::inline file {

bool is_lfs_pointer(std::string_view bytes) {
  // The first line of the specification's every version; pointers are below 1024 bytes.
  return bytes.size() < 1024 && (bytes.starts_with("version https://git-lfs.github.com/spec/") ||
                                 bytes.starts_with("version https://hawser.github.com/spec/"));
}

}  // namespace phos::inline file
