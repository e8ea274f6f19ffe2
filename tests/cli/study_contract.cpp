// phos-study as a user meets it: refusals, a toy study, going on, and the page.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "file/csv.h"
#include "file/json_parse.h"
#include "image/image.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

namespace fs = std::filesystem;

const std::string kStages =
    "[reference]\nsamples = 16\nsensor_samples = 64\n"
    "[photons]\nphotons = [2000, 8000]\n[irradiance]\naccuracy = [0.2, 0.5]\n[splat]\npixel_samples = 1\n";

/// A folder with the toy scene and a study of it.
std::string toy(const std::string& name, const std::string& more = "", const std::string& stages = kStages) {
  const std::string folder = scratch("study-" + name);
  fs::copy_file(data("cornell-empty.glb"), folder + "/box.glb");
  spill(folder + "/points.csv", "x,y,z,nx,ny,nz\n0.3,0.1,0.1,0,1,0\n0.4,0.2,0.2,0,1,0\n0.2,0.3,0.3,1,0,0\n");
  spill(folder + "/toy.toml",
        "[study]\nscenes = \"box.glb\"\nwidth = 24\nrepeats = 2\nthreads = 1\n" + more + stages);
  return folder;
}

test::Run study(const std::string& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"study", folder + "/toy.toml", "-o", folder + "/out"};
  words.insert(words.end(), more.begin(), more.end());
  return run_tool(words);
}

/// The toy study, run once for all tests that look at its results.
const std::string& finished() {
  static const std::string folder = [] {
    std::string f = toy("finished", "sensors = \"points.csv\"\n");
    const auto run = study(f);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    return f;
  }();
  return folder;
}

CsvTable results(const std::string& folder) {
  return parse_csv(slurp(folder + "/out/results.csv"), "results.csv");
}

/// The table without what a clock or the system says, and what follows from it.
std::vector<std::vector<std::string>> timeless(const CsvTable& table) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : table.rows) {
    rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& name = table.columns[i];
      const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
      if (!has("seconds") && !has("cpu_s") && !has("peak_bytes") && !has("best_in"))
        rows.back().push_back(row[i]);
    }
  }
  return rows;
}

TEST(StudyTool, HelpAndVersion) {
  const auto help = run_tool({"study", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--pictures", "--list", "[photons]", "[reference]", "steps", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  for (const char* option : {"--version", "--man", "--options-json"})
    EXPECT_EQ(run_tool({"study", option}).code, 0);
}

TEST(StudyTool, RefusesBadCommandLines) {
  const std::string folder = toy("refused"), file = folder + "/toy.toml", out = folder + "/out";
  EXPECT_EQ(run_tool({"study"}).code, 2);
  expect_refused("study", {file}, 2, "output");
  expect_refused("study", {folder + "/none.toml", "-o", out}, 3, "none.toml");
  expect_refused("study", {file, "-o", out, "--seed", "3"}, 2, "--seed");
  expect_refused("study", {folder + "/box.glb", "-o", out}, 3, "box.glb");
  spill(folder + "/taken", "");
  expect_refused("study", {file, "-o", folder + "/taken"}, 3, "taken");
}

TEST(StudyTool, RefusesBadStudiesBeforeAnyWork) {
  const std::string folder = toy("bad"), out = folder + "/out";
  const auto refused = [&](const std::string& toml, int code, const std::string& word) {
    spill(folder + "/bad.toml", toml);
    expect_refused("study", {folder + "/bad.toml", "-o", out}, code, word);
    EXPECT_EQ(slurp(out + "/journal.jsonl"), "");
  };
  const std::string box = "[study]\nscenes = \"box.glb\"\n", stages = "[irradiance]\n[splat]\n";
  refused(box, 2, "asks for nothing");
  refused(box + "[irradiance]\nacuracy = 0.1\n[splat]\n", 2, "did you mean \"accuracy\"");
  refused(box + "[irradiance]\naccuracy = { from = 1, to = 0.1, steps = 3 }\n[splat]\n", 2,
          "above the start");
  refused(box + "[irradiance]\nrays = [64, -1]\n[splat]\n", 2, "out of range");
  refused(box + "cameras = \"nowhere\"\n" + stages, 2, "nowhere");
  spill(folder + "/broken.glb", "glTF");
  refused("[study]\nscenes = \"broken.glb\"\n" + stages, 3, "broken.glb");
  spill(folder + "/none.csv", "x,y,z,nx,ny,nz\n");
  refused(box + "sensors = \"none.csv\"\n" + stages, 3, "none.csv");
}

TEST(StudyTool, RefusesASceneWithoutLight) {
  const std::string folder = toy("dark");
  const std::string dark =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"camera":0}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,-1],"max":[1,0,0]}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
      R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/"}]})";
  spill(folder + "/dark.gltf", dark);
  spill(folder + "/dark.toml", "[study]\nscenes = \"dark.gltf\"\n" + kStages);
  expect_refused("study", {folder + "/dark.toml", "-o", folder + "/out"}, 3, "no light");
}

