// phos-study as a user meets it: help, refusals, references that were made before.
#include <gtest/gtest.h>

#include "support/refused.h"
#include "support/study.h"

namespace {

using namespace phos::test;

namespace fs = std::filesystem;

TEST(StudyTool, HelpAndVersion) {
  const auto help = run_tool({"study", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--pictures", "--list", "[photons]", "[reference]", "steps", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  for (const char* option : {"--version", "--man", "--options-json"})
    EXPECT_EQ(run_tool({"study", option}).code, 0);
}

TEST(StudyTool, RefusesBadCommandLines) {
  const std::string folder = toy_study("refused"), file = folder + "/toy.toml", out = folder + "/out";
  EXPECT_EQ(run_tool({"study"}).code, 2);
  expect_refused("study", {file}, 2, "output");
  expect_refused("study", {folder + "/none.toml", "-o", out}, 3, "none.toml");
  expect_refused("study", {file, "-o", out, "--seed", "3"}, 2, "--seed");
  expect_refused("study", {folder + "/box.glb", "-o", out}, 3, "box.glb");
  spill(folder + "/taken", "");
  expect_refused("study", {file, "-o", folder + "/taken"}, 3, "taken");
}

TEST(StudyTool, RefusesBadStudiesBeforeAnyWork) {
  const std::string folder = toy_study("bad"), out = folder + "/out";
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
  const std::string folder = toy_study("dark");
  const std::string dark =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"camera":0}],)"
      R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,-1],"max":[1,0,0]}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
      R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/"}]})";
  spill(folder + "/dark.gltf", dark);
  spill(folder + "/dark.toml", "[study]\nscenes = \"dark.gltf\"\n" + kToyStages);
  expect_refused("study", {folder + "/dark.toml", "-o", folder + "/out"}, 3, "no light");
}

TEST(StudyTool, RefusesAReferenceThatDoesNotBelong) {
  const std::string folder = toy_study("reference");
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
    EXPECT_FALSE(fs::exists(folder + "/out"));
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

}  // namespace
