// phos-picture on the frames of an animation: one exposure, pictures or a video.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "image/image.h"
#include "support/refused.h"

namespace phos {
namespace {

using test::expect_refused;
using test::run_tool;

bool has_ffmpeg() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }

/// Sets a variable for the programs run meanwhile.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name), before_(std::getenv(name)) {
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { setenv(name_, before_.c_str(), 1); }

 private:
  const char* name_;
  std::string before_;
};

/// Frame 0 is black, 1 to 3 are a ramp that doubles from frame to frame. Odd in width and height.
class PictureSequences : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch("picture-sequences");
    std::filesystem::create_directory(path("film"));
    std::filesystem::create_directory(path("out"));
    for (int t = 0; t < 4; ++t) write("film", t, 33);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, int frame, int width) const {
    Image image(width, 25);
    std::vector<Rgb> ramp(image.pixels());
    for (std::size_t i = 0; i < ramp.size(); ++i)
      ramp[i] = frame == 0
                    ? Rgb(0)
                    : std::exp2(static_cast<float>(frame) + static_cast<float>(i % 33) / 8) * Rgb(1, 2, 3);
    image.set_rgb("", ramp);
    image.attributes[kFramesPerSecond] = "12.5";
    write_exr(path(name + "/000" + std::to_string(frame) + ".exr"), image);
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::size_t files(const std::string& folder) const {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path(folder))) ++n;
    return n;
  }
  std::string folder_;
};

