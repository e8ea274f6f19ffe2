// Every stage on a model 1e6 m from the world's origin: the same light as at home, bit by bit, and places of
// the world in all that is written for people and other programs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "support/far_model.h"
#include "support/run.h"

namespace phos::test {
namespace {

constexpr double kSite[3] = {1048576, -524288, 2097152};

std::vector<std::vector<std::string>> table_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// Columns `place` .. + 2 are off by the site, all others are the same text.
void expect_same_but_for_place(const std::string& home_csv, const std::string& far_csv, std::size_t place) {
  const auto home = table_of(home_csv), far = table_of(far_csv);
  ASSERT_EQ(home.size(), far.size());
  ASSERT_GT(home.size(), 2u);
  for (std::size_t i = 1; i < home.size(); ++i) {
    ASSERT_EQ(home[i].size(), far[i].size());
    for (std::size_t c = 0; c < home[i].size(); ++c) {
      if (c < place || c >= place + 3) {
        EXPECT_EQ(home[i][c], far[i][c]) << "row " << i << ", column " << c;
        continue;
      }
      const double off = std::atof(far[i][c].c_str()) - std::atof(home[i][c].c_str());
      EXPECT_NEAR(off, kSite[c - place], 1e-6) << far[i][c];
    }
  }
}

struct Stages {
  Stages(const std::string& name, const DVec3& site) : folder(scratch(name)) {
    spill(scene(), model_at(site));
    run({"photons", scene(), "--isa", "sse2", "--photons", "5000", "-o", file("photons")});
    run({"irradiance", scene(), file("photons"), "--isa", "sse2", "-o", file("irradiance")});
  }
  std::string scene() const { return folder + "/model.glb"; }
  std::string file(const std::string& kind) const { return folder + "/model." + kind; }
  static std::string run(const std::vector<std::string>& words) {
    const Run r = run_tool(words);
    EXPECT_EQ(r.code, 0) << words[0] << ": " << r.err;
    return r.out;
  }
  std::string folder;
};

TEST(FarAway, EveryStageGivesTheSameLight) {
  const Stages home("home", DVec3(0)), far("far", DVec3(kSite[0], kSite[1], kSite[2]));
  const auto both = [&](const std::function<std::string(const Stages&)>& of, std::size_t place) {
    expect_same_but_for_place(of(home), of(far), place);
  };
  for (const char* kind : {"photons", "irradiance"})
    both([&](const Stages& s) { return Stages::run({"info", s.file(kind), "--dump", "position"}); }, 0);
  both(
      [&](const Stages& s) {
        return Stages::run(
            {"sense", s.scene(), s.file("irradiance"), "--isa", "sse2", "--grid", "0.25", "--mesh", "floor"});
      },
      1);
  const std::string points = "x,y,z,nx,ny,nz\n";
  spill(home.file("csv"), points + "0.1,0.2,0.3,0,1,0\n-0.25,0,0,0,1,0\n");
  spill(far.file("csv"), points + "1048576.1,-524287.8,2097152.3,0,1,0\n1048575.75,-524288,2097152,0,1,0\n");
  // 0.1 and 1048576.1 - 1048576 are not the same float: shown to the digits that they share.
  const auto reference = [](const Stages& s) {
    return table_of(Stages::run({"reference", s.scene(), "--points", s.file("csv"), "--samples", "64"}));
  };
  const auto a = reference(home), b = reference(far);
  ASSERT_EQ(b.size(), 3u);
  EXPECT_EQ(b[1][0], "1048576.1");
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_NEAR(std::atof(b[i][6].c_str()) / std::atof(a[i][6].c_str()), 1, 1e-4);
  both(
      [](const Stages& s) {
        Stages::run({"splat", s.scene(), s.file("irradiance"), "--isa", "sse2", "--width", "32", "--splat",
                     "cpu", "--accuracy", "0.05", "--misses", s.file("misses"), "-o", s.file("exr")});
        return slurp(s.file("misses"));
      },
      0);
}

TEST(FarAway, ReportsSpeakOfTheWorld) {
  const Stages far("far", DVec3(kSite[0], kSite[1], kSite[2]));
  const std::string scene = Stages::run({"scene", far.scene()});
  EXPECT_NE(scene.find("1048576"), std::string::npos) << scene;
  EXPECT_NE(scene.find("positions in files are counted from"), std::string::npos) << scene;
  EXPECT_NE(Stages::run({"info", far.file("irradiance")}).find("1048576 -524288 2097152 m"),
            std::string::npos);
  EXPECT_NE(Stages::run({"info", far.file("irradiance"), "--points"}).find("property double x"),
            std::string::npos);
}

}  // namespace
}  // namespace phos::test
