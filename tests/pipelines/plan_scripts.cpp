// Pipelines that plan, climb and count costs, at toy size.
#include <gtest/gtest.h>

#include <algorithm>

#include "file/csv.h"
#include "image/image.h"
#include "support/script.h"

namespace phos::test {
namespace {

class PlanScripts : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("pipelines-plan"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  CsvTable table(const std::string& name) const { return parse_csv(slurp(path(name)), name); }
  std::string folder_;
};

TEST_F(PlanScripts, ALightStudyReportsLuxAndItsError) {
  const auto run = run_script("light-study.sh",
                              {data("cornell-measured.glb"), "out", "--error", "20%", "--grid", "0.08",
                               "--workplane", "0.4", "--width", "32", "--pilot", "0.5"},
                              folder_);
  ASSERT_LE(run.code, 1) << run.err;  // 1: the error is not met, which the report says
  const std::string report = slurp(path("out/report.md"));
  EXPECT_NE(report.find(run.code == 0 ? "Accuracy: met: error" : "Accuracy: not met: error"),
            std::string::npos)
      << report;
  for (const char* file :
       {"image.exr", "image.png", "lux.png", "isolux.svg", "lux.csv", "plan.sh", "plan.json"})
    EXPECT_GT(std::filesystem::file_size(path("out/") + file), 0u) << file;
  EXPECT_GT(table("out/lux.csv").rows.size(), 9u);
  // The figures of the report are those of the table.
  const CsvTable lux = table("out/lux.csv");
  const std::size_t column = lux.column("E_lx", "");
  std::size_t most = 0;
  for (std::size_t i = 0; i < lux.rows.size(); ++i)
    if (lux.number(i, column) > lux.number(most, column)) most = i;
  EXPECT_NE(report.find("| " + lux.rows[most][column].substr(0, 5)), std::string::npos) << report;
}

TEST_F(PlanScripts, IsoluxLinesLieWhereTheLuxIs) {
  // E = 100 x: the line of 50 lx stands at x = 0.5 m, two and a half cells from the first sensor.
  std::string csv = "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx\n";
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 3; ++j) {
      char row[96];
      std::snprintf(row, sizeof row, "\"p, %d\",%g,0.8,%g,0,1,0,%g,0,0,0\n", i, 0.2 * i, 0.2 * j, 20.0 * i);
      csv += row;
    }
  spill(path("lux.csv"), csv);
  const auto run = run_script("isolux.sh", {"lux.csv", "0.2", "lines.svg", "50"}, folder_);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(slurp(path("lines.svg")).find("<svg"), std::string::npos);
  // The line is upright, at half of the frame's width, and as long as the frame is high.
  ASSERT_EQ(run_script("isolux.sh", {"lux.csv", "0.2", "lines.png", "50"}, folder_).code, 0);
  const Picture picture = read_png(path("lines.png"));
  std::vector<int> red(static_cast<std::size_t>(picture.width)), dark = red;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* p = &picture.rgb[static_cast<std::size_t>(3 * (picture.width * y + x))];
      red[static_cast<std::size_t>(x)] += p[0] - std::min(p[1], p[2]) > 100 ? 1 : 0;
      dark[static_cast<std::size_t>(x)] += std::max({p[0], p[1], p[2]}) < 60 ? 1 : 0;
    }
  const auto line = std::max_element(red.begin(), red.end());
  std::vector<double> sides;  // of the frame
  for (std::size_t x = 0; x < dark.size(); ++x)
    if (2 * dark[x] > picture.height) sides.push_back(static_cast<double>(x));
  ASSERT_GE(sides.size(), 2u);
  EXPECT_NEAR(static_cast<double>(line - red.begin()), (sides.front() + sides.back()) / 2, 3);
  EXPECT_GT(*line, 0.8 * *std::max_element(dark.begin(), dark.end()));
  const auto none = run_script("isolux.sh", {"nowhere.csv", "0.2", "lines.svg"}, folder_);
  EXPECT_EQ(none.code, 3);
  spill(path("other.csv"), "a,b\n1,2\n");
  const auto other = run_script("isolux.sh", {"other.csv", "0.2", "x.svg"}, folder_);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("\"x\""), std::string::npos) << other.err;
  EXPECT_FALSE(std::filesystem::exists(path("x.svg")));
}

