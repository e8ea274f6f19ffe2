// Points of --at in free air, where no photon lands.
#include <gtest/gtest.h>

#include "file/container.h"
#include "support/cornell_photons.h"

namespace phos::test {
namespace {

const std::string& folder() {
  static const std::string path = folder_with_photons("irradiance-points", "20000");
  return path;
}

Run records(const std::string& points, const std::vector<std::string>& more = {}) {
  spill(folder() + "/points.csv", "x,y,z,nx,ny,nz\n" + points);
  std::vector<std::string> words = {"irradiance",
                                    data("cornell-measured.glb"),
                                    folder() + "/c.photons",
                                    "--at",
                                    folder() + "/points.csv",
                                    "--place",
                                    "every",
                                    "-o",
                                    folder() + "/o.irradiance"};
  words.insert(words.end(), more.begin(), more.end());
  return run_tool(words);
}
std::size_t made() { return Container::open(folder() + "/o.irradiance").vectors("position").size(); }

constexpr const char* kFloor = "0.1,0,0.1,0,1,0\n";
constexpr const char* kAir = "0.1,0.3,0.1,0,1,0\n0.45,0.2,0.1,0,1,0\n";

TEST(PointsInAir, AreRefusedWherePhotonsAloneCount) {
  for (const char* estimate : {"hull", "kernel"}) {
    std::filesystem::remove(folder() + "/o.irradiance");
    const auto run = records(kAir, {"--estimate", estimate});
    EXPECT_EQ(run.code, 3) << run.err;
    EXPECT_NE(run.err.find("none of its 2 points"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("--estimate gather"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder() + "/o.irradiance"));
  }
}

TEST(PointsInAir, AreLeftOutBesideOthersWithAWarning) {
  const auto run = records(std::string(kFloor) + kAir);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("2 of 3 points are left out"), std::string::npos) << run.err;
  EXPECT_EQ(made(), 1u);
  const auto fine = records(kFloor);
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_EQ(fine.err.find("warning"), std::string::npos) << fine.err;
}

TEST(PointsInAir, AreServedByRays) {
  const auto run = records(kAir, {"--estimate", "gather", "--rays", "64"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(made(), 2u);
}

TEST(PointsInAir, GetNoRadianceRecordsEither) {
  const std::string box = data("cornell-glossy22.glb"), at = folder() + "/air.csv";
  spill(at, std::string("x,y,z,nx,ny,nz\n") + kAir);
  const std::string photons = folder() + "/g.photons";
  ASSERT_EQ(run_tool({"photons", box, "--photons", "5000", "-o", photons}).code, 0);
  const auto run = run_tool({"radiance", box, photons, "--at", at, "-o", folder() + "/o.radiance"});
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_NE(run.err.find("none of its 2 points"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace phos::test
