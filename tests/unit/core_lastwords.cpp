// Ends that no exception reaches: one line, the right code, and nothing left behind.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <thread>

#include "core/interrupt.h"
#include "core/last_words.h"
#include "support/run.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they answer crashes themselves
namespace phos {
namespace {

namespace fs = std::filesystem;

std::string file_of(const std::string& test) {
  const std::string path = test::scratch(test) + "/temporary";
  test::spill(path, "half");
  return path;
}

void fill_address_space() {
  const rlimit little{std::uint64_t{1} << 20, std::uint64_t{1} << 20};
  setrlimit(RLIMIT_AS, &little);
}

TEST(LastWordsDeathTest, EndTakesTheFilesAlong) {
  const std::string gone = file_of("words-gone"), kept = file_of("words-kept"),
                    moved = file_of("words-moved");
  const auto body = [&] {
    set_program_name("phos-test");
    const GoesWithProcess a(gone);
    GoesWithProcess b(kept), c(moved);
    b.release();
    b = std::move(c);
    end_now(ExitCode::bad_input, "what", "where");
  };
  EXPECT_EXIT(body(), testing::ExitedWithCode(3), "^phos-test: where: what\n$");
  EXPECT_FALSE(fs::exists(gone));
  EXPECT_FALSE(fs::exists(moved));
  EXPECT_TRUE(fs::exists(kept));
}

TEST(LastWordsDeathTest, MoreFilesThanThereIsRoomFor) {
  std::vector<GoesWithProcess> many;
  for (int i = 0; i < 1000; ++i) many.emplace_back("/nowhere/" + std::to_string(i));
  EXPECT_EXIT(end_now(ExitCode::interrupted, "x"), testing::ExitedWithCode(130), "x");
}

TEST(LastWordsDeathTest, NoMemoryWhereNothingMayBeThrown) {
  const auto body = [] {
    install_last_words();
    std::thread([]() { throw std::bad_alloc(); }).join();
  };
  EXPECT_EXIT(body(), testing::ExitedWithCode(6), "out of memory");
}

TEST(LastWordsDeathTest, CrashForWantOfMemory) {
  const auto crash = [](int signal, bool little) {
    install_last_words();
    if (little) fill_address_space();
    std::raise(signal);
  };
  for (const int signal : {SIGSEGV, SIGABRT}) {
    EXPECT_EXIT(crash(signal, true), testing::ExitedWithCode(6), "out of memory");
    EXPECT_EXIT(crash(signal, false), testing::KilledBySignal(signal), "") << "another crash stays one";
  }
}

TEST(InterruptDeathTest, SecondSignalEndsAtOnceAndTidies) {
  const std::string gone = file_of("interrupt-twice");
  const auto body = [&] {
    install_interrupt_handler();
    const GoesWithProcess file(gone);
    std::raise(SIGINT);
    if (!interrupted() || !fs::exists(gone)) _exit(1);
    std::raise(SIGTERM);
    _exit(2);
  };
  EXPECT_EXIT(body(), testing::ExitedWithCode(130), "interrupted twice");
  EXPECT_FALSE(fs::exists(gone));
}

/// After a signal: ends with 7 if the call throws Error(interrupted) with these words, else with 1.
template <class Call>
[[noreturn]] void interrupted_in(const Call& call, const std::string& words) {
  install_interrupt_handler();
  std::raise(SIGTERM);
  try {
    call();
  } catch (const Error& e) {
    _exit(e.code() == ExitCode::interrupted && std::string(e.what()).find(words) != std::string::npos ? 7
                                                                                                      : 1);
  }
  _exit(2);
}

TEST(InterruptDeathTest, FirstSignalEndsACallThatDoesNotLook) {
  const auto during = [] {
    install_interrupt_handler();
    { const StopAtOnce over; }
    const StopAtOnce stop;
    std::raise(SIGTERM);
    _exit(2);
  };
  EXPECT_EXIT(during(), testing::ExitedWithCode(130), "interrupted; nothing was written");
  const auto before = [] {
    { const StopAtOnce over; }
    interrupted_in([] { const StopAtOnce stop; }, "nothing was written");
  };
  EXPECT_EXIT(before(), testing::ExitedWithCode(7), "");
}

TEST(InterruptDeathTest, SaysWhatIsDone) {
  const auto within = [] {
    install_interrupt_handler();
    say_if_interrupted("interrupted; one is done");
    const StopAtOnce stop;
    std::raise(SIGINT);
    _exit(2);
  };
  EXPECT_EXIT(within(), testing::ExitedWithCode(130), "interrupted; one is done");
  const auto between = [] {
    say_if_interrupted("interrupted; one is done");
    interrupted_in(throw_if_interrupted, "interrupted; one is done");
  };
  EXPECT_EXIT(between(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace phos
#endif
