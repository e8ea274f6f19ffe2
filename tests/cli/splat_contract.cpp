// phos-splat as a user meets it: the contract of the command line, and wrong inputs.
#include <gtest/gtest.h>

#include <algorithm>

#include "image/image.h"
#include "support/run.h"

namespace phos::test {
namespace {

/// A small cache of the Cornell box, made once.
class Splat : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new std::string(scratch("cli-splat"));
    scene_ = new std::string(data("cornell-measured.glb"));
    const test::Run photons =
        run_tool({"photons", *scene_, "--photons", "20000", "-o", path("a.photons"), "--quiet"});
    ASSERT_EQ(photons.code, 0) << photons.err;
    const test::Run records =
        run_tool({"irradiance", *scene_, path("a.photons"), "-o", path("a.irradiance"), "--quiet"});
    ASSERT_EQ(records.code, 0) << records.err;
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(*folder_);
    delete folder_;
    delete scene_;
  }
  static std::string path(const std::string& name) { return *folder_ + "/" + name; }
  static test::Run splat(std::vector<std::string> more) {
    std::vector<std::string> all = {
        "splat",           *scene_, path("a.irradiance"), "--width", "48",      "--height", "48",
        "--pixel-samples", "1",     "--light-samples",    "2",       "--splat", "cpu"};
    all.insert(all.end(), more.begin(), more.end());
    return run_tool(all);
  }
  static void expect_error(const test::Run& run, int code, const std::string& says) {
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_TRUE(run.out.empty()) << run.out;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_EQ(run.err.rfind("phos-splat: ", 0), 0u) << run.err;
  }
  static std::string* folder_;
  static std::string* scene_;
};
std::string* Splat::folder_ = nullptr;
std::string* Splat::scene_ = nullptr;

