// Modules of the page of phos-view by themselves: view_modules.html calls them in a browser.
#include <gtest/gtest.h>

#include "support/browser.h"

namespace phos::test {
namespace {

TEST(PageModules, DoAsTheirTestsSay) {
  if (!has_chromium()) GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
  const std::string folder = scratch("view-modules");
  const Shown shown = open_page("file://" PHOS_SOURCE "/tests/pipelines/view_modules.html", folder,
                                "--allow-file-access-from-files");
  EXPECT_EQ(shown.console, "");
  EXPECT_NE(words_of(shown, "result").find("checks hold"), std::string::npos) << words_of(shown, "result");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace phos::test
