// phos-scene at the command line.
#include <gtest/gtest.h>

#include "file/json_parse.h"
#include "support/run.h"

namespace phos {
namespace {

using test::data;
using test::run_tool;

TEST(PhosScene, TellsWhatIsInAScene) {
  const test::Run run = run_tool({"scene", data("cornell-measured.glb")});
  EXPECT_EQ(run.code, 0) << run.err;
  for (const char* word : {"32 triangles", "Lights", "lm", "Cameras", "irradiance records", "Findings (0)"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  }
}

TEST(PhosScene, JsonIsOneObject) {
  const test::Run run = run_tool({"scene", data("moving-light.glb"), "--json", "--frame", "100"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json d = parse_json(run.out, "output");
  EXPECT_EQ(d.find("triangles")->as_integer(), 24);
  EXPECT_EQ(d.find("frames")->as_integer(), 400);
  EXPECT_EQ(d.find("time_s")->as_number(), 4);
  EXPECT_EQ(d.find("animations")->as_array().size(), 1u);
  EXPECT_TRUE(d.find("requires")->is_array());
}

TEST(PhosScene, TellsWhatMoves) {
  const test::Run run = run_tool({"scene", data("moving-light.glb")});
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* word : {"frames 0:399 at 25 per second", "moves node light translation"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
}

TEST(PhosScene, TellsWhatComputesGloss) {
  const std::string room = data("cornell-glossy22.glb");
  const test::Run run = run_tool({"scene", room});
  for (const char* word :
       {"Gloss (1)", "records of order ", "radiance records", "% of the other lobes' energy"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  const Json d = parse_json(run_tool({"scene", room, "--json"}).out, "output");
  const Json::Array gloss = d.find("gloss")->as_array();
  ASSERT_EQ(gloss.size(), 1u);
  EXPECT_GE(gloss[0].find("order")->as_integer(), 6);
  EXPECT_LT(gloss[0].find("traced_share")->as_number(), 0.5);
  const test::Run traced = run_tool({"scene", room, "--gloss", "traced"});
  EXPECT_EQ(traced.out.rfind("radiance records"), traced.out.find("irradiance records") + 2)
      << "no other radiance records\n"
      << traced.out;
  EXPECT_NE(traced.out.find("traced gloss"), std::string::npos);
  EXPECT_EQ(run_tool({"scene", data("cornell-empty.glb")}).out.find("Gloss"), std::string::npos);
}

TEST(PhosScene, StrictFailsWithoutLight) {
  const std::string path = test::scratch("scene_dark") + "/dark.obj";
  test::spill(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const test::Run lenient = run_tool({"scene", path}), strict = run_tool({"scene", path, "--strict"});
  EXPECT_EQ(lenient.code, 0);
  EXPECT_NE(lenient.out.find("[no-light]"), std::string::npos);
  EXPECT_EQ(strict.code, 1);
}

TEST(PhosScene, BadInputIsOneLineAndCode3) {
  const std::string folder = test::scratch("scene_bad");
  test::spill(folder + "/text.glb", "not a scene\n");
  const std::string whole = test::slurp(data("cornell-empty.glb"));
  test::spill(folder + "/cut.glb", whole.substr(0, whole.size() / 2));
  for (const std::string& path :
       {folder + "/text.glb", folder + "/cut.glb", folder + "/missing.glb", folder}) {
    const test::Run run = run_tool({"scene", path});
    EXPECT_EQ(run.code, 3) << path;
    EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("phos-scene: "), std::string::npos);
  }
}

TEST(PhosScene, UsageIsCode2) {
  EXPECT_EQ(run_tool({"scene"}).code, 2);
  EXPECT_EQ(run_tool({"scene", data("spheres.glb"), "--no-such"}).code, 2);
  EXPECT_EQ(run_tool({"scene", data("spheres.glb"), "--time", "1", "--frame", "2"}).code, 2);
  EXPECT_EQ(run_tool({"scene", "--help"}).code, 0);
  EXPECT_EQ(run_tool({"scene", "--version"}).code, 0);
}

}  // namespace
}  // namespace phos