TEST(StudyTool, RefusesAReferenceThatDoesNotBelong) {
  const std::string folder = toy("reference");
  const auto make = [&](const std::string& scene, const std::string& width, const std::string& seed,
                        const std::string& name) {
    ASSERT_EQ(run_tool({"reference", scene, "--width", width, "--samples", "2", "--seed", seed, "-o",
                        folder + "/" + name})
                  .code,
              0);
  };
  make(folder + "/box.glb", "24", "1", "a.exr"), make(folder + "/box.glb", "24", "2", "b.exr");
  make(folder + "/box.glb", "20", "2", "small.exr"),
      make(data("cornell-glossy22.glb"), "24", "1", "other.exr");
  const auto refused = [&](const std::string& files, const std::string& more, const std::string& word) {
    spill(folder + "/given.toml", "[study]\nscenes = \"box.glb\"\n" + more + "[reference]\nfiles = [" +
                                      files + "]\n[irradiance]\n[splat]\n");
    expect_refused("study", {folder + "/given.toml", "-o", folder + "/out"}, 4, word);
  };
  refused("\"a.exr\", \"small.exr\"", "", "20 x 20");
  refused("\"a.exr\"", "width = 30\n", "24 x 24");
  fs::copy_file(folder + "/a.exr", folder + "/twin.exr");
  refused("\"a.exr\", \"twin.exr\"", "", "same picture");
  refused("\"other.exr\"", "", "another scene");
  ASSERT_EQ(run_tool({"reference", folder + "/box.glb", "--camera", "left-view", "--width", "24", "--samples",
                      "2", "-o", folder + "/left.exr"})
                .code,
            0);
  refused("\"left.exr\"", "cameras = \"measured\"\n", "left-view");
  refused("\"a.exr\"", "layer = \"glossy\"\n", "glossy");
  // One that belongs is used: pictures are of its size.
  spill(folder + "/toy.toml",
        "[study]\nscenes = \"box.glb\"\n[reference]\nfiles = [\"a.exr\", \"b.exr\"]\n[photons]\nphotons = "
        "2000\n[irradiance]\n[splat]\n");
  const auto run = study(folder);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("3 of 3 commands"), std::string::npos) << run.err;
  EXPECT_EQ(results(folder).rows.size(), 1u);
}

