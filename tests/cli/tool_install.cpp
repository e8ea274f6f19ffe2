// What `cmake --install` puts where: each program with the manual page that it says of itself.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/run.h"

namespace phos {
namespace {

TEST(Install, EveryProgramComesWithItsManualPage) {
  const std::string prefix = test::scratch("install");
  const std::string build = std::filesystem::path(PHOS_TOOLS).parent_path().string();
  ASSERT_EQ(std::system(("cmake --install '" + build + "' --prefix '" + prefix + "' >/dev/null").c_str()), 0);
  int programs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(prefix + "/bin")) {
    const std::string name = entry.path().filename().string();
    const test::Run said =
        test::run_tool({name == "phos" ? name : name.substr(std::string("phos-").size()), "--man"});
    EXPECT_EQ(said.code, 0) << name;
    EXPECT_EQ(test::slurp(prefix + "/share/man/man1/" + name + ".1"), said.out) << name;
    EXPECT_NE(said.out.find(".SH OPTIONS"), std::string::npos) << name;
    ++programs;
  }
  EXPECT_GT(programs, 10);
}

}  // namespace
}  // namespace phos
