// Sets of caches on a command line: their groups, and what does not go together.
#include <gtest/gtest.h>

#include "scene/lamp/shine_only.h"
#include "stage/view/cache_sets.h"
#include "support/complaint.h"
#include "support/container.h"
#include "support/run.h"
#include "support/scenes.h"

namespace phos::stage {
namespace {

class CacheSets : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch("cache-sets");
    for (const auto& [name, kind, lamps] : {std::tuple("a", "irradiance", "one"),
                                            {"a2", "irradiance", "one"},
                                            {"ar", "radiance", "one"},
                                            {"b", "irradiance", "two"},
                                            {"x=y", "irradiance", ""}}) {
      Provenance provenance = test::sample_provenance();
      provenance.kind = *kind_named(kind);
      if (*lamps) provenance.parameters["lamps"] = lamps;
      ContainerWriter().write(path(name), provenance);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  static std::string refusal(const std::vector<std::string>& words) {
    return test::complaint_of([&] { cache_set(words, "CACHE"); }, ExitCode::usage);
  }
  std::string folder_;
};

TEST_F(CacheSets, WithoutNamesAreOneGroup) {
  const CacheSet set = cache_set({path("a"), path("b"), path("x=y")}, "CACHE");
  ASSERT_EQ(set.groups.size(), 1u);
  EXPECT_FALSE(set.named());
  EXPECT_EQ(set.paths(), (std::vector<std::string>{path("a"), path("b"), path("x=y")}));
}

TEST_F(CacheSets, NamesAreGroups) {
  const CacheSet set = cache_set({"left=" + path("a"), "right=" + path("b"), "left=" + path("ar")}, "CACHE");
  ASSERT_EQ(set.groups.size(), 2u);
  EXPECT_TRUE(set.named());
  EXPECT_EQ(set.groups[0].name, "left");
  EXPECT_EQ(set.groups[0].paths, (std::vector<std::string>{path("a"), path("ar")}));
  EXPECT_EQ(set.groups[1].name, "right");
}

TEST_F(CacheSets, RefuseTwoOfOneName) {
  EXPECT_NE(
      refusal({"left=" + path("a"), "left=" + path("a2")}).find("is a second cache of the group \"left\""),
      std::string::npos);
}

TEST_F(CacheSets, RefuseNamesForSome) {
  for (const auto& words : {std::vector{"left=" + path("a"), path("b")}, {path("b"), "left=" + path("a")}})
    EXPECT_NE(refusal(words).find("b: has no name, and other caches have"), std::string::npos) << words[0];
}

TEST_F(CacheSets, ThatAreComparedHaveTheSameGroups) {
  const CacheSet shown = cache_set({"left=" + path("a"), "right=" + path("b")}, "CACHE");
  const auto says = [&](const std::vector<std::string>& words) {
    return test::complaint_of([&] { require_same_groups(shown, cache_set(words, "--compare")); },
                              ExitCode::usage);
  };
  EXPECT_EQ(says({"right=" + path("b"), "left=" + path("a2")}), "");
  EXPECT_EQ(says({path("x=y")}), "");
  EXPECT_NE(
      says({"right=" + path("b"), "lift=" + path("a")}).find("no group \"lift\"; did you mean \"left\"?"),
      std::string::npos);
  EXPECT_NE(says({"right=" + path("b")}).find("lacks the group \"left\""), std::string::npos);
}

TEST_F(CacheSets, StateTheirLamps) {
  CacheSet set = cache_set({"left=" + path("a"), "right=" + path("b"), "left=" + path("ar")}, "CACHE");
  read_lamps(set);
  EXPECT_EQ(set.groups[0].lamps, "one");
  EXPECT_EQ(set.groups[1].lamps, "two");
  CacheSet mixed = cache_set({path("a"), path("b")}, "CACHE");
  EXPECT_NE(
      test::complaint_of([&] { read_lamps(mixed); }, ExitCode::mismatch).find("was made with --lamps two"),
      std::string::npos);
}

TEST_F(CacheSets, ALampIsInOneGroup) {
  using namespace test;
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
  for (const float x : {0.f, 1.f, 2.f}) add_point_light(scene, {x, 1, 1}, 10);
  finalize(scene);
  CacheSet set{{{"a", {"a.irradiance"}, "lamp 0"}, {"b", {"b.irradiance"}, "lamp 2"}}};
  EXPECT_EQ(require_apart(set, scene), std::vector<std::string>{"lamp 1"});
  set.groups[1].lamps = "lamp 2,lamp 0";
  const auto says = [&] { return test::complaint_of([&] { require_apart(set, scene); }, ExitCode::usage); };
  EXPECT_NE(
      says().find("b.irradiance: holds the light of the lamp \"lamp 0\", which the group \"a\" holds too"),
      std::string::npos)
      << says();
  set.groups[1].lamps = "";
  EXPECT_NE(says().find("holds the light of all lamps"), std::string::npos) << says();
  set.groups.erase(set.groups.begin());
  EXPECT_TRUE(require_apart(set, scene).empty());
}

}  // namespace
}  // namespace phos::stage
