// phos as a user drives it.
#include <gtest/gtest.h>

#include "support/script.h"

namespace phos {
namespace {

using test::Run;

std::string phos() { return PHOS_TOOLS "/phos"; }

Run run_phos(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{phos()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return test::run_shell(command, test::scratch("phos"));
}

TEST(Phos, NoArgumentsHelpAndVersion) {
  const auto none = run_phos({}), help = run_phos({"help"});
  EXPECT_EQ(none.code, 0);
  EXPECT_EQ(none.err, "");
  EXPECT_EQ(none.out, help.out);
  for (const char* words :
       {"  splat       scene, caches -> .exr", "renders a scene from its caches", "exit-codes"})
    EXPECT_NE(none.out.find(words), std::string::npos) << none.out;
  const auto own = run_phos({"--help"});
  EXPECT_EQ(own.code, 0);
  EXPECT_NE(own.out.find("Usage: phos [options] [COMMAND...]"), std::string::npos) << own.out;
  EXPECT_EQ(run_phos({"--version"}).out.find("phos "), 0u);
  EXPECT_EQ(run_phos({"--man"}).out.find(".TH PHOS 1"), 0u);
}

TEST(Phos, HelpOfProgramsAndTopics) {
  const auto splat = run_phos({"help", "splat"});
  EXPECT_EQ(splat.code, 0);
  EXPECT_EQ(splat.out, run_phos({"splat", "--help"}).out);
  EXPECT_EQ(splat.out, run_phos({"help", "phos-splat"}).out);
  EXPECT_EQ(splat.out.find("phos-splat - "), 0u);
  EXPECT_NE(run_phos({"help", "doctor"}).out.find("--json"), std::string::npos);
  for (const char* topic : {"options", "files", "units", "exit-codes", "events", "limits"}) {
    const auto run = run_phos({"help", topic});
    EXPECT_EQ(run.code, 0) << topic;
    EXPECT_GT(run.out.size(), 300u) << topic;
  }
}

void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
  const auto run = run_phos(arguments);
  EXPECT_EQ(run.code, 2) << says;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
  EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
}

TEST(Phos, UnknownNamesAreOneLineWithTheNearest) {
  expect_refused({"splatt"}, "phos: splatt: no such program; did you mean \"splat\"?");
  expect_refused({"doktor", "--json"}, "did you mean \"doctor\"?");
  expect_refused({"help", "exit-code"}, "no such program or topic; did you mean \"exit-codes\"?");
  expect_refused({"help", "splat", "sense"}, "one name at a time");
  expect_refused({"--helm"}, "--helm: no such option; did you mean \"--help\"?");
  expect_refused({"xyzzyxyzzy"}, "phos: xyzzyxyzzy: no such program; phos help lists all");
  expect_refused({""}, "no such program");
}

TEST(Phos, RunsAProgramWithItsArgumentsAndItsCode) {
  const auto wrong = run_phos({"info"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_EQ(wrong.err.find("phos-info: "), 0u) << wrong.err;
  const auto missing = run_phos({"info", "no such file"});
  EXPECT_EQ(missing.code, 3);
  EXPECT_EQ(missing.err.find("phos-info: no such file: "), 0u) << missing.err;
}

/// phos alone in a folder: programs are then looked for on PATH.
TEST(Phos, LooksBesideItselfThenOnPath) {
  const std::string folder = test::scratch("phos-alone"), other = test::scratch("phos-path");
  std::filesystem::copy_file(phos(), folder + "/phos");
  const auto run = [&](const std::string& path) {
    return test::run_shell({"/usr/bin/env", "PATH=" + path, folder + "/phos", "splat", "a b", "", "-o", "$x"},
                           folder);
  };
  const auto none = run("/nowhere");
  EXPECT_EQ(none.code, 3);
  EXPECT_TRUE(test::is_one_line(none.err)) << none.err;
  EXPECT_EQ(none.err.find("phos: phos-splat: is neither beside phos nor on PATH"), 0u) << none.err;
  test::spill(other + "/phos-splat", "#!/bin/sh\nfor word; do echo \"<$word>\"; done\nexit 7\n");
  std::filesystem::permissions(other + "/phos-splat", std::filesystem::perms::owner_all);
  const auto found = run("/nowhere:" + other);
  EXPECT_EQ(found.code, 7);
  EXPECT_EQ(found.out, "<a b>\n<>\n<-o>\n<$x>\n");
  test::spill(folder + "/phos-splat", "#!/bin/sh\nexit 9\n");
  std::filesystem::permissions(folder + "/phos-splat", std::filesystem::perms::owner_all);
  EXPECT_EQ(run(other).code, 9);
}

TEST(Phos, OutputThatCannotBeWritten) {
  const std::string folder = test::scratch("phos-full");
  const auto run = test::run_shell({"sh", "-c", phos() + " help limits >/dev/full"}, folder);
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
}

}  // namespace
}  // namespace phos
