#include "core/text/standard_streams.h"

#include <fcntl.h>

#include <cstdio>
#include <iostream>

#include "core/error.h"
#include "core/text/line.h"

namespace phos {

void occupy_standard_streams() {
  for (int fd = 0; fd <= 2; ++fd)
    if (::fcntl(fd, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
}

void print_line(const std::string& line) {
  const std::string whole = one_line(line) + '\n';
  std::fwrite(whole.data(), 1, whole.size(), stderr);
}

void finish_stdout() {
  std::cout.flush();
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw Error(ExitCode::bad_input, "standard output",
                "cannot write; free some space, or redirect it elsewhere");
}

}  // namespace phos
