// phos-photons at the command line: what it says, what it refuses, and what it leaves behind.
#include <gtest/gtest.h>

#include "core/json.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "support/run.h"

namespace phos {
namespace {

using Result = test::Run;
using test::run_tool;

/// One upward-facing triangle, and the lights given (KHR_lights_punctual, JSON).
std::string triangle_gltf(const std::string& lights) {
  const std::string extensions =
      lights.empty()
          ? ""
          : R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)" +
                lights + "]}}";
  const std::string node =
      lights.empty() ? ""
                     : R"(,{"translation":[0.2,1,-0.2],"extensions":{"KHR_lights_punctual":{"light":0}}})";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0)" +
         std::string(lights.empty() ? "" : ",1") + R"(]}],"nodes":[{"mesh":0})" + node +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,-1],"max":[1,0,0]}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
         R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/"}])" +
         extensions + "}";
}

class PhotonsCli : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::scratch("photons_cli"), out_ = folder_ + "/out.photons"; }

  void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& says) {
    std::vector<std::string> all{"photons"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result run = run_tool(all);
    EXPECT_EQ(run.code, code) << run.err;
    const std::string error = test::without_warnings(run.err);
    EXPECT_TRUE(test::is_one_line(error)) << run.err;
    EXPECT_EQ(error.rfind("phos-photons: ", 0), 0u) << run.err;
    EXPECT_NE(error.find(says), std::string::npos) << run.err;
    EXPECT_TRUE(run.out.empty()) << run.out;
    EXPECT_FALSE(std::filesystem::exists(out_));
  }

  std::string file(const std::string& name, const std::string& bytes) {
    test::spill(folder_ + "/" + name, bytes);
    return folder_ + "/" + name;
  }

  std::string folder_, out_;
  const std::string cornell_ = test::data("cornell-measured.glb");
};

TEST_F(PhotonsCli, HelpAndVersionGoToStdout) {
  for (const char* option : {"--help", "--version", "--man"}) {
    const Result run = run_tool({"photons", option});
    EXPECT_EQ(run.code, 0);
    EXPECT_FALSE(run.out.empty());
    EXPECT_TRUE(run.err.empty());
  }
  EXPECT_NE(run_tool({"photons", "--help"}).out.find("paths emitted from the lights"), std::string::npos);
}

TEST_F(PhotonsCli, UsageErrors) {
  expect_refused({}, 2, "SCENE");
  expect_refused({cornell_}, 2, "output");
  expect_refused({cornell_, "-o", out_, "--photons", "-1"}, 2, "photons");
  expect_refused({cornell_, "-o", out_, "--photons", "many"}, 2, "photons");
  expect_refused({cornell_, "-o", out_, "--minimum-share", "1.5"}, 2, "minimum-share");
  expect_refused({cornell_, "-o", out_, "--shard", "3/2"}, 2, "3/2");
  expect_refused({cornell_, "-o", out_, "--isa", "abacus"}, 2, "abacus");
  expect_refused({cornell_, "-o", out_, "--no-such-option"}, 2, "no-such-option");
}

TEST_F(PhotonsCli, BadScenes) {
  expect_refused({folder_ + "/absent.glb", "-o", out_}, 3, "absent.glb");
  expect_refused({file("text.glb", "this is no scene\n"), "-o", out_}, 3, "text.glb");
  expect_refused({file("cut.glb", test::slurp(cornell_).substr(0, 5000)), "-o", out_}, 3, "cut.glb");
  expect_refused({file("dark.gltf", triangle_gltf("")), "-o", out_}, 3, "no light");
}

TEST_F(PhotonsCli, UnwritableOutputIsSaidBeforeTheWork) {
  const Result run = run_tool(
      {"photons", cornell_, "--photons", "1000000000", "-o", folder_ + "/no/such/folder/out.photons"});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
}

