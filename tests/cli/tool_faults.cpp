// Each stage hit by each fault at random moments of its run: afterwards the output is what it was before, or
// all that the stage makes, and the stage run again makes the right bytes.
//
// Once per stage and fault here; PHOS_FAULT_MOMENTS=100 (tests/extremes/faults.sh) for more, with a table.
#include <cstdio>

#include "support/fault_bench.h"
#include "support/little_memory.h"

namespace phos::test {
namespace {

int moments() {
  const char* asked = std::getenv("PHOS_FAULT_MOMENTS");
  return asked == nullptr ? 1 : std::atoi(asked);
}

TEST(Faults, LeaveTheOldOutputOrTheWholeNewOne) {
  FaultBench bench;
  std::mt19937_64 random(20250301);
  const char *only = std::getenv("PHOS_FAULT_STAGE"), *one = std::getenv("PHOS_FAULT");
  for (const FaultStage& stage : bench.stages()) {
    if (only != nullptr && stage.name != only) continue;
    const bool slow = !stage.same_bytes;
    if (slow && moments() < 5) continue;  // seconds each
    bench.learn(stage);
    for (const auto& [fault, name] : kFaults) {
      if (one != nullptr && name != std::string(one)) continue;
      if (stage.name == "plan" && fault == Fault::two_at_once) continue;
      if (PHOS_ADDRESS_SANITIZER && fault == Fault::out_of_memory) continue;
      const int n = slow ? moments() / 5 : moments();
      int lost = 0, wrong = 0, other = 0;
      for (int i = 0; i < n; ++i) {
        const std::string why = bench.hit(stage, fault, random);
        if (why.empty()) continue;
        ADD_FAILURE() << name << ": " << why;
        (why.find("LOST") != std::string::npos    ? lost
         : why.find("WRONG") != std::string::npos ? wrong
                                                  : other)++;
      }
      if (const std::string why = bench.again(stage, std::string(name) + ": "); !why.empty()) {
        ADD_FAILURE() << stage.name << ": " << why;
        ++wrong;
      }
      if (moments() > 1) {
        std::printf("%-11s %-12s moments %4d  lost %d  wrong %d  else %d\n", stage.name.c_str(), name, n,
                    lost, wrong, other);
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace
}  // namespace phos::test
