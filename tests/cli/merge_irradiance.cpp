// phos-merge with parts of phos-irradiance --place every: the bytes of the whole run.
#include <gtest/gtest.h>

#include "core/random.h"
#include "support/run.h"

namespace phos::test {
namespace {

class MergeIrradiance : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = scratch("merge_irradiance");
    ASSERT_EQ(run_tool({"photons", scene(), "--photons", "20000", "-o", path("photons")}).code, 0);
    // Points on the floor of the box.
    std::string csv = "x,y,z,nx,ny,nz\n";
    for (std::uint64_t i = 0; i < 60; ++i) {
      RandomStream random(1, Stage::test, i);
      const float x = 0.02f + 0.5f * random.uniform(), z = 0.02f + 0.5f * random.uniform();
      csv += std::to_string(x) + ",0," + std::to_string(z) + ",0,1,0\n";
    }
    spill(folder() + "/points.csv", csv);
  }
  static std::string& folder() {
    static std::string name;
    return name;
  }
  static std::string scene() { return data("cornell-measured.glb"); }
  static std::string path(const std::string& name) { return folder() + "/" + name + ".bin"; }

  static std::string make(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{"irradiance", scene(), path("photons"),          "--place",
                                 "every",      "--at",  folder() + "/points.csv", "-o",
                                 path(name)};
    all.insert(all.end(), more.begin(), more.end());
    const test::Run run = run_tool(all);
    EXPECT_EQ(run.code, 0) << run.err;
    return path(name);
  }
  static void expect_refused(std::vector<std::string> arguments, int code, const std::string& says) {
    arguments.insert(arguments.end(), {"-o", path("bad")});
    const test::Run run = run_tool(arguments);
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("bad")));
  }
};

TEST_F(MergeIrradiance, AnyOrderGivesTheBytesOfTheWhole) {
  const std::string whole = make("whole", {"--threads", "2"});
  const std::string a = make("a", {"--part", "1/3", "--threads", "1"}), b = make("b", {"--part", "2/3"}),
                    c = make("c", {"--part", "3/3"});
  const test::Run run = run_tool({"merge", c, a, b, "-o", path("merged")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("3 parts: 60 records"), std::string::npos) << run.err;
  EXPECT_EQ(slurp(path("merged")), slurp(whole));
  EXPECT_NE(run_tool({"merge", c, a, b, "-o", path("merged"), "--reuse"}).err.find("up to date"),
            std::string::npos);
}

TEST_F(MergeIrradiance, Refusals) {
  const std::string a = make("a", {"--part", "1/2"}), b = make("b", {"--part", "2/2"});
  expect_refused({"merge", a}, 4, "missing part 2/2");
  expect_refused({"merge", a, b, a}, 4, "and so is");
  expect_refused({"merge", a, b, "--memory", "1G"}, 2, "--memory: is for shards of photons");
  expect_refused({"merge", a, make("seed", {"--part", "2/2", "--seed", "1"})}, 4, "another run");
  expect_refused({"merge", make("whole", {})}, 3, "is a whole cache already");
  expect_refused({"merge", a, path("photons")}, 3, "irradiance");
  expect_refused({"merge", path("photons"), a}, 3, "is a whole map already");
  expect_refused({"splat", scene(), a}, 3, "phos-merge");
  const std::string points = folder() + "/points.csv";
  expect_refused(
      {"irradiance", scene(), path("photons"), "--place", "every", "--at", points, "--part", "3/2"}, 2,
      "--part");
  expect_refused({"irradiance", scene(), path("photons"), "--at", points, "--part", "1/2"}, 2, "--part");
}

}  // namespace
}  // namespace phos::test