TEST(StudyTool, MeasuresEverySetting) {
  const CsvTable table = results(finished());
  ASSERT_EQ(table.rows.size(), 4u);
  const auto number = [&](std::size_t row, const char* name) {
    return table.number(row, table.column(name, name));
  };
  for (std::size_t i = 0; i < 4; ++i) {
    for (const char* kind : {"picture_", "lux_"}) {
      const auto of = [&](const char* name) { return number(i, (std::string(kind) + name).c_str()); };
      EXPECT_GT(of("error"), 0.001) << kind << i;
      EXPECT_LT(of("error"), 1) << kind << i;
      EXPECT_LE(of("error_lo"), of("error"));
      EXPECT_GE(of("error_hi"), of("error"));
      EXPECT_GT(of("seconds"), 0);
      EXPECT_GT(of("resolution"), 0);
      EXPECT_GT(of("peak_bytes"), 1e6);
      EXPECT_GT(of("file_bytes"), 1e4);
    }
    EXPECT_EQ(number(i, "seeds"), 2);
    EXPECT_EQ(table.rows[i].back(), "");  // nothing failed
  }
  EXPECT_EQ(number(3, "photons.photons"), 8000);
  EXPECT_EQ(number(3, "irradiance.accuracy"), 0.5);
  EXPECT_GT(number(0, "picture_error"), number(2, "picture_error")) << "four times the photons";
}

TEST(StudyTool, SharedStagesRunOnce) {
  std::map<std::string, int> runs;
  std::istringstream journal(slurp(finished() + "/out/journal.jsonl"));
  for (std::string line; std::getline(journal, line);) {
    const std::string command = parse_json(line, "journal").find("command")->as_string();
    ++runs[command.substr(0, command.find(' '))];
  }
  // Two seeds: 2 photon maps, 4 caches, 4 pictures, 4 tables; two references of each kind.
  EXPECT_EQ(runs, (std::map<std::string, int>{{"phos-photons", 4},
                                              {"phos-irradiance", 8},
                                              {"phos-splat", 8},
                                              {"phos-sense", 8},
                                              {"phos-reference", 4}}));
}

TEST(StudyTool, CommandsMakeThePicturesAgain) {
  const std::string& folder = finished();
  const Json all = parse_json(slurp(folder + "/out/results.json"), "results.json");
  const Json& run = all.find("runs")->as_array()[3];
  const Json::Array& commands = run.find("picture_commands")->as_array();
  ASSERT_EQ(commands.size(), 3u);
  std::istringstream line(commands[2].find("command")->as_string());
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  const std::string before = slurp(words.back());
  words[0] = "splat", words.back() = folder + "/again.exr";
  EXPECT_EQ(run_tool(words).code, 0);
  EXPECT_EQ(slurp(folder + "/again.exr"), before);
  EXPECT_GT(run.find("picture")->find("relative_rmse")->as_number(), 0);
  EXPECT_EQ(all.find("points")->as_array().size(), 4u);
}

TEST(StudyTool, PageHoldsEverything) {
  const std::string out = finished() + "/out/", page = slurp(out + "index.html");
  for (const char* word : {"<svg", "data:image/png;base64,", "type=\"range\"", "table class=\"sorts\"",
                           "What each parameter buys", "phos-photons ", "--accuracy 0.5", "reference"})
    EXPECT_NE(page.find(word), std::string::npos) << word;
  for (const char* outside :
       {"src=\"http", "href=", "@import", "url(", "<link", "<iframe", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const std::string name :
       {"picture-error-time", "picture-error-memory", "picture-error-bytes", "lux-error-time",
        "picture-effect-photons-photons", "lux-effect-irradiance-accuracy"}) {
    EXPECT_EQ(slurp(out + name + ".svg").substr(0, 4), "<svg") << name;
    EXPECT_EQ(read_png(out + name + ".png").width, 1440) << name;
  }
}

TEST(StudyTool, SecondRunReusesEverything) {
  const std::string& folder = finished();
  const std::string csv = slurp(folder + "/out/results.csv"), page = slurp(folder + "/out/index.html");
  const auto again = study(folder);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("0 of 32 commands"), std::string::npos) << again.err;
  EXPECT_EQ(slurp(folder + "/out/results.csv"), csv);
  EXPECT_EQ(slurp(folder + "/out/index.html"), page);
}

