// phos-sense as a user meets it: exit codes, messages, tables.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/error.h"
#include "file/csv.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-measured.glb");
const std::string kHeader = "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx\n";

/// The numbers of each line after the header.
std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line + "\n", kHeader);
  while (std::getline(lines, line)) {
    std::vector<double>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::strtod(cell.c_str(), nullptr));
    EXPECT_EQ(row.size(), 11u) << line;
  }
  return rows;
}

/// Photons and a cache of the box, made once.
const std::string& box_folder() {
  static const std::string folder = [] {
    std::string f = scratch("sense-box");
    EXPECT_EQ(run_tool({"photons", kBox, "--photons", "60000", "-o", f + "/box.photons"}).code, 0);
    EXPECT_EQ(run_tool({"irradiance", kBox, f + "/box.photons", "-o", f + "/box.irradiance"}).code, 0);
    return f;
  }();
  return folder;
}

TEST(SenseTool, HelpAndVersion) {
  const auto help = run_tool({"sense", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--points", "--grid", "--mesh", "--height", "--margin", "--up", "--exact",
                           "--leak-test", "--light-samples", "--error", "--summary", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_tool({"sense", "--version"}).code, 0);
}

TEST(SenseTool, PartsAreTheWholeRunLineByLine) {
  const std::string folder = box_folder(), photons = folder + "/box.photons", points = folder + "/desk.csv";
  std::string table = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i < 23; ++i) table += "0." + std::to_string(12 + i) + ",0.2,0.3,0,1,0\n";
  spill(points, table);
  const std::string cache = folder + "/desk.irradiance";
  ASSERT_EQ(run_tool({"irradiance", kBox, photons, "--place", "every", "--at", points, "--estimate", "gather",
                      "--rays", "16", "-o", cache})
                .code,
            0);
  const auto read = [&](const std::vector<std::string>& caches, const std::vector<std::string>& options) {
    std::vector<std::string> words = {"sense", kBox};
    words.insert(words.end(), caches.begin(), caches.end());
    words.insert(words.end(), {"--points", points});
    words.insert(words.end(), options.begin(), options.end());
    const auto run = run_tool(words);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  };
  for (const bool cached : {true, false}) {
    const std::vector<std::string> caches(cached ? 1 : 0, cache);
    std::vector<std::string> options;
    if (!cached) options.push_back("--direct-only");
    const std::string whole = read(caches, options);
    std::string joined = kHeader;
    for (const char* part : {"1/3", "2/3", "3/3"}) {
      std::vector<std::string> of_part = options;
      of_part.insert(of_part.end(), {"--part", part});
      const std::string lines = read(caches, of_part);
      ASSERT_EQ(lines.rfind(kHeader, 0), 0u) << lines;
      joined += lines.substr(kHeader.size());
    }
    EXPECT_EQ(joined, whole);
  }
  // More parts than sensors: the last ones are headers alone, or hold one sensor.
  EXPECT_EQ(read({cache}, {"--part", "1/100"}), kHeader);
}

TEST(SenseTool, PartsNeedARecordAtEachSensor) {
  const std::string cache = box_folder() + "/box.irradiance";
  const std::vector<std::string> grid = {kBox, cache, "--grid", "0.1", "--height", "0.2"};
  const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& more, int code,
                           const std::string& why) {
    words.insert(words.end(), more.begin(), more.end());
    expect_refused("sense", words, code, why);
  };
  refused(grid, {"--part", "1/2"}, 4, "--place every");
  refused(grid, {"--part", "3/2"}, 2, "--part");
  refused(grid, {"--part", "1/2", "--summary", "s.json"}, 2, "--summary");
  refused({kBox, "--grid", "0.1", "--height", "0.2"}, {"--exact", "--part", "1/2"}, 2, "--exact");
}

