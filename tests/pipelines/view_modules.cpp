// Modules of the page of phos-view by themselves: view_modules.html calls them in a browser.
#include <gtest/gtest.h>

#include "support/browser.h"

namespace phos::test {
namespace {

TEST(PageModules, DoAsTheirTestsSay) {
  if (!has_chromium()) GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
  Chromium browser({"--allow-file-access-from-files"});
  const Shown shown = browser.open("file://" PHOS_SOURCE "/tests/pipelines/view_modules.html",
                                   once("document.getElementById('result').textContent"));
  EXPECT_EQ(shown.console, "");
  EXPECT_NE(words_of(shown, "result").find("checks hold"), std::string::npos) << words_of(shown, "result");
}

}  // namespace
}  // namespace phos::test
