// No output is an input, and no two outputs are one file.
#include <algorithm>
#include <filesystem>

#include "file/same_file.h"
#include "file/tool.h"

namespace phos::inline file {
namespace {

/// Of a longer sequence its first frames are looked at: three quarters of an hour of film.
constexpr std::int64_t kFramesAtOnce = 1 << 16;

bool is_output(const GivenFile& file) { return file.given_to == "--output"; }

std::string named(const GivenFile& file) { return text(file.given_to, " ", file.path); }

}  // namespace

/// One path, or one for each frame.
std::vector<std::string> Tool::files_of(const GivenFile& file) const {
  const Json asked = options_.value("frames");
  if (!asked.is_string() || asked.as_string().empty()) return {file.path};
  const FrameRange frames = parse_frames(asked.as_string());
  std::error_code ignored;
  try {
    const bool folder = file.use == FileUse::read && std::filesystem::is_directory(file.path, ignored);
    if (!folder && !names_frames(file.path)) return {file.path};
    const FramePattern names =
        folder ? existing_sequence(file.path, frames, file.given_to) : FramePattern(file.path, file.given_to);
    std::vector<std::string> all;
    for (std::int64_t i = 0; i < std::min(frames.count(), kFramesAtOnce); ++i)
      all.push_back(names.path(frames.first + i));
    return all;
  } catch (const Error&) {
    return {file.path};  // told where it is read
  }
}

void Tool::add_written(const GivenFile& file, const std::string& path) {
  const std::string key = file_key(path);
  if (key.empty()) return;
  const auto [other, fresh] = written_.try_emplace(key, file);
  if (!fresh && other->second.given_to != file.given_to)
    throw Error(ExitCode::usage, file.given_to,
                text(path, " is written by ", named(other->second), " too; name another file"));
}

void Tool::require_not_written(const GivenFile& file, const std::string& path) const {
  const std::string key = file_key(path);
  const auto found = key.empty() ? written_.end() : written_.find(key);
  if (found == written_.end() || (is_output(found->second) && grown_.contains(key))) return;
  throw Error(
      ExitCode::usage, found->second.given_to,
      text(found->second.path, " is an input too, ", file.given_to, " ", path, "; name another file"));
}

void Tool::refuse_shared_files() {
  const std::vector<GivenFile> files = options_.files();
  for (const GivenFile& file : files)
    if (file.use == FileUse::written)
      for (const std::string& path : files_of(file)) add_written(file, path);
  for (const GivenFile& file : files)
    if (file.use == FileUse::read)
      for (const std::string& path : files_of(file)) require_not_written(file, path);
  for (const GivenFile& file : files)
    if (file.use == FileUse::grown) {
      grown_.insert(file_key(file.path));
      require_not_written(file, file.path);
    }
}

void Tool::reads(const std::string& role, const std::vector<std::string>& paths) const {
  for (const std::string& path : paths) require_not_written({role, path, FileUse::read}, path);
}

void Tool::writes(const std::string& option, const std::string& folder,
                  const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::string path = text(folder, "/", name);
    add_written({option, path, FileUse::written}, path);
  }
  for (const GivenFile& file : options_.files())
    if (file.use == FileUse::read)
      for (const std::string& path : files_of(file)) require_not_written(file, path);
}

}  // namespace phos::inline file
