#include "core/error.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace phos {

namespace {

/// Messages quote inputs: a name or a cell may hold any byte.
std::string one_line(std::string message) {
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return message;
}

}  // namespace

Error::Error(ExitCode code, std::string where, const std::string& message)
    : std::runtime_error(one_line(message)), code_(code), where_(std::move(where)) {}

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  std::fprintf(stderr, "phos: internal check failed at %s:%d: %s (%s)\n", file, line, expression,
               values.c_str());
  std::abort();
}

}  // namespace phos