TEST(SenseTool, RefusesBadCommandLines) {
  EXPECT_EQ(run_tool({"sense"}).code, 2);
  expect_refused("sense", {kBox, "--direct-only"}, 2, "--points");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "1"}, 2, "--mesh");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "1", "--mesh", "floor", "--height", "1"}, 2,
                 "--mesh");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "0", "--height", "1"}, 2, "grid");
  expect_refused("sense", {kBox, "--direct-only", "--points", "p", "--grid", "1", "--height", "1"}, 2,
                 "--points");
  expect_refused("sense", {kBox, "--direct-only", "--points", "p", "--height", "1"}, 2, "--height");
  expect_refused("sense", {kBox, "--grid", "1", "--height", "1"}, 2, "no cache");
  expect_refused("sense", {kBox, kBox, "--grid", "1", "--height", "1"}, 2, "one scene");
  expect_refused("sense", {kBox, "--exact", "--direct-only", "--grid", "1", "--height", "1"}, 2,
                 "--direct-only");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "0.1", "--mesh", "nobody"}, 2, "nobody");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "0.1", "--height", "1", "--samples", "9"}, 2,
                 "samples");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "0.1", "--height", "0.1", "--light-samples", "0"},
                 2, "light-samples");
  expect_refused(
      "sense",
      {kBox, "--direct-only", "--grid", "0.1", "--height", "0.1", "--light-samples", "64", "--error", "0.01"},
      2, "--light-samples");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "0.1", "--height", "0.1", "--error", "0"}, 2,
                 "error");
}

