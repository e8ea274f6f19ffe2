// Bytes as a file, and what a reader may answer.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/parallel.h"

namespace phos::fuzz {

/// A folder of this process in memory, where there is one; gone at its end.
inline const std::string& scratch() {
  struct Folder {
    std::string path;
    Folder() {
      const bool shm = std::filesystem::is_directory("/dev/shm");
      const auto root = shm ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
      path = (root / ("phos-fuzz-" + std::to_string(::getpid()))).string();
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

inline std::string_view characters(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A mutator's answer: these bytes instead, or the input as it is where there is no room for them.
inline std::size_t put(std::string_view bytes, std::uint8_t* data, std::size_t size, std::size_t most) {
  if (bytes.size() > most) return size;
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}

/// Path of a file of these bytes, in a folder of its own kind.
inline std::string spilled(std::string_view bytes, const std::string& name = "input") {
  const std::string path = scratch() + "/" + name;
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

/// May a reader say this of an input? One line, and that the input is at fault.
inline void require_answer(const Error& e) {
  const std::string what = e.what();
  const bool of_inputs = e.code() == ExitCode::bad_input || e.code() == ExitCode::mismatch;
  if (of_inputs && !what.empty() && (e.where() + what).find('\n') == std::string::npos) return;
  std::fprintf(stderr, "an answer that no reader may give: %d %s: %s\n", static_cast<int>(e.code()),
               e.where().c_str(), what.c_str());
  std::abort();
}

/// Runs a reader on one thread. It must end with or without an Error that may be; all else is a crash.
template <class Read>
int answers(const Read& read) {
  static const bool one_thread = (set_threads(1), true);
  static_cast<void>(one_thread);
  try {
    read();
  } catch (const Error& e) {
    require_answer(e);
  }
  return 0;
}

/// What readers give must be used, so that sanitizers look at it.
template <class T>
void use(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace phos::fuzz
