// The manual: its commands run at toy size, its links lead somewhere, and it explains every option, tensor
// and exit code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "support/script.h"

namespace phos::test {
namespace {

/// README.md and every guide and reference page, by its path below the project.
std::vector<std::string> pages() {
  std::vector<std::string> found = {"README.md"};
  for (const char* folder : {"docs/guide", "docs/reference"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(PHOS_SOURCE) + "/" + folder))
      if (entry.path().extension() == ".md")
        found.push_back(std::string(folder) + "/" + entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string project(const std::string& name) { return std::string(PHOS_SOURCE) + "/" + name; }

class Manual : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("docs-manual"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  test::Run check(const std::string& script) const {
    return run_shell({"bash", project("tests/docs/" + script)}, folder_);
  }
  std::string folder_;
};

class ManualPage : public Manual, public testing::WithParamInterface<std::string> {};

TEST_P(ManualPage, CommandsRun) {
  const test::Run run =
      run_shell({"bash", project("tests/docs/run_guides.sh"), project(GetParam())}, folder_);
  EXPECT_EQ(run.code, 0) << run.err;
}

INSTANTIATE_TEST_SUITE_P(Pages, ManualPage, testing::ValuesIn(pages()), [](const auto& page) {
  std::string name = page.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

TEST_F(Manual, EveryLinkLeadsSomewhere) {
  const test::Run run = check("check_links.sh");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(Manual, ExplainsEveryOption) {
  const test::Run run = check("check_options.sh");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(Manual, NamesEveryTensorAndExitCode) {
  const test::Run run = check("check_files.sh");
  EXPECT_EQ(run.code, 0) << run.err;
}

}  // namespace
}  // namespace phos::test
