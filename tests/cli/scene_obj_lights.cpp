// Cameras and lights of OBJ scenes: what is not there is told with the name of the file that would hold it,
// and the help says how.
#include <gtest/gtest.h>

#include "support/run.h"

namespace phos {
namespace {

constexpr const char* kFloor = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n";

TEST(ObjLights, WhatIsMissingIsToldWithTheFileThatWouldHoldIt) {
  const std::string folder = test::scratch("obj_lights");
  test::spill(folder + "/room.obj", kFloor);
  const test::Run picture = test::run_tool({"reference", folder + "/room.obj", "-o", folder + "/x.exr"});
  EXPECT_EQ(picture.code, 3);
  EXPECT_NE(picture.err.find("no camera; add one in " + folder + "/room.lights.json"), std::string::npos)
      << picture.err;
  const test::Run photons = test::run_tool({"photons", folder + "/room.obj", "-o", folder + "/x.photons"});
  EXPECT_EQ(photons.code, 3);
  EXPECT_NE(photons.err.find("add one in " + folder + "/room.lights.json"), std::string::npos) << photons.err;
  const test::Run report = test::run_tool({"scene", folder + "/room.obj"});
  std::size_t told = 0;
  for (std::size_t at = 0; (at = report.out.find("/room.lights.json", at)) != std::string::npos; ++at) ++told;
  EXPECT_EQ(told, 2u) << report.out;
}

TEST(ObjLights, TheHelpHoldsAFileThatWorks) {
  const std::string help = test::run_tool({"scene", "--help"}).out;
  const std::size_t begin = help.find("{\"lights\""), end = help.find("}]}", begin);
  ASSERT_NE(end, std::string::npos) << help;
  const std::string folder = test::scratch("obj_lights_help");
  test::spill(folder + "/room.obj", kFloor);
  test::spill(folder + "/room.lights.json", help.substr(begin, end + 3 - begin));
  const test::Run report = test::run_tool({"scene", folder + "/room.obj", "--json"});
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_NE(report.out.find("\"lamp\""), std::string::npos);
  EXPECT_NE(report.out.find("\"view\""), std::string::npos);
}

}  // namespace
}  // namespace phos
