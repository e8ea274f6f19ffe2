// The numerical events of all modules: each has a stated frequency, and a tool that sees more of one says so.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "core/counters.h"
#include "core/error.h"
#include "estimate/events.h"
#include "image/events.h"
#include "photon/events.h"
#include "place/events.h"
#include "radiance/events.h"
#include "reference/events.h"
#include "splat/events.h"
#include "support/run.h"
#include "temporal/events.h"

namespace phos {
namespace {

class OfEvent : public testing::TestWithParam<const Event*> {};

/// "" or what is said.
std::string complaint(const Event& event, std::uint64_t times, std::uint64_t trials) {
  Counters counters;
  if (times > 0) counters.count(event, times);
  try {
    counters.require_allowed(event, trials);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
    return e.what();
  }
  return "";
}

TEST_P(OfEvent, IsAllowedSoOftenAndNoMore) {
  const Event& event = *GetParam();
  const std::string name(event.name);
  ASSERT_GT(event.share, 0);
  ASSERT_LE(event.share, 1);
  EXPECT_FALSE(event.trials.empty());
  EXPECT_EQ(event.remedy.empty(), event.share == 1) << "a fault has a remedy, what is no fault has none";
  for (const std::uint64_t trials : {1ull, 1000ull, 1000000ull, 1000000000ull}) {
    const std::uint64_t allowed = allowed_count(trials, event.share);
    EXPECT_EQ(complaint(event, 0, trials), "");
    EXPECT_EQ(complaint(event, allowed, trials), "");
    if (event.share == 1) {
      EXPECT_EQ(complaint(event, trials, trials), "");
      continue;
    }
    const std::string said = complaint(event, allowed + 1, trials);
    for (const std::string& part :
         {name, std::to_string(allowed + 1), std::to_string(trials), "at most " + std::to_string(allowed),
          std::string(event.remedy), std::string(event.trials)})
      EXPECT_NE(said.find(part), std::string::npos) << said << " lacks " << part;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OfEvent, testing::ValuesIn(all_events()), [](const auto& info) {
  std::string name(info.param->name);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

// Every event that a module declares is among those above, and is counted somewhere.
TEST(Events, AreDeclaredOnceAndCounted) {
  std::set<std::string> declared;
  std::string all;
  const std::regex declaration(R"re(inline const Event (k\w+)\{\s*"([^"]+)")re");
  std::vector<std::string> constants;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(PHOS_SOURCE) + "/lib")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".h") continue;
    const std::string code = test::slurp(entry.path().string());
    for (std::sregex_iterator i(code.begin(), code.end(), declaration), end; i != end; ++i) {
      EXPECT_EQ(entry.path().filename(), "events.h");
      constants.push_back((*i)[1]);
      declared.insert((*i)[2]);
    }
    if (entry.path().filename() != "events.h") all += code;
  }
  std::set<std::string> known;
  for (const Event* event : all_events()) known.insert(std::string(event->name));
  EXPECT_EQ(declared, known);
  for (const std::string& constant : constants)
    EXPECT_TRUE(std::regex_search(all, std::regex(constant + "\\b"))) << constant << " is counted nowhere";
}

}  // namespace
}  // namespace phos