TEST_F(PictureSequences, OneExposureForAll) {
  const auto run =
      run_tool({"picture", path("film/%04d.exr"), "--frames", "0:3", "-o", path("out/%02d.png")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("exposed as frame 1: --key "), std::string::npos) << run.err;
  EXPECT_EQ(files("out"), 4u);
  // The first frame that is not black is as it is alone; the others are brighter, not exposed anew.
  EXPECT_EQ(run_tool({"picture", path("film/0001.exr"), "-o", path("one.png")}).code, 0);
  EXPECT_EQ(test::slurp(path("one.png")), test::slurp(path("out/01.png")));
  const Picture one = read_png(path("out/01.png")), two = read_png(path("out/02.png")),
                black = read_png(path("out/00.png"));
  EXPECT_GT(two.rgb[1], one.rgb[1] + 10);
  EXPECT_EQ(black.rgb, std::vector<std::uint8_t>(black.rgb.size(), 0));
  // What it said, given to another run, shows a frame alike.
  const std::string options = run.err.substr(run.err.find("--key"));
  std::istringstream words(options);
  std::string key, k, white, w;
  words >> key >> k >> white >> w;
  EXPECT_EQ(run_tool({"picture", path("film/0002.exr"), key, k, white, w, "-o", path("two.png")}).code, 0);
  EXPECT_EQ(test::slurp(path("two.png")), test::slurp(path("out/02.png")));
}

TEST_F(PictureSequences, OneScaleOfFalseColours) {
  const auto run =
      run_tool({"picture", path("film"), "--frames", "1:3", "--false-colour", "-o", path("out/%d.png")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("colours of frame 1: --min "), std::string::npos) << run.err;
  const Picture one = read_png(path("out/1.png")), three = read_png(path("out/3.png"));
  EXPECT_GT(three.rgb[1], one.rgb[1]) << "viridis: more is greener";
}

TEST_F(PictureSequences, HdrFramesKeepTheirLight) {
  EXPECT_EQ(run_tool({"picture", path("film"), "--frames", "1:2", "-o", path("out/%d.hdr")}).code, 0);
  EXPECT_NEAR(luminance(read_image(path("out/2.hdr")).rgb("")[0]),
              2 * luminance(read_image(path("out/1.hdr")).rgb("")[0]), 0.05);
}

TEST_F(PictureSequences, Videos) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed: no videos";
  for (const char* name : {"f.mp4", "f.mkv", "f.webm"}) {
    const auto run = run_tool({"picture", path("film"), "--frames", "0:3", "-o", path(name)});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string info = path("info.txt");
    ASSERT_EQ(std::system(("ffmpeg -i " + path(name) + " >" + info + " 2>&1").c_str()) >> 8, 1);
    const std::string said = test::slurp(info);
    EXPECT_NE(said.find(" 32x24"), std::string::npos) << said;  // even
    EXPECT_NE(said.find("12.50 fps"), std::string::npos) << said;
    EXPECT_NE(said.find("bt709"), std::string::npos) << said;
  }
  const std::string once = test::slurp(path("f.mp4"));
  EXPECT_EQ(
      run_tool({"picture", path("film"), "--frames", "0:3", "--threads", "1", "-o", path("f.mp4")}).code, 0);
  EXPECT_EQ(test::slurp(path("f.mp4")), once);
  // The colours of a frame are those of its picture.
  ASSERT_EQ(
      std::system(("ffmpeg -loglevel error -ss 0.16 -i " + path("f.mp4") + " -frames:v 1 " + path("back.png"))
                      .c_str()),
      0);
  EXPECT_EQ(run_tool({"picture", path("film"), "--frames", "0:3", "-o", path("out/%d.png")}).code, 0);
  const Picture back = read_png(path("back.png")), sent = read_png(path("out/2.png"));
  ASSERT_EQ(back.width, 32);
  double worst = 0;
  for (int x = 0; x < 32; ++x)
    for (int c = 0; c < 3; ++c) {
      const std::size_t of_back = static_cast<std::size_t>(3 * (12 * 32 + x) + c),
                        of_sent = static_cast<std::size_t>(3 * (12 * 33 + x) + c);
      worst = std::max(
          worst, std::fabs(static_cast<double>(back.rgb[of_back]) - static_cast<double>(sent.rgb[of_sent])));
    }
  EXPECT_LT(worst, 16) << "of 255: rounding, and 4:2:0";
}

TEST_F(PictureSequences, AVideoAppearsWholeOrNotAtAll) {
  test::spill(path("old.mp4"), "what was there before");
  const auto untouched = [&] {
    EXPECT_EQ(test::slurp(path("old.mp4")), "what was there before");
    EXPECT_EQ(files("."), 3u);  // old.mp4, film, out
  };
  // Frame 4 is not there: found while ffmpeg runs.
  if (has_ffmpeg()) {
    expect_refused("picture",
                   {path("film"), "--frames", "0:4", "-o", path("old.mp4"), "--key", "1", "--white", "9"}, 3,
                   "0004.exr");
    untouched();
  }
  {
    const Environment nothing("PATH", path("out"));
    expect_refused("picture",
                   {path("film"), "--frames", "0:3", "-o", path("old.mp4"), "--key", "1", "--white", "9"}, 3,
                   "Debian package ffmpeg");
    untouched();
    // An ffmpeg that fails: at once (the frames are more than a pipe holds), and when it has read everything.
    for (const char* script : {"#!/bin/sh\necho no such codec >&2\nexit 1\n",
                               "#!/bin/sh\n/bin/cat >/dev/null\necho no such codec >&2\nexit 1\n"}) {
      test::spill(path("out/ffmpeg"), script);
      std::filesystem::permissions(path("out/ffmpeg"), std::filesystem::perms::owner_all);
      expect_refused("picture",
                     {path("film"), "--frames", "0:3", "-o", path("old.mp4"), "--false-colour", "--min", "1",
                      "--max", "9"},
                     3, "no such codec");
      untouched();
    }
  }
}

TEST_F(PictureSequences, Refuses) {
  const std::string film = path("film");
  expect_refused("picture", {film + "/0001.exr", "-o", path("f.mp4")}, 2, "--frames 0:47");
  expect_refused("picture", {film + "/0001.exr", "-o", path("f%d.png")}, 2, "names a sequence");
  expect_refused("picture", {film, "--frames", "0:3", "-o", path("f.png")}, 2, "f-%04d.png");
  expect_refused("picture", {film, "--frames", "3:0", "-o", path("f%d.png")}, 2, "--frames");
  expect_refused("picture", {film + "/0001.exr", "--frames", "0:3", "-o", path("f%d.png")}, 2, "INPUT");
  expect_refused("picture", {film, "--frames", "0:3", "--fps", "9", "-o", path("f%d.png")}, 2, "--fps");
  expect_refused("picture", {film, "--frames", "0:3", "--x", "a", "-o", path("f%d.png")}, 2, "--frames");
  expect_refused("picture", {film, "--frames", "0:3", "-o", path("no/f%d.png")}, 3, "make the folder first");
}

}  // namespace
}  // namespace phos
