// Temporaries of killed writers go, those of writers at work stay; inputs that fail while they are read.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "core/last_words.h"
#include "file/atomic_file.h"
#include "file/mapped_file.h"
#include "support/run.h"

namespace phos {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Abandoned, TemporaryOfAKilledWriterIsRemoved) {
  const std::string folder = test::scratch("abandoned"), path = folder + "/out";
  test::spill(folder + "/.phos-notes.txt", "not ours");
  test::spill(folder + "/.phos-other-1-0.tmp", "of another machine, which may be writing it");
  const pid_t writer = fork();
  if (writer == 0) {
    AtomicFile file(path);
    file.write("half");
    raise(SIGKILL);
  }
  waitpid(writer, nullptr, 0);
  EXPECT_EQ(files_in(folder), 3u);
  require_writable(path);
  EXPECT_EQ(files_in(folder), 2u);
  EXPECT_TRUE(fs::exists(folder + "/.phos-other-1-0.tmp"));
  EXPECT_TRUE(fs::exists(folder + "/.phos-notes.txt"));
}

TEST(Abandoned, TemporaryOfAWriterAtWorkStays) {
  const std::string folder = test::scratch("at-work"), path = folder + "/out";
  AtomicFile file(path);
  file.write("all");
  const pid_t other = fork();
  if (other == 0) {
    require_writable(folder + "/another");
    _exit(0);
  }
  waitpid(other, nullptr, 0);
  EXPECT_TRUE(fs::exists(file.temporary()));
  file.commit();
  EXPECT_EQ(test::slurp(path), "all");
  EXPECT_EQ(files_in(folder), 1u);
}

// Writers that come, go and tidy up all the time do not take each other's files.
TEST(Abandoned, ManyAtOnceDoNotDisturbEachOther) {
  const std::string folder = test::scratch("many");
  std::vector<pid_t> writers;
  for (int w = 0; w < 8; ++w) {
    const pid_t pid = fork();
    if (pid == 0) {
      const std::string own = folder + "/" + std::to_string(w % 2);
      for (int i = 0; i < 25; ++i) {
        const pid_t one = fork();
        if (one == 0) {
          int code = 0;
          try {
            require_writable(own);
            AtomicFile file(own);
            file.write(std::string(5000, static_cast<char>('a' + w)));
            file.commit();
          } catch (const std::exception&) {
            code = 1;
          }
          _exit(code);
        }
        int status = 0;
        waitpid(one, &status, 0);
        if (status != 0) _exit(1);
      }
      _exit(0);
    }
    writers.push_back(pid);
  }
  for (const pid_t pid : writers) {
    int status = -1;
    waitpid(pid, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(files_in(folder), 2u);
  for (const char* name : {"/0", "/1"}) {
    const std::string all = test::slurp(folder + name);
    EXPECT_EQ(all, std::string(5000, all.at(0)));
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ReadErrorDeathTest, NamesTheInput) {
  const std::string path = test::scratch("cut") + "/input", temporary = test::scratch("cut-temporary") + "/t";
  test::spill(path, std::string(100000, 'x'));
  test::spill(temporary, "half");
  const auto body = [&] {
    install_read_error_handler();
    set_program_name("phos-test");
    const GoesWithProcess goes(temporary);
    const MappedFile other(temporary), file(path);
    if (truncate(path.c_str(), 0) != 0) _exit(1);
    volatile std::byte last = file.bytes().back();
    static_cast<void>(last);
    _exit(2);
  };
  EXPECT_EXIT(body(), testing::ExitedWithCode(3), "phos-test: .*/input: cannot be read any more");
  EXPECT_FALSE(fs::exists(temporary));
}
#endif

}  // namespace
}  // namespace phos
