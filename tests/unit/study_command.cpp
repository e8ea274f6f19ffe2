// Commands of a pipeline: how they are written for a shell, run, measured and refused.
#include <gtest/gtest.h>

#include "core/error.h"
#include "study/command.h"
#include "support/run.h"

namespace phos {
namespace {

TEST(StudyCommand, IsWrittenForAShell) {
  EXPECT_EQ(shell_line({"phos-splat", {"a room.glb", "--width", "20", "it's"}, "o.exr"}),
            "phos-splat 'a room.glb' --width 20 'it'\\''s' -o o.exr");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("film/%04d.exr"), "film/%04d.exr");
}

TEST(StudyCommand, RunsAndMeasures) {
  const CommandRunner runner({"--threads", "1"}, PHOS_TOOLS);
  const std::string out = test::scratch("study-command") + "/c.photons";
  const CommandRun run =
      runner.require({"phos-photons", {test::data("cornell-empty.glb"), "--photons", "2000"}, out});
  EXPECT_EQ(run.code, 0);
  EXPECT_GT(run.wall_s, 0);
  EXPECT_GT(run.peak_bytes, 1u << 20);
  ASSERT_TRUE(run.stats.find("threads"));
  EXPECT_EQ(run.stats.find("threads")->as_number(), 1);
}

TEST(StudyCommand, FailsWithTheProgramsOwnWords) {
  const CommandRunner runner({}, PHOS_TOOLS);
  try {
    runner.require({"phos-photons", {"nowhere.glb"}, test::scratch("study-fails") + "/c.photons"});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find("nowhere.glb"), std::string::npos) << e.what();
  }
  EXPECT_THROW(CommandRunner({}, "/nowhere").run({"phos-photons", {}, ""}), Error);
}

}  // namespace
}  // namespace phos
