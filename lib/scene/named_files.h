// Words of the form NAME=FILE.
#pragma once

#include <string>
#include <vector>

namespace phos {

struct NamedFile {
  std::string name, file;
};
/// Takes words apart. Throws Error(usage) for `option` ("--luminaire") where one is not of that form.
std::vector<NamedFile> named_files(const std::vector<std::string>& words, const std::string& option);

}  // namespace phos