TEST_F(PlanScripts, TheLadderClimbsOnOneCache) {
  const auto run = run_script(
      "quality-ladder.sh",
      {data("cornell-measured.glb"), "out", "--photons", "20000", "--rays", "64", "--width", "48"}, folder_);
  ASSERT_EQ(run.code, 0) << run.err;
  const CsvTable ladder = table("out/ladder.csv");
  ASSERT_EQ(ladder.rows.size(), 3u);
  const std::size_t records = ladder.column("records", ""), fresh = ladder.column("new_records", ""),
                    seconds = ladder.column("seconds", ""), rmse = ladder.column("rmse_to_final", "");
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(ladder.number(i, records), ladder.number(i - 1, records) + ladder.number(i, fresh));
    EXPECT_GT(ladder.number(i, fresh), 0);
    EXPECT_GT(ladder.number(i, seconds), ladder.number(i - 1, seconds));
    EXPECT_LT(ladder.number(i, rmse), ladder.number(i - 1, rmse));
  }
  EXPECT_EQ(ladder.number(2, rmse), 0);
  for (const char* name : {"draft", "good", "final"})
    EXPECT_EQ(read_image(path("out/") + name + ".exr").width(), 48);
}

TEST_F(PlanScripts, CostsOfWhatTheSceneRequires) {
  const auto costs = [&](const std::string& scene) {
    const auto run = run_script(
        "what-it-costs.sh",
        {data(scene), scene, "--photons", "10000", "--rays", "64", "--width", "32", "--samples", "1"},
        folder_);
    EXPECT_EQ(run.code, 0) << run.err;
    return table(scene + "/costs.csv");
  };
  const auto change = [](const CsvTable& t, const std::string& part) {
    for (std::size_t i = 0; i < t.rows.size(); ++i)
      if (t.rows[i][0] == part) return t.number(i, t.column("change", ""));
    return -1.0;
  };
  const CsvTable diffuse = costs("cornell-empty.glb"), glossy = costs("cornell-glossy22.glb");
  EXPECT_GT(change(diffuse, "direct-light"), 0.3);
  EXPECT_GT(change(diffuse, "bounces"), 0.02);
  EXPECT_GT(change(diffuse, "noise"), 0);
  EXPECT_EQ(change(diffuse, "gloss"), -1) << "nothing is glossy";
  EXPECT_EQ(change(diffuse, "mirrors"), -1);
  EXPECT_GT(change(glossy, "gloss"), 0);
}

TEST_F(PlanScripts, SayHowTheyAreUsed) {
  for (const char* script : {"light-study.sh", "quality-ladder.sh", "what-it-costs.sh", "isolux.sh"}) {
    EXPECT_EQ(run_script(script, {}, folder_).code, 2) << script;
    EXPECT_EQ(run_script(script, {"no.glb", "out", "--nonsense", "1"}, folder_).code,
              script[0] == 'i' ? 3 : 2)
        << script;
    const auto none = run_script(script, {"no.glb", script[0] == 'i' ? "1" : "out", "x.svg"}, folder_);
    EXPECT_EQ(none.code, script[0] == 'i' ? 3 : 2);
    if (script[0] == 'i') continue;
    const auto missing = run_script(script, {"no.glb", "out"}, folder_);
    EXPECT_EQ(missing.code, 3);
    EXPECT_NE(missing.err.find("no.glb: no such file"), std::string::npos) << missing.err;
  }
}

}  // namespace
}  // namespace phos::test
