// phos-sense reads radiance records: their irradiance lights sensors as that of irradiance records does.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/refused.h"

namespace phos::test {
namespace {

std::string scene() { return data("cornell-glossy22.glb"); }

const std::string& folder() {
  static const std::string path = [] {
    const std::string f = scratch("sense-radiance");
    EXPECT_EQ(run_tool({"photons", scene(), "--photons", "60000", "-o", f + "/c.photons"}).code, 0);
    EXPECT_EQ(run_tool({"radiance", scene(), f + "/c.photons", "--rays", "1024", "--min-radius", "0.05", "-o",
                        f + "/c.radiance"})
                  .code,
              0);
    EXPECT_EQ(run_tool({"irradiance", scene(), f + "/c.photons", "-o", f + "/all.irradiance"}).code, 0);
    EXPECT_EQ(
        run_tool({"irradiance", scene(), f + "/c.photons", f + "/c.radiance", "-o", f + "/rest.irradiance"})
            .code,
        0);
    spill(f + "/p.csv",
          "x,y,z,nx,ny,nz\n0.2,0.2,0.559,0,0,-1\n0.3,0.3,0.559,0,0,-1\n0.4,0.25,0.559,0,0,-1\n"
          "0.25,0.0001,0.1,0,1,0\n");
    return f;
  }();
  return path;
}

struct Row {
  double lx, stderr_lx;
};
std::vector<Row> read(const std::vector<std::string>& caches, std::size_t expected_misses) {
  std::vector<std::string> arguments{"sense", scene()};
  for (const std::string& c : caches) arguments.push_back(folder() + c);
  const std::string summary = folder() + "/summary.json";
  arguments.insert(arguments.end(), {"--points", folder() + "/p.csv", "--summary", summary});
  const auto run = run_tool(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(slurp(summary).find("\"misses\": " + std::to_string(expected_misses)), std::string::npos)
      << slurp(summary);
  std::vector<Row> rows;
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<double> v;
    for (std::string cell; std::getline(cells, cell, ',');) v.push_back(std::strtod(cell.c_str(), nullptr));
    EXPECT_EQ(v.size(), 11u);
    rows.push_back({v.at(7), v.at(8)});
  }
  EXPECT_EQ(rows.size(), 4u);
  return rows;
}

TEST(SenseRadiance, JoinedWithIrradiance) {
  const auto all = read({"/all.irradiance"}, 0), joined = read({"/rest.irradiance", "/c.radiance"}, 0),
             turned = read({"/c.radiance", "/rest.irradiance"}, 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(joined[i].lx, all[i].lx,
                0.04 * all[i].lx + 3 * std::hypot(joined[i].stderr_lx, all[i].stderr_lx));
    EXPECT_NEAR(joined[i].lx, turned[i].lx, 1e-4 * joined[i].lx);
  }
  // Alone they light their own surface.
  const auto alone = read({"/c.radiance"}, 1);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(alone[i].lx, all[i].lx,
                0.04 * all[i].lx + 3 * std::hypot(alone[i].stderr_lx, all[i].stderr_lx));
}

TEST(SenseRadiance, OfAnotherSceneOrLightIsRefused) {
  const std::string f = folder();
  expect_refused("sense", {data("cornell-measured.glb"), f + "/c.radiance", "--points", f + "/p.csv"}, 4,
                 "c.radiance");
  ASSERT_EQ(run_tool({"irradiance", scene(), f + "/c.photons", "--paths", "all", "--max-candidates", "50",
                      "-o", f + "/whole.irradiance"})
                .code,
            0);
  expect_refused("sense", {scene(), f + "/whole.irradiance", f + "/c.radiance", "--points", f + "/p.csv"}, 4,
                 "c.radiance");
}

}  // namespace
}  // namespace phos::test
