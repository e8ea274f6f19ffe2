// The three stages on the Cornell box, small, with the rays of every machine alike.
#pragma once

#include "support/golden.h"

namespace phos::test {

/// Makes the files of the stages up to `last` in a folder of its own, once per program.
class GoldenCornell : public testing::Test {
 protected:
  static void TearDownTestSuite() {
    if (!folder().empty()) std::filesystem::remove_all(folder());
    folder().clear();
  }
  static std::string path(const std::string& name) {
    if (folder().empty()) folder() = scratch("golden");
    return folder() + "/cornell." + name;
  }
  static std::string scene() { return data("cornell-measured.glb"); }
  static void must(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--isa", "sse2", "--quiet"});
    const test::Run run = run_tool(arguments);
    ASSERT_EQ(run.code, 0) << run.err;
  }
  static void make_photons() {
    if (!std::filesystem::exists(path("photons")))
      must({"photons", scene(), "--photons", "20000", "-o", path("photons")});
  }
  static void make_irradiance() {
    make_photons();
    if (!std::filesystem::exists(path("irradiance")))
      must({"irradiance", scene(), path("photons"), "-o", path("irradiance")});
  }
  static std::string canonical(const std::string& file) {
    const test::Run run = run_tool({"info", file, "--canonical"});
    EXPECT_EQ(run.code, 0) << run.err;
    std::string said;
    for (const std::string& line : lines_of(run.out)) {
      // The index is opaque and compressed: its size is the business of its library.
      const bool opaque = line.find("FLANN index") != std::string::npos;
      said.append(opaque ? "  kdtree         (any size)" : line).append("\n");
    }
    return said;
  }

 private:
  static std::string& folder() {
    static std::string folder;
    return folder;
  }
};

}  // namespace phos::test
