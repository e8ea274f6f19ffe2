#include "study/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"

namespace phos::inline study {

namespace {

std::uint64_t count(const Json& v) { return static_cast<std::uint64_t>(v.as_integer()); }

}  // namespace

StudyJournal::StudyJournal(const std::string& path) : path_(path) {
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (fd_ < 0) throw Error(ExitCode::bad_input, path, std::strerror(errno));
  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    ::close(fd_);
    throw Error(ExitCode::bad_input, path,
                "another study works in this folder; wait for it, or name another folder");
  }
  const std::string bytes = read_text(path);
  read(bytes);
  // What was cut off stays alone on its line.
  if (!bytes.empty() && bytes.back() != '\n' && ::write(fd_, "\n", 1) != 1)
    throw Error(ExitCode::bad_input, path, std::strerror(errno));
}

StudyJournal::~StudyJournal() { ::close(fd_); }

void StudyJournal::read(const std::string& bytes) {
  std::istringstream lines(bytes);
  lines.exceptions(std::ios::badbit);  // for want of memory
  for (std::string line; std::getline(lines, line);) {
    try {
      const Json entry = parse_json(line, path_);
      if (!entry.is_object()) continue;
      costs_[entry.as_object().at("id").as_string()] = {
          entry.as_object().at("wall_s").as_number(), entry.as_object().at("cpu_s").as_number(),
          count(entry.as_object().at("peak_bytes")), count(entry.as_object().at("file_bytes"))};
    } catch (const std::exception&) {
      continue;  // cut off, or not ours: that command is run again
    }
  }
}

const CommandCost* StudyJournal::find(const std::string& id) const {
  const auto found = costs_.find(id);
  return found == costs_.end() ? nullptr : &found->second;
}

void StudyJournal::add(const std::string& id, const Command& command, const CommandCost& cost) {
  Json entry;
  entry["id"] = id, entry["command"] = shell_line(command);
  entry["wall_s"] = cost.wall_s, entry["cpu_s"] = cost.cpu_s;
  entry["peak_bytes"] = cost.peak_bytes, entry["file_bytes"] = cost.file_bytes;
  const std::string line = entry.dump() + "\n";
  if (::write(fd_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw Error(ExitCode::bad_input, path_, std::strerror(errno));
  costs_[id] = cost;
}

}  // namespace phos::inline study
