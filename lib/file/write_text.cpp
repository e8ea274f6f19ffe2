#include "file/write_text.h"

#include "file/atomic_file.h"

namespace phos::inline file {

void write_text(const std::string& path, const std::string& bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace phos::inline file