TEST(StudyTool, OnlyWhatIsMissingIsMadeAgain) {
  const std::string folder = toy("missing");
  ASSERT_EQ(study(folder).code, 0);
  const auto left = [&] {
    const auto list = study(folder, {"--list"});
    return std::count(list.out.begin(), list.out.end(), '\n');
  };
  EXPECT_EQ(left(), 0);
  std::string picture;
  for (const auto& entry : fs::directory_iterator(folder + "/out/cache")) {
    if (entry.path().extension() == ".irradiance" || entry.path().extension() == ".photons")
      fs::remove(entry.path());
    if (entry.path().extension() == ".exr") picture = entry.path().string();
  }
  EXPECT_EQ(left(), 0) << "nobody reads the caches again";
  // More settings need what they share with those before: 2 accuracies, 2 seeds, photons that are gone.
  spill(folder + "/toy.toml",
        "[study]\nscenes = \"box.glb\"\nwidth = 24\nrepeats = 2\nthreads = 1\n[reference]\nsamples = "
        "16\n[photons]\nphotons = 2000\n"
        "[irradiance]\naccuracy = [0.2, 0.4]\n[splat]\npixel_samples = 1\n");
  EXPECT_EQ(left(), 2 + 2 + 2) << "photons again; caches and pictures of accuracy 0.4";
}

TEST(StudyTool, DiscardsWhatNobodyReads) {
  const std::string folder = toy("discard");
  const auto run = study(folder, {"--discard"});
  ASSERT_EQ(run.code, 0) << run.err;
  std::map<std::string, int> kinds;
  for (const auto& entry : fs::directory_iterator(folder + "/out/cache"))
    ++kinds[entry.path().extension().string()];
  EXPECT_EQ(kinds, (std::map<std::string, int>{{".exr", 2 + 8}}));
  EXPECT_EQ(study(folder, {"--list"}).out, "");
}

TEST(StudyTool, GoesOnWhereItWasInterrupted) {
  const std::string whole = toy("whole"), cut = toy("cut");
  ASSERT_EQ(study(whole).code, 0);
  const Process process({"study", cut + "/toy.toml", "-o", cut + "/out"});
  for (int i = 0; i < 3000; ++i) {
    const std::string journal = slurp(cut + "/out/journal.jsonl");
    if (std::count(journal.begin(), journal.end(), '\n') >= 6) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  process.signal(SIGINT);
  EXPECT_EQ(process.wait().code, 130);
  EXPECT_FALSE(fs::exists(cut + "/out/results.csv"));
  const std::string before = slurp(cut + "/out/journal.jsonl");
  const auto rest = study(cut);
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(rest.err.find("22 of 22 commands"), std::string::npos) << rest.err;
  EXPECT_EQ(slurp(cut + "/out/journal.jsonl").substr(0, before.size()), before) << "nothing ran twice";
  EXPECT_EQ(timeless(results(cut)).size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::string> a = timeless(results(whole))[i], b = timeless(results(cut))[i];
    a[1] = b[1] = "";  // the scene's path
    EXPECT_EQ(a, b);
  }
}

TEST(StudyTool, AFailingSettingLeavesTheRest) {
  const std::string folder =
      toy("failing", "",
          "[reference]\nsamples = 4\n[photons]\nphotons = 2000\n"
          "[irradiance]\nat = [\"points.csv\", \"broken.csv\"]\n[splat]\npixel_samples = 1\n");
  spill(folder + "/broken.csv", "x,y,z\nhere\n");
  const auto run = study(folder);
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("1 of 2 settings failed"), std::string::npos) << run.err;
  const CsvTable table = results(folder);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].back(), "");
  EXPECT_NE(table.rows[1].back().find("broken.csv"), std::string::npos);
  EXPECT_TRUE(std::isnan(table.number(1, table.column("picture_error", ""))));
  EXPECT_GT(table.number(0, table.column("picture_error", "")), 0);
}

}  // namespace
