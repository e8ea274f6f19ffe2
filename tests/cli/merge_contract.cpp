// phos-merge at the command line: shards of phos-photons, joined to the bytes of the whole run.
#include <gtest/gtest.h>

#include "support/run.h"

namespace phos {
namespace {

using Result = test::Run;
using test::run_tool;

class MergeCli : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::scratch("merge_cli"); }
  std::string path(const std::string& name) const { return folder_ + "/" + name + ".photons"; }

  std::string photons(const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> all{"photons", test::data("cornell-measured.glb"), "--photons", "5003", "-o",
                                 path(name)};
    all.insert(all.end(), more.begin(), more.end());
    const Result run = run_tool(all);
    EXPECT_EQ(run.code, 0) << run.err;
    return path(name);
  }

  void expect_refused(std::vector<std::string> shards, int code, const std::string& says) {
    shards.insert(shards.begin(), "merge");
    shards.insert(shards.end(), {"-o", path("bad")});
    const Result run = run_tool(shards);
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("bad")));
  }

  std::string folder_;
};

TEST_F(MergeCli, AnyOrderGivesTheBytesOfTheWhole) {
  const std::string whole = photons("whole", {"--threads", "2"});
  const std::string a = photons("a", {"--shard", "1/3", "--threads", "1"}),
                    b = photons("b", {"--shard", "2/3"}), c = photons("c", {"--shard", "3/3"});
  const Result run = run_tool({"merge", c, a, b, "-o", path("merged")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(test::slurp(path("merged")), test::slurp(whole));
  EXPECT_NE(run_tool({"merge", c, a, b, "-o", path("merged"), "--reuse"}).err.find("up to date"),
            std::string::npos);
}

// 64 MiB hold about 220,000 photons.
TEST_F(MergeCli, MorePhotonsThanMemoryAreMergedOnDisk) {
  const std::vector<std::string> many{"--photons", "150000", "--caustic-photons", "0"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), many.begin(), many.end());
    return more;
  };
  const std::string whole = photons("whole", with({})), a = photons("a", with({"--shard", "1/2"})),
                    b = photons("b", with({"--shard", "2/2"}));
  const std::string stats = folder_ + "/stats.json";
  const Result run = run_tool({"merge", b, a, "--memory", "64M", "-o", path("merged"), "--stats", stats});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("sorted on disk"), std::string::npos) << run.err;
  EXPECT_NE(test::slurp(stats).find("\"on_disk\": true"), std::string::npos) << test::slurp(stats);
  EXPECT_EQ(test::slurp(path("merged")), test::slurp(whole));
  const Result in_memory = run_tool({"merge", a, b, "--memory", "1G", "-o", path("again"), "--stats", stats});
  ASSERT_EQ(in_memory.code, 0) << in_memory.err;
  EXPECT_NE(test::slurp(stats).find("\"on_disk\": false"), std::string::npos) << test::slurp(stats);
  EXPECT_EQ(test::slurp(path("again")), test::slurp(whole));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files += entry.is_regular_file();
  EXPECT_EQ(files, 6u) << "a temporary file is left";
  expect_refused({a, b, "--memory", "3"}, 2, "is no size of memory");
  expect_refused({a, b, "--memory", "2X"}, 2, "is no size of memory");
  expect_refused({a, b, "--memory", "63M"}, 2, "give 64 MiB or more");
}

TEST_F(MergeCli, Refusals) {
  const std::string a = photons("a", {"--shard", "1/2"}), b = photons("b", {"--shard", "2/2"});
  const std::string seed = photons("seed", {"--shard", "2/2", "--seed", "1"}), whole = photons("whole", {});
  expect_refused({}, 2, "SHARD");
  expect_refused({a}, 4, "missing shard 2/2");
  expect_refused({a, a, b}, 4, "and so is");
  expect_refused({a, seed}, 4, "another run");
  expect_refused({whole}, 3, "whole map");
  expect_refused({a, test::data("cornell-measured.glb")}, 3, "cornell-measured.glb");
  expect_refused({a, path("absent")}, 3, "absent");
  std::string damaged = test::slurp(b);
  damaged[damaged.size() - 100] ^= 4;
  test::spill(path("damaged"), damaged);
  expect_refused({a, path("damaged")}, 3, "damaged");
}

}  // namespace
}  // namespace phos
