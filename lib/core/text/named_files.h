// Words of the form NAME=FILE.
#pragma once

#include <string>
#include <vector>

namespace phos {

struct NamedFile {
  std::string name, file;
};

/// What help says of commas in them.
inline constexpr const char* kNamedFileCommas =
    "a comma separates two of them only where NAME=FILE follows, and \\, and \\= are always part of a name "
    "or file";

/// The words NAME=FILE in one, comma by comma; the word itself if it is not of that form. Names and files may
/// hold commas and "=": of several ways to read a word, one whose FILE exists is taken, else NAME ends at the
/// first "=", and FILE at the first comma that another NAME=FILE follows. Each word, split again, stays one.
std::vector<std::string> split_named_files(const std::string& word);
/// NAME of one of them; the word itself if it is not of that form.
std::string name_of(const std::string& word);

/// Takes words apart, also words of several NAME=FILE. Throws Error(usage) for `option` ("--luminaire") where
/// one is not of that form.
std::vector<NamedFile> named_files(const std::vector<std::string>& words, const std::string& option);

}  // namespace phos