TEST_F(PhotonsCli, SaysHowManyWereEmittedAndStored) {
  const Result run =
      run_tool({"photons", cornell_, "--photons", "2000", "-o", out_, "--stats", folder_ + "/stats.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("2000 paths emitted, "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(" photons stored"), std::string::npos) << run.err;
  EXPECT_TRUE(run.out.empty());
  const Json stats = parse_json(test::slurp(folder_ + "/stats.json"), "stats");
  ASSERT_NE(stats.find("stored"), nullptr);
  EXPECT_EQ(static_cast<std::size_t>(stats.find("stored")->as_integer()),
            Container::open(out_, FileKind::photons).vectors("position").size());
  EXPECT_TRUE(run_tool({"photons", cornell_, "--photons", "2000", "-o", out_, "--quiet"}).err.empty());
}

TEST_F(PhotonsCli, EmptyMapsAreWarnedOf) {
  Result run = run_tool({"photons", cornell_, "--photons", "0", "-o", out_});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("warning"), std::string::npos) << run.err;
  EXPECT_EQ(Container::open(out_, FileKind::photons).vectors("position").size(), 0u);
  // A spot that points away from the only triangle (glTF spots look along -z; this one has no rotation).
  const std::string away =
      file("away.gltf", triangle_gltf(R"({"type":"spot","intensity":10,"spot":{"outerConeAngle":0.3}})"));
  run = run_tool({"photons", away, "--photons", "500", "-o", out_, "--quiet"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("every photon left the scene"), std::string::npos) << run.err;
  EXPECT_EQ(Container::open(out_, FileKind::photons).vectors("position").size(), 0u);
}

TEST_F(PhotonsCli, SameBytesOnAnyNumberOfThreads) {
  const std::vector<std::string> command{"photons", cornell_, "--photons", "30000", "-o", out_};
  std::string first;
  for (const char* threads : {"1", "2", "5"}) {
    std::vector<std::string> all = command;
    all.insert(all.end(), {"--threads", threads});
    ASSERT_EQ(run_tool(all).code, 0);
    if (first.empty()) first = test::slurp(out_);
    EXPECT_EQ(test::slurp(out_), first) << threads << " threads";
  }
}

TEST_F(PhotonsCli, ReuseDoesNothingTwice) {
  const std::vector<std::string> command{"photons", cornell_, "--photons", "1000", "-o", out_, "--reuse"};
  ASSERT_EQ(run_tool(command).code, 0);
  const auto written = std::filesystem::last_write_time(out_);
  Result run = run_tool(command);
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find("up to date"), std::string::npos) << run.err;
  EXPECT_EQ(std::filesystem::last_write_time(out_), written);
  run = run_tool({"photons", cornell_, "--photons", "1001", "-o", out_, "--why"});
  EXPECT_NE(run.out.find("photons"), std::string::npos) << run.out;
  EXPECT_EQ(std::filesystem::last_write_time(out_), written);
  // A shard is not the whole, though every parameter is the same.
  run = run_tool({"photons", cornell_, "--photons", "1000", "-o", out_, "--reuse", "--shard", "1/2"});
  EXPECT_EQ(run.err.find("up to date"), std::string::npos) << run.err;
}

TEST_F(PhotonsCli, InterruptLeavesWhatWasThere) {
  ASSERT_EQ(run_tool({"photons", cornell_, "--photons", "1000", "-o", out_}).code, 0);
  const std::string before = test::slurp(out_);
  const Result run = test::run_and_interrupt({"photons", cornell_, "--photons", "50000000", "-o", out_},
                                             std::chrono::milliseconds(700));
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
  EXPECT_EQ(test::slurp(out_), before);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 1u) << "a temporary file was left";
}

TEST_F(PhotonsCli, TooManyPathsForTheMemoryAreSaidAtOnce) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends a program that asks for too much memory";
#endif
  expect_refused({cornell_, "-o", out_, "--photons", "900000000000"}, 6, "no memory for the about");
}

TEST_F(PhotonsCli, IsaIsRecorded) {
  ASSERT_EQ(run_tool({"photons", cornell_, "--photons", "100", "--isa", "sse2", "-o", out_}).code, 0);
  const Container file = Container::open(out_);
  const Json* isa = file.provenance().parameters.find("isa");
  ASSERT_NE(isa, nullptr);
  EXPECT_EQ(isa->as_string(), "sse2");
}

}  // namespace
}  // namespace phos
