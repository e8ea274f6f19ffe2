// No output is an input and no two outputs are one file, whatever their names.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "file/same_file.h"
#include "file/tool.h"
#include "file/write_text.h"
#include "support/run.h"

namespace phos {
namespace {

struct Result {
  int code;
  std::string out, err;
  bool read = false;
};

/// Reads what it is given, and writes -o and --list.
Result run(const std::vector<std::string>& words, const std::vector<std::string>& textures = {},
           bool sequence = false) {
  Tool tool("phos-test", "tests", "Tests.", 1);
  std::string input, points, list, earlier;
  std::vector<std::string> lamps;
  std::optional<double> frame, time;
  Options& options = tool.options();
  options.input("SCENE", input, "a scene", false);
  options.number("frame", frame, "N", "a frame");
  options.number("time", time, "S", "a time");
  options.file("points", points, "points");
  options.file("list", list, "a list of them", FileUse::written);
  options.file("add-to", earlier, "kept", FileUse::grown);
  options.named_files("lamp", lamps, "a lamp");
  if (sequence) tool.takes_frames(frame);
  std::vector<const char*> argv = {"phos-test"};
  for (const std::string& w : words) argv.push_back(w.c_str());
  Result result;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  result.code = tool.run(static_cast<int>(argv.size()), argv.data(), [&] {
    if (!textures.empty()) tool.add_input("scene", textures);
    if (!earlier.empty()) tool.add_input("earlier", earlier);
    result.read = true;
    write_text(tool.output(), "result\n");
    if (!list.empty()) write_text(tool.frame_path(list, "--list"), "list\n");
  });
  result.err = testing::internal::GetCapturedStderr();
  result.out = testing::internal::GetCapturedStdout();
  return result;
}

class SameFile : public ::testing::Test {
 protected:
  std::string folder = test::scratch("same_file");
  std::string at(const std::string& name) const { return text(folder, "/", name); }
  void SetUp() override {
    for (const char* name : {"scene.glb", "points.csv", "lamp.ies"}) test::spill(at(name), name);
  }
  /// Refused before anything is read, in a line that names both.
  void expect_refused(const Result& result, const std::string& one, const std::string& other) const {
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_FALSE(result.read);
    EXPECT_NE(result.err.find(one), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(other), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const char* name : {"scene.glb", "points.csv", "lamp.ies"}) EXPECT_EQ(test::slurp(at(name)), name);
  }
};

TEST_F(SameFile, EveryOutputAgainstEveryInput) {
  const std::string scene = at("scene.glb"), points = at("points.csv"), lamp = at("lamp.ies");
  const std::vector<std::pair<std::string, std::string>> inputs = {
      {scene, "SCENE"}, {points, "--points"}, {lamp, "--lamp"}};
  for (const auto& [file, input] : inputs) {
    for (const std::string option : {"--output", "--stats", "--list"}) {
      std::vector<std::string> words = {scene, "--points", points, "--lamp", text("a=b=", lamp)};
      if (option != "--output") words.insert(words.end(), {"-o", at("out")});
      words.insert(words.end(), {option, file});
      expect_refused(run(words), option, input);
    }
  }
}

TEST_F(SameFile, ByLinksAndOtherSpellings) {
  std::filesystem::create_symlink(at("scene.glb"), at("soft"));
  std::filesystem::create_symlink("soft", at("softer"));
  std::filesystem::create_hard_link(at("scene.glb"), at("hard"));
  std::filesystem::create_directory(at("sub"));
  std::filesystem::create_directory_symlink(folder, at("there"));
  for (const char* name : {"soft", "softer", "hard", "./scene.glb", "sub/../scene.glb", "there/scene.glb",
                           "there/there/soft", "/scene.glb"}) {
    expect_refused(run({at("scene.glb"), "-o", at(name)}), "--output", "SCENE");
    expect_refused(run({at(name), "-o", at("scene.glb")}), "--output", "SCENE");
  }
  const std::filesystem::path relative = std::filesystem::relative(at("scene.glb"));
  expect_refused(run({at("scene.glb"), "-o", relative.string()}), "--output", "SCENE");
}

TEST_F(SameFile, FilesOfOptionsAreInputs) {
  test::spill(at("site.opts"), text("points ", at("points.csv"), "\n"));
  const Result result = run({at("scene.glb"), text("@", at("site.opts")), "-o", at("site.opts")});
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("@FILE"), std::string::npos) << result.err;
  expect_refused(run({at("scene.glb"), text("@", at("site.opts")), "-o", at("points.csv")}), "--output",
                 "--points");
}

TEST_F(SameFile, WhatASceneRefersToIsRead) {
  test::spill(at("wall.png"), "wall");
  const Result refused =
      run({at("scene.glb"), "-o", at("out"), "--list", at("./wall.png")}, {at("scene.glb"), at("wall.png")});
  EXPECT_EQ(refused.code, 2);
  EXPECT_FALSE(refused.read);
  EXPECT_NE(refused.err.find("--list"), std::string::npos) << refused.err;
}

TEST_F(SameFile, TwoOutputsOfOneFile) {
  expect_refused(run({at("scene.glb"), "-o", at("new"), "--stats", at("new")}), "--stats", "--output");
  expect_refused(run({at("scene.glb"), "-o", at("new"), "--list", text(folder, "//new")}), "--output",
                 "--list");
  expect_refused(run({at("scene.glb"), "-o", "-", "--stats", "/dev/stdout"}), "--stats", "--output");
  EXPECT_FALSE(std::filesystem::exists(at("new")));
}

TEST_F(SameFile, WhatGrowsMayBeTheOutputAndNoOtherFile) {
  test::spill(at("cache"), "earlier");
  EXPECT_EQ(run({at("scene.glb"), "--add-to", at("cache"), "-o", at("cache")}).code, 0);
  EXPECT_EQ(test::slurp(at("cache")), "result\n");
  expect_refused(run({at("scene.glb"), "--add-to", at("cache"), "-o", at("new"), "--stats", at("cache")}),
                 "--stats", "--add-to");
  expect_refused(run({at("cache"), "--add-to", at("cache"), "-o", at("cache")}), "--output", "SCENE");
}

TEST_F(SameFile, OutputsThatCannotHurt) {
  EXPECT_EQ(run({at("scene.glb"), "-o", "/dev/null", "--stats", "/dev/null", "--list", "/dev/null"}).code, 0);
  EXPECT_EQ(run({"/dev/null", "-o", "/dev/null"}).code, 0);
  const Result out = run({at("scene.glb"), "-o", "-"});
  EXPECT_EQ(out.code, 0) << out.err;
  EXPECT_EQ(out.out, "result\n");
  EXPECT_FALSE(std::filesystem::exists("-"));
  EXPECT_EQ(run({at("scene.glb"), "-o", at("out"), "--list", "-"}).out, "list\n");
}

TEST_F(SameFile, AFolderIsNoOutput) {
  std::filesystem::create_directory(at("sub"));
  std::filesystem::create_directory_symlink(at("sub"), at("link"));
  for (const char* name : {"sub", "link", "link/"}) {
    const Result result = run({at("scene.glb"), "-o", at(name)});
    EXPECT_EQ(result.code, 3) << name;
    EXPECT_NE(result.err.find("cannot write"), std::string::npos) << result.err;
  }
}

TEST_F(SameFile, FramesAreLookedAtOneByOne) {
  test::spill(at("f0003.csv"), "third");
  const Result list =
      run({at("f0003.csv"), "-o", at("o%04d"), "--list", at("f%04d.csv"), "--frames", "0:5"}, {}, true);
  expect_refused(list, "--list", "SCENE");
  EXPECT_EQ(run({at("f0003.csv"), "-o", at("f%04d.csv"), "--frames", "4:5"}, {}, true).code, 0);
  expect_refused(run({at("scene.glb"), "-o", at("%d"), "--stats", at("4"), "--frames", "0:5"}, {}, true),
                 "--stats", "--output");
  expect_refused(run({at("scene.glb"), "-o", at("%d"), "--list", at("%d"), "--frames", "7"}, {}, true),
                 "--output", "--list");
}

TEST_F(SameFile, FramesWithoutEndAreNoDelay) {
  const std::string pattern = at("f%d");
  EXPECT_EQ(run({"--points", at("nowhere"), "-o", pattern, "--frames", "9:1"}, {}, true).code, 2);
  test::spill(at("f2"), "2");
  expect_refused(run({at("f2"), "-o", pattern, "--frames", "0:999999999"}, {}, true), "--output", "SCENE");
}

TEST(FileKey, TellsFilesNotNames) {
  const std::string folder = test::scratch("file_key");
  EXPECT_EQ(file_key(folder + "/new"), file_key(folder + "/./new"));
  EXPECT_NE(file_key(folder + "/new"), file_key(folder + "/newer"));
  EXPECT_EQ(file_key(folder), "");
  EXPECT_EQ(file_key(folder + "/none/new"), "");
  EXPECT_EQ(file_key("/dev/null"), "");
  EXPECT_EQ(file_key("/dev/stderr"), "");
  EXPECT_NE(file_key("/dev/stdout"), "");
}

}  // namespace
}  // namespace phos
