// A toy study: what it measures, runs once, leaves, and goes on with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "file/json_parse.h"
#include "image/image.h"
#include "support/study.h"

namespace {

using namespace phos;
using namespace phos::test;

namespace fs = std::filesystem;

/// The toy study, run once for all tests that look at its results.
const std::string& finished() {
  static const std::string folder = [] {
    std::string f = toy_study("finished", "sensors = \"points.csv\"\n");
    const auto run = study(f);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    return f;
  }();
  return folder;
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

TEST(StudyRuns, MeasuresEverySetting) {
  const CsvTable table = results(finished());
  ASSERT_EQ(table.rows.size(), 4u);
  const auto number = [&](std::size_t row, const char* name) {
    return table.number(row, table.column(name, name));
  };
  for (std::size_t i = 0; i < 4; ++i) {
    for (const char* kind : {"picture_", "lux_"}) {
      const auto of = [&](const char* name) { return number(i, (std::string(kind) + name).c_str()); };
      EXPECT_GE(of("error"), 0) << kind << i;  // a few sensors may be right by chance
      EXPECT_GT(of("error_hi"), 0.001) << kind << i;
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

TEST(StudyRuns, TheReferencesNoiseIsNoError) {
  // The same picture by references of ever fewer samples: the same error, ever less surely.
  const std::string folder = toy_study("noise");
  double lo = 0, hi = 1, resolution = 0;
  for (const int samples : {128, 16, 2}) {
    spill(folder + "/toy.toml",
          "[study]\nscenes = \"box.glb\"\nwidth = 48\nthreads = 1\n[reference]\nsamples = " +
              std::to_string(samples) + "\n[photons]\nphotons = 20000\n[irradiance]\n[splat]\n");
    ASSERT_EQ(study(folder).code, 0);
    const CsvTable table = results(folder);
    const auto of = [&](const char* name) { return table.number(0, table.column(name, "")); };
    lo = std::max(lo, of("picture_error_lo")), hi = std::min(hi, of("picture_error_hi"));
    EXPECT_LT(lo, hi) << samples;
    EXPECT_GT(of("picture_resolution"), 1.5 * resolution) << samples;
    resolution = of("picture_resolution");
    // Without taking it out, the noise alone would be more than what is found.
    if (samples == 2) {
      EXPECT_GT(of("picture_reference_noise"), 2 * hi);
    }
  }
}

TEST(StudyRuns, SharedStagesRunOnce) {
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

TEST(StudyRuns, CommandsMakeThePicturesAgain) {
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

TEST(StudyRuns, PageHoldsEverything) {
  const std::string out = finished() + "/out/", page = slurp(out + "index.html");
  for (const char* word :
       {"data:image/svg+xml;base64,", "data:image/png;base64,", "type=\"range\"", "table class=\"sorts\"",
        "What each parameter buys", "phos-photons ", "--accuracy 0.5", "reference"})
    EXPECT_NE(page.find(word), std::string::npos) << word;
  for (const char* outside :
       {"src=\"http", "href=", "@import", "url(", "<link", "<iframe", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const std::string name :
       {"picture-error-time", "picture-error-memory", "picture-error-bytes", "lux-error-time",
        "picture-effect-photons-photons", "lux-effect-irradiance-accuracy"}) {
    EXPECT_NE(slurp(out + name + ".svg").find("<svg"), std::string::npos) << name;
    EXPECT_EQ(read_png(out + name + ".png").width, 1440) << name;
  }
}

TEST(StudyRuns, SecondRunReusesEverything) {
  const std::string& folder = finished();
  const std::string csv = slurp(folder + "/out/results.csv"), page = slurp(folder + "/out/index.html");
  const auto again = study(folder);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("0 of 32 commands"), std::string::npos) << again.err;
  EXPECT_EQ(slurp(folder + "/out/results.csv"), csv);
  EXPECT_EQ(slurp(folder + "/out/index.html"), page);
}

TEST(StudyRuns, OnlyWhatIsMissingIsMadeAgain) {
  const std::string folder = toy_study("missing");
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

TEST(StudyRuns, DiscardsWhatNobodyReads) {
  const std::string folder = toy_study("discard");
  const auto run = study(folder, {"--discard"});
  ASSERT_EQ(run.code, 0) << run.err;
  std::map<std::string, int> kinds;
  for (const auto& entry : fs::directory_iterator(folder + "/out/cache"))
    ++kinds[entry.path().extension().string()];
  EXPECT_EQ(kinds, (std::map<std::string, int>{{".exr", 2 + 8}}));
  EXPECT_EQ(study(folder, {"--list"}).out, "");
}

TEST(StudyRuns, GoesOnWhereItWasInterrupted) {
  const std::string whole = toy_study("whole"), cut = toy_study("cut");
  ASSERT_EQ(study(whole).code, 0);
  const Process process({"study", cut + "/toy.toml", "-o", cut + "/out"});
  for (int i = 0; i < 3000; ++i) {
    const std::string journal = slurp(cut + "/out/journal.jsonl");
    if (std::count(journal.begin(), journal.end(), '\n') >= 6) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  process.signal(SIGINT);
  const auto stopped = process.wait();
  EXPECT_EQ(stopped.code, 130);
  EXPECT_NE(stopped.err.find(" of 22 commands are done, the same command goes on from there"),
            std::string::npos)
      << stopped.err;
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

TEST(StudyRuns, AFailingSettingLeavesTheRest) {
  const std::string folder = toy_study("failing", "",
                                       "[reference]\nsamples = 4\n[photons]\nphotons = 2000\n"
                                       "[irradiance]\nestimate = \"gather\"\nat = [\"points.csv\", "
                                       "\"broken.csv\"]\n[splat]\npixel_samples = 1\n");
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
