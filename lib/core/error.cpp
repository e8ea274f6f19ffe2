#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace phos {

Error::Error(ExitCode code, std::string where, const std::string& message)
    : std::runtime_error(message), code_(code), where_(std::move(where)) {}

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  std::fprintf(stderr, "phos: internal check failed at %s:%d: %s (%s)\n", file, line, expression,
               values.c_str());
  std::abort();
}

}  // namespace phos
