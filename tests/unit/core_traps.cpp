// A build that traps floating-point errors (preset fpe) does so in every thread that works, and only there.
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <limits>

#include "core/float_traps.h"
#include "core/parallel.h"

namespace phos {
namespace {

volatile float zero = 0, one = 1, result = 0;
volatile int whole = 0;

void divide_by_zero() { result = one / zero; }
void divide_zero_by_zero() { result = zero / zero; }
void convert_too_large() { whole = static_cast<int>(one * 1e20f); }

class FloatTrapsDeathTest : public testing::Test {
 protected:
  void SetUp() override {
#ifndef PHOS_TRAP_FPE
    GTEST_SKIP() << "not a build that traps (-DPHOS_TRAP_FPE=ON)";
#endif
  }
};

TEST_F(FloatTrapsDeathTest, EndTheProcess) {
  for (const auto error : {divide_by_zero, divide_zero_by_zero, convert_too_large})
    EXPECT_EXIT(error(), testing::KilledBySignal(SIGFPE), "");
}

TEST_F(FloatTrapsDeathTest, InLoopsToo) {
  const auto loop = [] {
    set_threads(4);
    const NoFloatTraps here;  // not in the chunks, whose thread this may be
    parallel_for(1000, 1, [](std::size_t) { divide_by_zero(); });
  };
  EXPECT_EXIT(loop(), testing::KilledBySignal(SIGFPE), "");
}

TEST_F(FloatTrapsDeathTest, NotWhereTheyAreMasked) {
  const auto masked = [] {
    {
      const NoFloatTraps none;
      divide_by_zero(), divide_zero_by_zero(), convert_too_large();
      result = std::numeric_limits<float>::quiet_NaN();
    }
    _exit(7);
  };
  EXPECT_EXIT(masked(), testing::ExitedWithCode(7), "");
  const auto after = [] {
    { const NoFloatTraps none; }
    divide_by_zero();
  };
  EXPECT_EXIT(after(), testing::KilledBySignal(SIGFPE), "");
}

}  // namespace
}  // namespace phos
