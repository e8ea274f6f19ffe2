// Inputs of programs: told apart by their contents, in any order.
#include <gtest/gtest.h>

#include <algorithm>

#include "stage/inputs.h"
#include "support/container.h"
#include "support/run.h"

namespace phos::stage {
namespace {

class Inputs : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch("stage-inputs");
    for (const char* name : {"a.glb", "b.glb"}) test::spill(path(name), "a scene, by all that is looked at");
    test::spill(path("empty.glb"), "");
    for (const char* kind : {"photons", "irradiance", "radiance", "brdf", "image"}) {
      Provenance provenance = test::sample_provenance();
      provenance.kind = kind;
      ContainerWriter().write(path(kind), provenance);
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::vector<std::string> paths(const std::vector<std::string>& names) const {
    std::vector<std::string> all;
    for (const std::string& name : names) all.push_back(path(name));
    return all;
  }
  /// Of sorting these as what records are made from.
  void expect_refused(const std::vector<std::string>& names, ExitCode code, const std::string& says) const {
    try {
      sort_record_inputs(paths(names));
      ADD_FAILURE() << "not refused: " << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), code) << e.what();
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
  std::string folder_;
};

TEST_F(Inputs, OrderOfRecordInputsDoesNotMatter) {
  std::vector<std::string> names{"a.glb", "brdf", "irradiance", "photons", "radiance"};
  do {
    const RecordFiles files = sort_record_inputs(paths(names));
    EXPECT_EQ(files.scene, path("a.glb"));
    EXPECT_EQ(files.photons, path("photons"));
    EXPECT_EQ(files.source, path("irradiance"));
    EXPECT_EQ(files.radiance, path("radiance"));
    EXPECT_EQ(files.brdf, path("brdf"));
  } while (std::next_permutation(names.begin(), names.end()));
}

TEST_F(Inputs, RecordInputsAreOneOfAKind) {
  expect_refused({"photons"}, ExitCode::usage, "no scene among the inputs");
  expect_refused({"a.glb", "b.glb"}, ExitCode::usage, "is a second scene");
  expect_refused({"a.glb", "photons", "photons"}, ExitCode::usage, "is a second photon map");
  expect_refused({"a.glb", "image"}, ExitCode::usage, "holds image");
  expect_refused({"missing.glb"}, ExitCode::bad_input, "");
  expect_refused({"empty.glb"}, ExitCode::bad_input, "the file is empty");
}

TEST_F(Inputs, CachesKeepTheirOrder) {
  const InputFiles files = sort_inputs(paths({"radiance", "a.glb", "irradiance"}), Beside::caches);
  EXPECT_EQ(files.scene, path("a.glb"));
  EXPECT_EQ(files.phos, paths({"radiance", "irradiance"}));
}

TEST_F(Inputs, OneSceneAmongCachesIsTheScene) {
  const InputFiles usual = scene_and_others(path("a.glb"), paths({"radiance", "brdf"}));
  EXPECT_EQ(usual.scene, path("a.glb"));
  EXPECT_EQ(usual.phos, paths({"radiance", "brdf"}));
  const InputFiles turned = scene_and_others(path("radiance"), paths({"brdf", "a.glb"}));
  EXPECT_EQ(turned.scene, path("a.glb"));
  EXPECT_EQ(turned.phos, paths({"radiance", "brdf"}));
}

TEST_F(Inputs, OrdersThatAreNoneAreLeft) {
  const InputFiles two = scene_and_others(path("radiance"), paths({"a.glb", "b.glb"}));
  EXPECT_EQ(two.scene, path("radiance"));
  EXPECT_EQ(two.phos, paths({"a.glb", "b.glb"}));
  const InputFiles none = scene_and_others(path("radiance"), paths({"brdf"}));
  EXPECT_EQ(none.scene, path("radiance"));
  const InputFiles missing = scene_and_others(path("missing"), paths({"a.glb"}));
  EXPECT_EQ(missing.scene, path("missing"));
}

TEST_F(Inputs, LobesAloneAreNoCaches) {
  EXPECT_EQ(open_caches(paths({"radiance", "brdf"}), CacheKinds::records_and_lobes).size(), 2u);
  EXPECT_THROW(open_caches(paths({"brdf"}), CacheKinds::records_and_lobes), Error);
  EXPECT_THROW(open_caches(paths({"radiance", "brdf"}), CacheKinds::records), Error);
  EXPECT_TRUE(open_caches({}, CacheKinds::records).empty());
  EXPECT_THROW(open_caches(paths({"radiance", "photons"}), CacheKinds::records), Error);
}

}  // namespace
}  // namespace phos::stage
