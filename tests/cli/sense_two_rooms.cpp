// Rooms of an energy model: double-sided, their fronts outwards.
#include <gtest/gtest.h>

#include "support/run.h"

namespace phos::test {
namespace {

TEST(TwoRooms, NoSensorIsSaidToBeInsideOfASolid) {
  const std::string scenes = shared("lighting/scenes/hbjson");
  if (scenes.empty()) GTEST_SKIP() << "../shared/lighting is not here";
  for (const char* sky : {"overcast", "cie:1"}) {
    for (const char* points : {"/two-rooms-sensors-TestRoom_1.csv", "/two-rooms-sensors-TestRoom_2.csv"}) {
      const auto run = run_tool(
          {"sense", scenes + "/two-rooms.glb", "--sky", sky, "--direct-only", "--points", scenes + points});
      EXPECT_EQ(run.code, 0) << run.err;
      EXPECT_EQ(run.err.find("inside of solids"), std::string::npos) << run.err;
    }
  }
  const auto grid = run_tool({"sense", scenes + "/two-rooms.glb", "--sky", "overcast", "--direct-only",
                              "--grid", "1", "--height", "0.8"});
  EXPECT_EQ(grid.code, 0) << grid.err;
  EXPECT_EQ(grid.err.find("inside of solids"), std::string::npos) << grid.err;
}

}  // namespace
}  // namespace phos::test