/// Shadow rays follow from the error asked for; sensors that miss it are counted.
TEST(SenseTool, DirectLightIsReadToAnError) {
  const std::string folder = scratch("sense-error");
  double rays[2] = {0, 0};
  for (const int fine : {0, 1}) {
    const std::string error = fine ? "0.001" : "0.01";
    const auto run = run_tool({"sense", kBox, "--direct-only", "--grid", "0.05", "--height", "0.1", "--error",
                               error, "--summary", folder + "/s.json"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string summary = slurp(folder + "/s.json");
    const auto number = [&](const std::string& key) {
      return std::strtod(summary.c_str() + summary.find(key) + key.size() + 2, nullptr);
    };
    rays[fine] = number("shadow_rays");
    double above = 0;
    for (const std::vector<double>& row : rows_of(run.out)) above += row[8] > std::stod(error) * row[7];
    EXPECT_NEAR(above, number("sensors_above_error"), 1);
    EXPECT_LE(above, 0.2 * static_cast<double>(rows_of(run.out).size())) << error;
    EXPECT_EQ(run.err.find("--error asks") != std::string::npos, number("sensors_above_error") > 0);
  }
  EXPECT_GT(rays[1], 3 * rays[0]);
}

TEST(SenseTool, RefusesBadInput) {
  const std::string folder = scratch("sense-input"), p = folder + "/p.csv";
  const auto points = [&](const std::string& content, const std::string& word) {
    spill(p, content);
    expect_refused("sense", {kBox, "--direct-only", "--points", p}, 3, word);
  };
  points("", "p.csv: is empty");
  points("x,y,z,nx,ny\n", "no column nz");
  points("x,y,z,nx,ny,nz\n1,2,3,0,1\n", ":2");
  points("x,y,z,nx,ny,nz\r\n1,2,3,0,1,0\r\n1,2,nan,0,1,0\r\n", ":3: column z");
  points("1 2 3 0 0 0\n", "normal is zero");
  expect_refused("sense", {kBox, "--direct-only", "--points", "-"}, 3, "stdin: is empty");
  expect_refused("sense", {kBox, "--direct-only", "--grid", "0.1", "--height", "0.3", "-o", "/dev/full"}, 3,
                 "/dev/full");
  expect_refused("sense", {kBox, "--direct-only", "--points", folder + "/none.csv"}, 3, "none.csv");
  expect_refused("sense", {folder + "/none.glb", "--direct-only", "--points", p}, 3, "none.glb");
}

TEST(SenseTool, RefusesWrongCaches) {
  const std::string& folder = box_folder();
  expect_refused("sense", {kBox, folder + "/box.photons", "--grid", "0.1", "--height", "0.1"}, 3, "photons");
  expect_refused(
      "sense", {data("cornell-glossy22.glb"), folder + "/box.irradiance", "--grid", "0.1", "--height", "0.1"},
      4, "scene");
  expect_refused("sense",
                 {kBox, folder + "/box.irradiance", "--direct-only", "--grid", "0.1", "--height", "0.1"}, 2,
                 "cache");
  expect_refused("sense", {kBox, folder + "/box.irradiance", "--exact", "--grid", "0.1", "--height", "0.1"},
                 2, "cache");
}

TEST(SenseTool, AHeaderAloneIsNoSensor) {
  const std::string p = scratch("sense-none") + "/p.csv";
  spill(p, "x,y,z,nx,ny,nz\n");
  const auto run = run_tool({"sense", kBox, "--direct-only", "--points", p});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, kHeader);
  EXPECT_NE(run.err.find("no sensor"), std::string::npos);
}

TEST(SenseTool, NamesAndOrderAreKept) {
  const std::string folder = scratch("sense-names"), p = folder + "/p.csv";
  spill(p, "id,x,y,z,nx,ny,nz\n\"b, 1\",0.2,0.3,0.25,0,1,0\na,0.3,0.3,0.25,0,2,0\n");
  const auto run = run_tool({"sense", kBox, "--direct-only", "--points", p, "-o", folder + "/out.csv"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(run.out.empty());
  const std::string csv = slurp(folder + "/out.csv");
  EXPECT_TRUE(csv.starts_with(kHeader + "\"b, 1\",0.2,0.3,0.25,0,1,0,")) << csv;
  EXPECT_NE(csv.find("\na,0.3,0.3,0.25,0,1,0,"), std::string::npos) << csv;
}

TEST(SenseTool, ACacheOfAllLightNeedsNoShadowRays) {
  const std::string folder = scratch("sense-whole"), photons = folder + "/p", all = folder + "/all",
                    indirect = folder + "/indirect";
  ASSERT_EQ(run_tool({"photons", kBox, "--photons", "20000", "-o", photons}).code, 0);
  for (const auto& [paths, cache] : {std::pair{"all", all}, std::pair{"indirect", indirect}})
    ASSERT_EQ(run_tool({"irradiance", kBox, photons, "--paths", paths, "-o", cache}).code, 0);
  const std::vector<std::string> floor{"--grid", "0.1", "--mesh", "floor", "--light-samples", "0"};
  std::vector<std::string> words{"sense", kBox, all};
  words.insert(words.end(), floor.begin(), floor.end());
  const auto run = run_tool(words);
  ASSERT_EQ(run.code, 0) << run.err;
  const CsvTable table = parse_csv(run.out, "table");
  ASSERT_GT(table.rows.size(), 10u);
  const std::size_t whole = table.column("E_lx", "table"), direct = table.column("direct_lx", "table");
  std::size_t covered = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_GE(table.number(i, whole), 0);
    covered += table.rows[i][direct].empty();
  }
  EXPECT_GT(covered, table.rows.size() / 2);
  words = {kBox, indirect};
  words.insert(words.end(), floor.begin(), floor.end());
  expect_refused("sense", words, 2, "--direct cached");
}

TEST(SenseTool, AWorkplaneFromACacheIsWithinErrorOfPathTracing) {
  const std::string folder = scratch("sense-plane"), &box = box_folder();
  const std::vector<std::string> grid{"--grid", "0.11", "--height", "0.4", "--margin", "0.05"};
  std::vector<std::string> cached{"sense",
                                  kBox,
                                  box + "/box.irradiance",
                                  "--summary",
                                  folder + "/s.json",
                                  "--stats",
                                  folder + "/stats.json"},
      exact{"sense", kBox, "--exact", "--samples", "4096", "--seed", "5"};
  cached.insert(cached.end(), grid.begin(), grid.end()), exact.insert(exact.end(), grid.begin(), grid.end());
  const auto a = run_tool(cached), b = run_tool(exact);
  ASSERT_EQ(a.code, 0) << a.err;
  ASSERT_EQ(b.code, 0) << b.err;
  EXPECT_NE(a.err.find("U0"), std::string::npos) << a.err;
  const auto x = rows_of(a.out), y = rows_of(b.out);
  ASSERT_EQ(x.size(), y.size());
  ASSERT_GT(x.size(), 10u);
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(x[i][0], static_cast<double>(i));
    for (std::size_t c = 1; c < 7; ++c) EXPECT_EQ(x[i][c], y[i][c]);
    EXPECT_NEAR(x[i][7], x[i][9] + x[i][10], 1e-3 * x[i][7]);
    EXPECT_LT(std::fabs(x[i][7] - y[i][7]), 5 * std::hypot(x[i][8], y[i][8]) + 0.05 * y[i][7]) << i;
    difference += x[i][7] - y[i][7], sum += y[i][7];
  }
  EXPECT_LT(std::fabs(difference / sum), 0.05);
  for (const std::string& file : {folder + "/s.json", folder + "/stats.json"}) {
    const std::string json = slurp(file);
    for (const char* key : {"\"mean_lx\"", "\"U0\"", "\"Ud\"", "\"misses\"", "\"number\""})
      EXPECT_NE(json.find(key), std::string::npos) << key << json;
  }
}

TEST(SenseTool, PathTracingIsWithinItsOwnError) {
  const std::string p = scratch("sense-exact") + "/p.csv";
  spill(p, "x,y,z,nx,ny,nz\n0.1,0.02,0.1,0,1,0\n0.3,0.4,0.2,0,1,0\n0.45,0.3,0.45,0,0,1\n");
  const auto run = [&](const char* samples, const char* seed) {
    const auto r = run_tool({"sense", kBox, "--exact", "--points", p, "--samples", samples, "--seed", seed});
    EXPECT_EQ(r.code, 0) << r.err;
    return rows_of(r.out);
  };
  const auto rough = run("2000", "1"), fine = run("60000", "2");
  ASSERT_EQ(rough.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(std::fabs(rough[i][7] - fine[i][7]), 4 * std::hypot(rough[i][8], fine[i][8]));
    EXPECT_GT(rough[i][8], 3 * fine[i][8]);
  }
}

/// The blocks have no bottom: a sensor on the floor right inside of one is a centimetre from lit records.
TEST(SenseTool, NoLightThroughWallsUnlessTold) {
  const std::string points = scratch("sense-walls") + "/p.txt";
  spill(points, "0.278825 0 0.298059 0 1 0\n");
  const auto lux = [&](const std::string& leak_test) {
    const auto run =
        run_tool({"sense", kBox, box_folder() + "/box.irradiance", "--points", points, leak_test});
    EXPECT_EQ(run.code, 0) << run.err;
    return rows_of(run.out).at(0)[7];
  };
  EXPECT_EQ(lux("--seed=0"), 0);
  EXPECT_GT(lux("--leak-test=none"), 10) << "no leak to mend: the test shows nothing";
}

TEST(SenseTool, SameBytesOnAnyNumberOfThreads) {
  const std::string& box = box_folder();
  const std::string out = scratch("sense-threads") + "/";
  // 5 x 5 points; two of those 0.3 m up are in the tall block.
  for (const std::string place : {"--mesh=floor", "--height=0.3"}) {
    for (const char* threads : {"1", "2"}) {
      const auto run = run_tool({"sense", kBox, box + "/box.irradiance", "--grid", "0.1", place, "--threads",
                                 threads, "-o", out + threads});
      EXPECT_EQ(run.code, 0) << run.err;
    }
    EXPECT_EQ(slurp(out + "1"), slurp(out + "2"));
    EXPECT_EQ(rows_of(slurp(out + "1")).size(), place == "--mesh=floor" ? 25u : 23u);
  }
}

}  // namespace
