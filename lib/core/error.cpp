#include "core/error.h"
#include "core/text/line.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace phos {

Error::Error(ExitCode code, std::string where, const std::string& message)
    : std::runtime_error(one_line(message)), code_(code), where_(std::move(where)) {}

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  std::fprintf(stderr, "phos: internal check failed at %s:%d: %s (%s)\n", file, line, expression,
               values.c_str());
  std::abort();
}

}  // namespace phos
