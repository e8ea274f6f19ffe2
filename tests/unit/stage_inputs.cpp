// Inputs of programs: told apart by their contents, in any order.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/load.h"
#include "stage/inputs.h"
#include "stage/site.h"
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
      provenance.kind = *kind_named(kind);
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

/// A program with the options of a scene, and files that record some.
class Site : public Inputs {
 protected:
  Container file(const std::string& kind, const Json& parameters, bool environment = false) const {
    Provenance provenance = test::sample_provenance();
    provenance.kind = *kind_named(kind);
    for (const auto& [name, value] : parameters.as_object()) provenance.parameters[name] = value;
    if (environment) provenance.scene_parts["environment"] = "e";
    ContainerWriter().write(path("site." + kind), provenance);
    return Container::open(path("site." + kind));
  }
  /// Of adopting from these files with these words on the command line.
  Json recorded(std::vector<const char*> words, const std::vector<Container>& files,
                bool allow_mismatch = false) {
    Options options("phos-test", "", "");
    SceneOptions scene;
    declare_options(options, scene);
    words.insert(words.begin(), "phos-test");
    options.parse(static_cast<int>(words.size()), words.data());
    lines_ = adopt_site(options, files, allow_mismatch);
    scene_ = scene;
    return options.recorded();
  }
  void expect_mismatch(const std::vector<const char*>& words, const std::vector<Container>& files,
                       const std::string& says) {
    try {
      recorded(words, files);
      ADD_FAILURE() << "not refused: " << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::mismatch) << e.what();
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
  static Json clear_sky() {
    return Json::Object{{"sky", "clear"}, {"sun", "200,40"}, {"sky-illuminance", 12000}, {"portals", "auto"}};
  }
  std::vector<std::string> lines_;
  SceneOptions scene_;
};

TEST_F(Site, IsTakenAsIfItHadBeenGiven) {
  const std::vector<Container> files{file("photons", clear_sky(), true)};
  const std::vector<const char*> words{"--sky", "clear",     "--sun", "200,40", "--sky-illuminance",
                                       "12000", "--portals", "auto"};
  const Json given = recorded(words, files);
  EXPECT_TRUE(lines_.empty());
  EXPECT_EQ(recorded({}, files).dump(), given.dump());
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_EQ(lines_[0],
            "sky clear, sky-illuminance 12000, sun 200,40, portals auto: as of " + path("site.photons"));
  EXPECT_EQ(scene_.daylight.sun, "200,40");
  EXPECT_EQ(scene_.daylight.sky_lx, 12000);
  EXPECT_EQ(scene_.portals, "auto");
  EXPECT_EQ(recorded({"--sun", "200,40"}, files).dump(), given.dump()) << "the rest";
  EXPECT_EQ(recorded({}, {}).find("sky"), nullptr);
}

TEST_F(Site, SaidOtherwiseIsTheSameSky) {
  const Json taken = recorded({"--sky", "cie:12", "--sun", "-160,40"}, {file("photons", clear_sky(), true)});
  EXPECT_EQ(taken.find("sky")->as_string(), "cie:12");
  EXPECT_EQ(taken.find("sun")->as_string(), "-160,40");
  EXPECT_EQ(taken.find("sky-illuminance")->as_number(), 12000);
}

TEST_F(Site, ContradictionsNameTheOption) {
  const std::vector<Container> files{file("irradiance", clear_sky(), true)};
  expect_mismatch({"--sky", "overcast"}, files, "made with --sky clear, not overcast");
  expect_mismatch({"--sky", "cie:12", "--sun", "200,41"}, files, "made with --sun 200,40, not 200,41");
  expect_mismatch({"--north", "10"}, files, "without --north 10");
  expect_mismatch({"--sky-illuminance", "9000"}, files, "made with --sky-illuminance 12000, not 9000");
  expect_mismatch({"--portals", "glass"}, files, "made with --portals auto, not glass");
  expect_mismatch({"--environment", "sky.hdr"}, files, "not an environment map");
  expect_mismatch({"--location", "52,13", "--when", "2026-06-21T12:00+02:00"}, files, "without --location");
  expect_mismatch({"--sky", "overcast"}, {file("radiance", Json::Object{})}, "made without --sky");
  const Json allowed = recorded({"--sky", "overcast", "--portals", "glass"}, files, true);
  EXPECT_EQ(allowed.find("sky")->as_string(), "overcast");
  EXPECT_EQ(allowed.find("sun"), nullptr) << "nothing of a sky that is not the command's";
  EXPECT_EQ(allowed.find("portals")->as_string(), "glass");
}

TEST_F(Site, PortalsContradictNoFileWithoutThem) {
  Json sky = Json::Object{{"sky", "overcast"}};
  EXPECT_EQ(recorded({"--portals", "auto"}, {file("photons", sky, true)}).find("portals")->as_string(),
            "auto");
}

TEST_F(Site, PortalsMayBeLeftOut) {
  const Json taken = recorded({"--portals", ""}, {file("photons", clear_sky(), true)});
  EXPECT_EQ(taken.find("portals")->as_string(), "");
  EXPECT_EQ(taken.find("sun")->as_string(), "200,40");
  EXPECT_TRUE(scene_.portals.empty());
}

TEST_F(Site, FilesHaveToBeGiven) {
  const std::vector<Container> map{file("photons", Json::Object{{"environment-rotation", 90}}, true)};
  expect_mismatch({}, map, "give the same --environment");
  expect_mismatch({"--sky", "overcast"}, map, "made under an environment map, not --sky overcast");
  EXPECT_EQ(recorded({"--environment", "sky.hdr"}, map).find("environment-rotation")->as_number(), 90);
  EXPECT_TRUE(recorded({}, map, true).find("environment-rotation")->is_null());
  const Json aimed = Json::Object{{"portals", "auto"}};
  EXPECT_EQ(recorded({}, {file("photons", aimed, true)}, true).find("portals"), nullptr) << "at nothing";
  const std::vector<Container> lamps{file(
      "irradiance", Json::Object{{"luminaire", Json::Array{"a lamp", "b"}}, {"luminaires-as", "points"}})};
  expect_mismatch({}, lamps, "made with --luminaire a lamp=FILE --luminaire b=FILE");
  const Json given = recorded({"--luminaire", "b=b.ies", "--luminaire", "a lamp=a.ies"}, lamps);
  EXPECT_EQ(given.find("luminaires-as")->as_string(), "points");
  const std::vector<Container> spectra{
      file("radiance", Json::Object{{"bands", 12}, {"triplet", 2}, {"spectrum", Json::Array{"white"}}})};
  expect_mismatch({"--bands", "12"}, spectra, "give the same --spectrum");
  recorded({"--spectrum", "white=w.csv"}, spectra);
  EXPECT_EQ(scene_.bands.number, 12);
  EXPECT_EQ(scene_.bands.triplet, 2);
}

TEST_F(Site, FirstFileThatSaysItHolds) {
  const std::vector<Container> files{file("brdf", Json::Object{{"sky", "overcast"}}, true),
                                     file("photons", Json::Object{{"frame", 12}}),
                                     file("irradiance", Json::Object{{"frame", 13}, {"bands", 9}})};
  const Json taken = recorded({}, files);
  EXPECT_EQ(taken.find("sky"), nullptr) << "lobes are of materials alone";
  EXPECT_EQ(taken.find("frame")->as_number(), 12);
  EXPECT_EQ(taken.find("bands")->as_integer(), 9);
  ASSERT_EQ(lines_.size(), 2u);
  EXPECT_EQ(lines_[0], "frame 12: as of " + path("site.photons"));
  EXPECT_TRUE(recorded({"--time", "0.5"}, files).find("frame")->is_null()) << "another way to say a time";
}

TEST_F(Site, FilesHoldTheLightOfTheSameLamps) {
  const Container left = file("photons", Json::Object{{"lamps", "a,b"}});
  EXPECT_EQ(recorded({}, {left}).find("lamps")->as_string(), "a,b");
  EXPECT_EQ(scene_.lamps, "a,b");
  EXPECT_EQ(lines_, std::vector<std::string>{"lamps a,b: as of " + path("site.photons")});
  EXPECT_EQ(recorded({"--lamps", "b,a"}, {left}).find("lamps")->as_string(), "b,a");
  expect_mismatch({"--lamps", "c"}, {left},
                  "was made with --lamps a,b, not with --lamps c; leave --lamps out");
  const Container all = file("radiance", Json::Object{});
  expect_mismatch({"--lamps", "c"}, {all}, "was made with all lamps, not with --lamps c");
  expect_mismatch({}, {left, all},
                  "was made with all lamps, not with --lamps a,b; give files of the same lamps");
  expect_mismatch({}, {all, left}, "was made with --lamps a,b, not with all lamps");
  Options options("phos-test", "", "");
  SceneOptions scene;
  declare_options(options, scene);
  EXPECT_TRUE(adopt_site(options, {left, all}, false, LampsOf::each_file).empty());
  EXPECT_EQ(scene.lamps, "");
}

TEST_F(Site, DamagedValuesAreTheFiles) {
  for (const Json& value : {Json("much"), Json(Json::Array{1}), Json(true), Json(-1)}) {
    try {
      recorded({}, {file("photons", Json::Object{{"bands", value}})});
      ADD_FAILURE() << value.dump();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input) << e.what();
    }
  }
}

}  // namespace
}  // namespace phos::stage