TEST_F(Splat, HelpVersionManualAndNoArguments) {
  for (const char* option : {"--help", "--version", "--man"}) {
    const test::Run run = run_tool({"splat", option});
    EXPECT_EQ(run.code, 0);
    EXPECT_TRUE(run.err.empty());
    EXPECT_NE(run.out.find("phos"), std::string::npos);
  }
  const test::Run help = run_tool({"splat", "--help"});
  for (const char* option :
       {"--accuracy", "--camera", "--misses", "--light-samples", "--threads", "--seed", "--output"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  expect_error(run_tool({"splat"}), 2, "usage: phos-splat");
}

TEST_F(Splat, MakesEveryLayer) {
  const test::Run run = splat({"-o", path("b.exr")});
  ASSERT_EQ(run.code, 0) << run.err;
  const Image image = read_image(path("b.exr"));
  for (const char* layer : {"", "direct", "indirect", "emission", "stderr", "albedo"})
    EXPECT_TRUE(image.has_layer(layer)) << layer;
  for (const char* channel : {"illuminance.Y", "weight.Y", "normal.X", "position.Z", "Z"})
    EXPECT_TRUE(image.has(channel)) << channel;
  EXPECT_TRUE(image.attributes.contains("phos.key"));
  EXPECT_TRUE(image.attributes.contains("phos.history"));
  double light = 0;
  for (const float v : image.channel("indirect.G")) light += v;
  EXPECT_GT(light, 0);
}

TEST_F(Splat, SameBytesOnAnyNumberOfThreads) {
  ASSERT_EQ(splat({"--threads", "1", "-o", path("one.exr")}).code, 0);
  ASSERT_EQ(splat({"--threads", "3", "-o", path("three.exr")}).code, 0);
  EXPECT_EQ(slurp(path("one.exr")), slurp(path("three.exr")));
}

TEST_F(Splat, SceneAndCachesStandInAnyOrder) {
  ASSERT_EQ(splat({"-o", path("usual.exr")}).code, 0);
  const test::Run run =
      run_tool({"splat", path("a.irradiance"), *scene_, "--width", "48", "--height", "48", "--pixel-samples",
                "1", "--light-samples", "2", "--splat", "cpu", "-o", path("turned.exr")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(slurp(path("turned.exr")), slurp(path("usual.exr")));
}

TEST_F(Splat, AnotherCameraNeedsNoNewCache) {
  const test::Run run = splat({"--camera", "left-view", "-o", path("left.exr")});
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(Splat, ReuseDoesNothingTwice) {
  ASSERT_EQ(splat({"-o", path("reuse.exr")}).code, 0);
  const auto before = std::filesystem::last_write_time(path("reuse.exr"));
  const test::Run again = splat({"--reuse", "-o", path("reuse.exr")});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(path("reuse.exr")), before);
  const test::Run why = splat({"--why", "--accuracy", "0.3", "-o", path("reuse.exr")});
  EXPECT_EQ(why.code, 0) << why.err;
  EXPECT_NE(why.out.find("accuracy"), std::string::npos) << why.out;
}

TEST_F(Splat, EveryWayOfDirectLight) {
  const auto mean = [](const Image& image, const std::string& channel) {
    double sum = 0;
    for (const float v : image.channel(channel)) sum += static_cast<double>(v);
    return sum / static_cast<double>(image.pixels());
  };
  double direct[3];
  const char* const ways[] = {"traced", "shadow-map", "none"};
  for (int i = 0; i < 3; ++i) {
    const test::Run run = splat({"--direct", ways[i], "--light-samples", "16", "-o", path("way.exr")});
    ASSERT_EQ(run.code, 0) << run.err;
    direct[i] = mean(read_image(path("way.exr")), "direct.G");
  }
  EXPECT_GT(direct[0], 0);
  EXPECT_NEAR(direct[1] / direct[0], 1, 0.1);
  EXPECT_EQ(direct[2], 0);
}

/// A cache of all light already holds what the lamps send: the sum stays what it was.
TEST_F(Splat, CachesOfAllLightAreNotLitTwice) {
  const test::Run records = run_tool(
      {"irradiance", *scene_, path("a.photons"), "--paths", "all", "-o", path("all.irradiance"), "--quiet"});
  ASSERT_EQ(records.code, 0) << records.err;
  ASSERT_EQ(splat({"--light-samples", "16", "-o", path("indirect.exr")}).code, 0);
  const test::Run run = run_tool(
      {"splat", *scene_, path("all.irradiance"), "--width", "48", "--splat", "cpu", "-o", path("all.exr")});
  ASSERT_EQ(run.code, 0) << run.err;
  double sum[2] = {0, 0};
  int both = 0;
  const Image one = read_image(path("indirect.exr")), other = read_image(path("all.exr"));
  for (std::size_t i = 0; i < one.pixels(); ++i) {
    if (!(one.channel("weight.Y")[i] > 0) || !(other.channel("weight.Y")[i] > 0)) continue;
    sum[0] += static_cast<double>(one.channel("illuminance.Y")[i]);
    sum[1] += static_cast<double>(other.channel("illuminance.Y")[i]);
    ++both;
  }
  EXPECT_GT(both, 1000);
  EXPECT_NEAR(sum[1] / sum[0], 1, 0.1);
  expect_error(
      run_tool({"splat", *scene_, path("a.irradiance"), path("all.irradiance"), "-o", path("x.exr")}), 4,
      "--paths");
}

TEST_F(Splat, MismatchCanBeAllowed) {
  const std::string empty = data("cornell-empty.glb");
  const test::Run run = run_tool({"splat", empty, path("a.irradiance"), "--allow-mismatch", "--width", "16",
                                  "--splat", "cpu", "-o", path("mismatch.exr")});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(read_image(path("mismatch.exr")).attributes.at("phos.parameters").find("\"allow-mismatch\":true"),
            std::string::npos);
}

TEST_F(Splat, WrongInputsAreOneLineAndTheRightCode) {
  const std::string out = path("never.exr");
  expect_error(run_tool({"splat", path("no.glb"), path("a.irradiance"), "-o", out}), 3, "no.glb");
  expect_error(run_tool({"splat", *scene_, path("no.irradiance"), "-o", out}), 3, "no.irradiance");
  expect_error(run_tool({"splat", *scene_, path("a.photons"), "-o", out}), 3, "photons");
  expect_error(run_tool({"splat", data("cornell-empty.glb"), path("a.irradiance"), "-o", out}), 4,
               "another scene");
  expect_error(splat({"--camera", "nowhere", "-o", out}), 2, "left-view");
  expect_error(splat({"-o", path("no/such/folder.exr")}), 3, "folder.exr");
  expect_error(splat({"--accuracy", "0", "-o", out}), 2, "--accuracy");
  expect_error(splat({}), 2, "--output");
  expect_error(splat({"--reuse", "--misses", path("m.csv"), "-o", out}), 2, "--misses");
  expect_error(splat({"--width", "60000", "--height", "60000", "-o", out}), 2, "too many");
  expect_error(splat({"--isa", "z80", "-o", out}), 2, "isa");
  spill(path("text.glb"), "This is no scene.\n");
  expect_error(run_tool({"splat", path("text.glb"), path("a.irradiance"), "-o", out}), 3, "text.glb");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Splat, FullDiskLeavesNothing) { expect_error(splat({"-o", "/dev/full"}), 3, "/dev/full"); }

TEST_F(Splat, TruncatedCacheIsRefusedAtEveryLength) {
  const std::string whole = slurp(path("a.irradiance"));
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 3) {
    spill(path("cut.irradiance"), whole.substr(0, length));
    expect_error(run_tool({"splat", *scene_, path("cut.irradiance"), "-o", path("cut.exr")}), 3,
                 "cut.irradiance");
  }
  EXPECT_FALSE(std::filesystem::exists(path("cut.exr")));
}

TEST_F(Splat, InterruptedLeavesWhatWasThere) {
  spill(path("kept.exr"), "earlier");
  const test::Run run = run_and_interrupt({"splat", *scene_, path("a.irradiance"), "--width", "2000",
                                           "--pixel-samples", "64", "--splat", "cpu", "-o", path("kept.exr")},
                                          std::chrono::milliseconds(500));
  EXPECT_EQ(run.code, 130) << run.err;
  EXPECT_EQ(slurp(path("kept.exr")), "earlier");
  for (const auto& entry : std::filesystem::directory_iterator(*folder_))
    EXPECT_EQ(entry.path().filename().string().find("kept.exr."), std::string::npos);
}

TEST_F(Splat, MissesLoopConverges) {
  std::filesystem::copy_file(path("a.irradiance"), path("loop.irradiance"));
  long missing = -1;
  for (int round = 0; round < 4 && missing != 0; ++round) {
    const test::Run run = run_tool({"splat", *scene_, path("loop.irradiance"), "--width", "64", "--height",
                                    "64", "--pixel-samples", "1", "--direct", "none", "--splat", "cpu",
                                    "--misses", path("m.csv"), "-o", path("loop.exr")});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string csv = slurp(path("m.csv"));
    missing = std::count(csv.begin(), csv.end(), '\n') - 1;
    if (missing == 0) break;
    const test::Run fill = run_tool({"irradiance", *scene_, path("a.photons"), "--at", path("m.csv"),
                                     "--add-to", path("loop.irradiance"), "-o", path("loop.irradiance")});
    ASSERT_EQ(fill.code, 0) << fill.err;
  }
  EXPECT_EQ(missing, 0);
}

}  // namespace
}  // namespace phos::test
