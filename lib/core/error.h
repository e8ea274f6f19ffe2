// Errors that a user sees, and checks of our own mistakes.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace phos {

/// What every tool ends with. Shown in each tool's --help.
enum class ExitCode : int {
  done = 0,           ///< the program did its work
  check_failed = 1,   ///< a comparison or a verification failed
  usage = 2,          ///< the command line is wrong
  bad_input = 3,      ///< an input is unreadable, malformed or damaged; or an output cannot be written
  mismatch = 4,       ///< inputs do not belong together
  numerical = 5,      ///< a numerical guard tripped more often than it may
  no_memory = 6,      ///< memory ran out
  interrupted = 130,  ///< Ctrl-C, SIGTERM or SIGHUP
};

/// Joins its arguments into one string (anything that std::ostream prints). Throws std::bad_alloc: a stream
/// alone would end the text where memory does.
template <class... Args>
std::string text(const Args&... args) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);
  (out << ... << args);
  return out.str();
}

/// An error for the person at the command line. `where` is the file or option at fault ("" if none);
/// `message` is one line that says what is wrong and how to mend it. A tool prints `phos-x: where: message`
/// and exits with `code`.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, std::string where, const std::string& message);
  ExitCode code() const { return code_; }
  const std::string& where() const { return where_; }

 private:
  ExitCode code_;
  std::string where_;
};

/// Prints file, line and values to stderr and aborts: a mistake of ours, not of the user.
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const std::string& values);

}  // namespace phos

/// Always on. PHOS_CHECK(n > 0, "n = ", n) aborts with the values where the condition is false.
#define PHOS_CHECK(condition, ...)                                                     \
  do {                                                                                 \
    if (!(condition)) [[unlikely]]                                                     \
      ::phos::check_failed(__FILE__, __LINE__, #condition, ::phos::text(__VA_ARGS__)); \
  } while (false)
