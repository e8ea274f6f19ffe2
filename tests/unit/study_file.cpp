// Study files: what they mean, and how wrong ones are refused.
#include "study/spec/study_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "study/spec/check.h"
#include "study/spec/settings.h"
#include "study/spec/tools.h"
#include "study/spec/values.h"
#include "support/run.h"

namespace phos {
namespace {

ToolOption number(const std::string& kind, Range range = {}) { return {"x", kind, "M", {}, range, {}}; }

std::vector<Json> values(const ToolOption& option, const std::string& toml) {
  const TomlFile file = parse_toml("[s]\nx = " + toml + "\n", "s.toml");
  return values_of(option, *file.root.find("s")->find("x"), file.where("s.x"));
}

std::string complaint(const std::function<void()>& work, ExitCode code) {
  try {
    work();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code) << e.what();
    return e.where() + ": " + e.what();
  }
  ADD_FAILURE() << "nothing was wrong";
  return "";
}

TEST(StudyToml, KnowsLines) {
  const TomlFile file =
      parse_toml("# a study\n[study]\nscenes = [\"a\"]\n\n[photons]\nphotons = 1e5\n", "s.toml");
  EXPECT_EQ(file.root.dump(), R"({"photons":{"photons":1e+05},"study":{"scenes":["a"]}})");
  EXPECT_EQ(file.where("photons.photons"), "s.toml:6");
  EXPECT_EQ(file.where("photons"), "s.toml:5");
  EXPECT_EQ(file.where("nothing"), "s.toml");
  EXPECT_NE(
      complaint([] { parse_toml("[study]\nscenes = [\n", "s.toml"); }, ExitCode::bad_input).find("s.toml:"),
      std::string::npos);
  EXPECT_NE(complaint([] { parse_toml("[study]\nday = 2020-01-01\n", "s.toml"); }, ExitCode::bad_input)
                .find("s.toml:2"),
            std::string::npos);
}

TEST(StudyValues, OneOrAList) {
  EXPECT_EQ(values(number("number"), "0.5"), (std::vector<Json>{0.5}));
  EXPECT_EQ(values(number("number"), "[0.5, 1]"), (std::vector<Json>{0.5, 1}));
}

TEST(StudyValues, Ranges) {
  EXPECT_EQ(values(number("number"), "{ from = 1, to = 2, steps = 3 }"), (std::vector<Json>{1.0, 1.5, 2.0}));
  EXPECT_EQ(values(number("number"), "{ from = 0.1, to = 0.4, steps = 3, scale = \"log\" }"),
            (std::vector<Json>{0.1, 0.2, 0.4}));
  EXPECT_EQ(values(number("integer"), "{ from = 1e3, to = 1e6, steps = 4, scale = \"log\" }"),
            (std::vector<Json>{1e3, 1e4, 1e5, 1e6}));
  // 1, 1.26, 1.59, 2, 2.52, 3.17, 4 as whole numbers.
  EXPECT_EQ(values(number("number"), "{ from = 1, to = 4, steps = 7, scale = \"log\" }")[1], Json(1.25992));
  EXPECT_EQ(values(number("integer"), "{ from = 1, to = 16, steps = 9, scale = \"log\" }"),
            (std::vector<Json>{1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 11.0, 16.0}));
}

TEST(StudyValues, ContradictionsAreRefused) {
  const auto wrong = [](const char* toml, const char* word, const char* kind = "number") {
    const std::string said = complaint([&] { values(number(kind), toml); }, ExitCode::usage);
    EXPECT_EQ(said.find("s.toml:2"), 0u) << said;
    EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  wrong("[]", "empty");
  wrong("[1, 2, 1]", "twice");
  wrong("[1, 1.0]", "twice");
  wrong("{ from = 2, to = 1, steps = 3 }", "above");
  wrong("{ from = 1, to = 1, steps = 3 }", "above");
  wrong("{ from = 0, to = 1, steps = 3, scale = \"log\" }", "above 0");
  wrong("{ from = 0, to = 1, steps = 1 }", "steps");
  wrong("{ from = 0, to = 1 }", "steps");
  wrong("{ from = 0, steps = 3 }", "to");
  wrong("{ from = 0, to = 1, steps = 3, step = 2 }", "step");
  wrong("{ from = 0, to = 1, steps = 3, scale = \"cubic\" }", "scale");
  wrong("{ from = 0, to = 3, steps = 9 }", "whole numbers", "integer");
  wrong("{ from = 0, to = 3, steps = 2 }", "list its values", "choice");
}

TEST(StudyTools, ValuesAreCheckedAsTheProgramWould) {
  const auto words = [](const ToolOption& option, const Json& v) {
    return option_words(option, v, "", "here");
  };
  EXPECT_EQ(words(number("integer"), 1e5), (std::vector<std::string>{"--x", "100000"}));
  EXPECT_EQ(words(number("number"), 0.1), (std::vector<std::string>{"--x", "0.1"}));
  EXPECT_EQ(words(number("flag"), true), (std::vector<std::string>{"--x"}));
  EXPECT_TRUE(words(number("flag"), false).empty());
  ToolOption choice = number("choice");
  choice.choices = {"hull", "disc"};
  EXPECT_EQ(words(choice, "disc"), (std::vector<std::string>{"--x", "disc"}));
  const auto wrong = [&](const ToolOption& option, const Json& v, const char* word) {
    const std::string said = complaint([&] { words(option, v); }, ExitCode::usage);
    EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  wrong(number("integer"), 1.5, "whole number");
  wrong(number("number"), "much", "not a number");
  wrong(number("number", kPositive), 0.0, "above 0");
  wrong(number("number", {0, 1}), 2, "at least 0 and at most 1");
  wrong(number("flag"), 1, "true or false");
  wrong(choice, "disk", "\"disc\"");
}

TEST(StudySettings, EveryValueWithEveryOther) {
  StudyFile study;
  study.scenes = {"a.glb", "b.glb"}, study.cameras = {"x", "y"};
  study.factors = {{"photons", "photons", {"1", "2", "3"}, {{"1"}, {"2"}, {"3"}}, 0},
                   {"irradiance", "rays", {"8", "9"}, {{"8"}, {"9"}}, 0}};
  const std::vector<Setting> settings = expand_settings(study);
  ASSERT_EQ(settings.size(), 24u);
  EXPECT_EQ(settings[0].level, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(settings[1].level, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(settings[2].level, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(settings[6].camera, 1u);
  EXPECT_EQ(settings[23].scene, 1u);
  EXPECT_EQ(describe(study, settings[3]), "photons 2, rays 9");
  study.factors[1].option = "photons";
  EXPECT_EQ(describe(study, settings[3]), "photons.photons 2, irradiance.photons 9");
  study.factors.clear();
  EXPECT_EQ(describe(study, expand_settings(study)[0]), "as given");
}

TEST(StudySettings, TooManyAreRefused) {
  StudyFile study;
  study.scenes = {"a.glb"}, study.cameras = {""};
  for (const char* name : {"a", "b"}) {
    study.factors.push_back({"photons", name, {}, {}, 0});
    for (int i = 0; i < 1000; ++i) study.factors.back().words.push_back({std::to_string(i)});
  }
  EXPECT_NE(complaint([&] { expand_settings(study); }, ExitCode::usage).find("100000"), std::string::npos);
}

/// A study of the toy scene, and the programs that it asks.
class StudyFiles : public ::testing::Test {
 protected:
  StudyFiles() : folder_(test::scratch("study-file")), runner_({}, PHOS_TOOLS) {
    std::filesystem::copy_file(test::data("cornell-empty.glb"), folder_ + "/box.glb");
    test::spill(folder_ + "/points.csv", "x,y,z,nx,ny,nz\n1,1,1,0,1,0\n");
  }
  StudyFile read(const std::string& toml) {
    test::spill(folder_ + "/s.toml", toml);
    return read_study(folder_ + "/s.toml", runner_);
  }
  void wrong(const std::string& toml, const std::string& word, ExitCode code = ExitCode::usage) {
    const std::string said = complaint([&] { read(toml); }, code);
    EXPECT_NE(said.find(word), std::string::npos) << said;
    EXPECT_EQ(said.find(folder_ + "/s.toml"), 0u) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  std::string folder_;
  CommandRunner runner_;
};

const std::string kBox = "[study]\nscenes = \"box.glb\"\n";

TEST_F(StudyFiles, IsRead) {
  const StudyFile s = read(
      "[study]\nscenes = [\"box.glb\"]\ncameras = \"eye\"\nrepeats = 2\nsensors = \"points.csv\"\nwidth = "
      "50\n"
      "[reference]\nsamples = 8\nseeds = [7, 8]\nsensor_samples = 99\n"
      "[photons]\nphotons = [1e3, 1e4]\n"
      "[irradiance]\nmin_photons = 20\naccuracy = [0.1, 0.2]\ncamera = \"each\"\n"
      "[splat]\n[common]\nisa = \"sse2\"\n");
  EXPECT_EQ(s.scenes, std::vector<std::string>{folder_ + "/box.glb"});
  EXPECT_EQ(s.cameras, std::vector<std::string>{"eye"});
  EXPECT_EQ(s.seeds, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(s.reference_seeds, (std::vector<std::int64_t>{7, 8}));
  EXPECT_EQ(s.sensor_samples, 99);
  ASSERT_EQ(s.factors.size(), 2u);
  EXPECT_EQ(s.factors[0].name(), "photons.photons");
  EXPECT_EQ(s.factors[0].labels, (std::vector<std::string>{"1000", "10000"}));
  EXPECT_EQ(s.factors[1].words[1], (std::vector<std::string>{"--accuracy", "0.2"}));
  EXPECT_EQ(s.fixed.at("irradiance"),
            (std::vector<std::string>{"--camera", kEachCamera, "--min-photons", "20", "--isa", "sse2"}));
  EXPECT_TRUE(s.sections.contains("sense"));  // sensors are asked for
  EXPECT_EQ(s.reference, (std::vector<std::string>{"--samples", "8"}));
}

TEST_F(StudyFiles, ReferencesOfSeveralViews) {
  for (const char* name : {"a.exr", "b.exr", "c.exr", "l.csv"}) test::spill(folder_ + "/" + name, "");
  const std::string views =
      kBox + "cameras = [\"x\", \"y\"]\nsensors = \"points.csv\"\n[irradiance]\n[splat]\n";
  const StudyFile s = read(views +
                           "[reference]\nlux = \"l.csv\"\n"
                           "[[reference.given]]\ncamera = \"x\"\nfiles = [\"a.exr\", \"b.exr\"]\n"
                           "[[reference.given]]\ncamera = \"y\"\nscene = \"box.glb\"\nfiles = \"c.exr\"\n");
  const auto of = [&](const char* camera) {
    return given(s, s.scenes[0], camera, &GivenReference::pictures);
  };
  EXPECT_EQ(of("x"), (std::vector<std::string>{folder_ + "/a.exr", folder_ + "/b.exr"}));
  EXPECT_EQ(of("y"), std::vector<std::string>{folder_ + "/c.exr"});
  EXPECT_EQ(given(s, s.scenes[0], "", &GivenReference::lux), std::vector<std::string>{folder_ + "/l.csv"});
  wrong(views + "[reference]\nfiles = \"a.exr\"\n", "[[reference.given]]");
  wrong(views + "[[reference.given]]\ncamera = \"z\"\nfiles = \"a.exr\"\n", "\"z\"");
  wrong(views + "[[reference.given]]\nfile = \"a.exr\"\n", "did you mean \"files\"");
  wrong(views + "[[reference.given]]\ncamera = \"x\"\nfiles = [\"a.exr\", \"b.exr\", \"c.exr\"]\n",
        "two of different seeds");
}

TEST_F(StudyFiles, WrongOnesAreRefused) {
  wrong("[study]\nscenes = \"box.glb\"\n", "asks for nothing");
  wrong("[study]\n", "scenes");
  wrong(kBox + "[splat]\n", "[irradiance]");
  wrong(kBox + "[photons]\n[splat]\n", "feeds nothing");
  wrong(kBox + "[photon]\n", "did you mean \"photons\"");
  wrong(kBox + "[photons]\nphoton = 5\n[irradiance]\n[splat]\n", "did you mean \"photons\"");
  wrong(kBox + "[photons]\nphotons = -5\n[irradiance]\n[splat]\n", "s.toml:4");
  wrong(kBox + "[irradiance]\nestimate = \"rays\"\n[splat]\n", "is not one of");
  wrong(kBox + "[irradiance]\nseed = 3\n[splat]\n", "[study] seeds");
  wrong(kBox + "[irradiance]\n[splat]\nwidth = 30\n", "[study] width");
  wrong(kBox + "[irradiance]\n[splat]\nmisses = \"m.csv\"\n", "leave it out");
  wrong(kBox + "[irradiance]\n[splat]\n[sense]\n", "sensors");
  wrong(kBox + "[irradiance]\n[temporal]\n[splat]\n", "leave one out");
  wrong(kBox + "seeds = [1]\nrepeats = 2\n[irradiance]\n[splat]\n", "contradicts");
  wrong(kBox + "seeds = []\n[irradiance]\n[splat]\n", "empty");
  wrong(kBox + "seeds = [1, 1]\n[irradiance]\n[splat]\n", "twice");
  wrong(kBox + "confidence = 1\n[irradiance]\n[splat]\n", "below 1");
  wrong(kBox + "time = \"sun\"\n[irradiance]\n[splat]\n", "\"cpu\"");
  wrong(kBox + "senors = \"points.csv\"\n", "did you mean \"sensors\"");
  wrong(kBox + "[irradiance]\n[splat]\n[reference]\nsamples = [1, 2]\n", "one value");
  wrong(kBox + "[irradiance]\n[splat]\n[reference]\nseeds = [1, 2, 3]\n", "two at most");
  wrong(kBox + "[irradiance]\n[splat]\n[reference]\nsample = 3\n", "did you mean \"samples\"");
  wrong(kBox + "[irradiance]\n[splat]\n[common]\nacuracy = 3\n", "did you mean \"accuracy\"");
  wrong(kBox + "[irradiance]\n[splat]\n[common]\naccuracy = [0.1, 0.2]\n", "own section");
  wrong("scenes = 3\n", "scenes");
  wrong("[study]\nscenes = \"none.glb\"\n", "none.glb", ExitCode::bad_input);
  wrong(kBox + "[irradiance]\n[splat]\n[reference]\nfiles = [\"r.exr\"]\n", "r.exr", ExitCode::bad_input);
  wrong("[study\n", "TOML", ExitCode::bad_input);
}

}  // namespace
}  // namespace phos
