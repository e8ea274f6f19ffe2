// phos help: its tables are the code's own, and those of the manual.
#include <gtest/gtest.h>

#include <csignal>
#include <regex>
#include <set>

#include "core/events.h"
#include "core/facts/exit_codes.h"
#include "core/facts/programs.h"
#include "stage/front/child.h"
#include "stage/front/limits.h"
#include "stage/front/topics.h"
#include "support/page.h"

namespace phos::stage {
namespace {

TEST(Pages, TablesAreThoseOfTheCode) {
  test::expect_table("README.md", "programs", program_table());
  test::expect_table("docs/reference/exit-codes.md", "table", exit_code_table());
  test::expect_table("docs/reference/limits.md", "table", limit_table());
  test::expect_table("docs/reference/events.md", "table", event_table());
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
    all.insert((*at)[1].str());
  return all;
}

TEST(Programs, AreThoseThatAreBuilt) {
  std::set<std::string> there, told;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(PHOS_SOURCE) + "/tools"))
    if (const std::string name = entry.path().stem().string(); name.starts_with("phos-")) there.insert(name);
  for (const Program& row : all_programs()) told.emplace(row.name);
  EXPECT_EQ(there, told);
  EXPECT_EQ(find_program("splat"), find_program("phos-splat"));
  EXPECT_EQ(find_program("phos"), nullptr);
}

TEST(ExitCodes, EveryOneHasItsRow) {
  const std::string source = test::slurp(std::string(PHOS_SOURCE) + "/lib/core/error.h");
  const std::set<std::string> there = matches(source, " = ([0-9]+), +///<");
  std::set<std::string> told;
  for (const ExitMeaning& row : exit_meanings()) told.insert(std::to_string(static_cast<int>(row.code)));
  EXPECT_GE(there.size(), 8u);
  EXPECT_EQ(there, told);
}

/// A limit that a module has, and that no list leads to, would be on no page.
TEST(Limits, EveryOneIsListed) {
  std::size_t declared = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(PHOS_SOURCE) + "/lib"))
    if (const std::string name = entry.path().filename().string(); name == "limits.h" || name == "limit.h")
      declared += matches(test::slurp(entry.path().string()), "constexpr Limit (k[A-Za-z]+)").size();
  std::set<std::string_view> listed;
  for (const LimitGroup& group : all_limits())
    for (const Limit* limit : group.limits) listed.insert(limit->of);
  EXPECT_GT(declared, 20u);
  EXPECT_EQ(listed.size(), declared);
}

TEST(Limits, AreWrittenShort) {
  EXPECT_EQ(written({"", 4096, ""}), "4096");
  EXPECT_EQ(written({"", 1 << 28, ""}), "2^28");
  EXPECT_EQ(written({"", 100000, ""}), "10^5");
  EXPECT_EQ(written({"", 65534, ""}), "65534");
  EXPECT_EQ(written({"", 0x7fffffff, ""}), "2147483647");
}

TEST(Topics, SayWhatTheTablesHold) {
  const std::string codes = find_topic("exit-codes")->text(), limits = find_topic("limits")->text();
  EXPECT_NE(codes.find("  130   interrupted"), std::string::npos) << codes;
  EXPECT_EQ(codes.find('`'), std::string::npos) << codes;
  EXPECT_NE(limits.find("  2^28        pixels of a picture. Beyond: exit code 2"), std::string::npos)
      << limits;
  const std::string events = find_topic("events")->text();
  for (const Event* event : all_events())
    EXPECT_NE(events.find(event->name), std::string::npos) << event->name;
  const std::string options = find_topic("options")->text();
  for (const char* option : {"--threads", "--seed", "--output", "--reuse", "@FILE"})
    EXPECT_NE(options.find(option), std::string::npos) << options;
  const std::string files = find_topic("files")->text();
  EXPECT_NE(files.find("phos-irradiance"), std::string::npos);
  EXPECT_NE(files.find("phos-temporal"), std::string::npos) << files;
  EXPECT_EQ(find_topic("exit"), nullptr);
}

TEST(Child, SaysHowItsWorkEnded) {
  const ChildResult good = in_child([] { std::puts("drawn"); }, 10);
  EXPECT_TRUE(good.done);
  EXPECT_EQ(good.said, "drawn");
  const ChildResult refused = in_child([] { throw Error(ExitCode::bad_input, "", "no library"); }, 10);
  EXPECT_FALSE(refused.done);
  EXPECT_EQ(refused.said, "no library");
  const ChildResult crashed = in_child([] { std::raise(SIGSEGV); }, 10);
  EXPECT_FALSE(crashed.done);
  EXPECT_EQ(crashed.said, "crashes (Segmentation fault)");
  const ChildResult stuck = in_child(
      [] {
        while (true) pause();
      },
      1);
  EXPECT_FALSE(stuck.done);
  EXPECT_EQ(stuck.said, "takes more than 1 s");
  const ChildResult code = in_child([] { _exit(7); }, 10);
  EXPECT_FALSE(code.done);
  EXPECT_EQ(code.said, "ends with code 7");
}

}  // namespace
}  // namespace phos::stage
