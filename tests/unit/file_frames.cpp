// Ranges of frames, and names with a number in them.
#include "file/frames.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/run.h"

namespace phos {
namespace {

TEST(Frames, Ranges) {
  EXPECT_EQ(parse_frames("0:47").first, 0);
  EXPECT_EQ(parse_frames("0:47").last, 47);
  EXPECT_EQ(parse_frames("0:47").count(), 48);
  EXPECT_EQ(parse_frames("12").first, 12);
  EXPECT_EQ(parse_frames("12").count(), 1);
  EXPECT_TRUE(parse_frames("3:5").contains(5));
  EXPECT_FALSE(parse_frames("3:5").contains(6));
}

TEST(Frames, WhatIsNoRangeIsRefused) {
  for (const char* wrong : {"", ":", "1:", ":2", "a", "1:b", "1.5", "1:2:3", " 1", "1-2", "-1", "-2:3", "5:3",
                            "0:99999999999", "0:99999999999999999999"})
    try {
      parse_frames(wrong);
      ADD_FAILURE() << wrong;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      EXPECT_EQ(e.where(), "--frames");
    }
}

TEST(Frames, NamesAsPrintfMakesThem) {
  EXPECT_EQ(FramePattern("film/%04d.exr", "-o").path(12), "film/0012.exr");
  EXPECT_EQ(FramePattern("film/%04d.exr", "-o").path(123456), "film/123456.exr");
  EXPECT_EQ(FramePattern("%d", "-o").path(7), "7");
  EXPECT_EQ(FramePattern("%d/x.exr", "-o").path(7), "7/x.exr");
  EXPECT_EQ(FramePattern("100%%-%02d%%.exr", "-o").path(7), "100%-07%.exr");
  EXPECT_FALSE(FramePattern("a%%b", "-o").numbered());
  EXPECT_EQ(FramePattern("a%%b", "-o").path(3), "a%b");
}

TEST(Frames, OtherPatternsAreRefused) {
  for (const char* wrong :
       {"%", "a%", "%x", "%4d", "%0d", "%-4d", "%s", "%04", "%04i", "%99999999999d", "%d%d", "%d-%04d"})
    try {
      FramePattern(wrong, "--misses");
      ADD_FAILURE() << wrong;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      EXPECT_EQ(e.where(), "--misses");
    }
}

TEST(Frames, SeveralFramesNeedANumber) {
  EXPECT_EQ(sequence_pattern("a.exr", {4, 4}, "-o").path(4), "a.exr");
  for (const auto& [name, example] : {std::pair{"a.exr", "a-%04d.exr"}, std::pair{"x.y/a", "x.y/a-%04d"}})
    try {
      sequence_pattern(name, {4, 5}, "-o");
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      EXPECT_NE(std::string(e.what()).find(example), std::string::npos) << e.what();
    }
}

TEST(Frames, FoldersAreSequences) {
  const std::string folder = test::scratch("frames");
  const auto touch = [&](const std::string& name) { test::spill(folder + "/" + name, ""); };
  const auto code = [&] {
    try {
      existing_sequence(folder, {0, 2}, "IMAGE");
    } catch (const Error& e) {
      return e.code();
    }
    return ExitCode::done;
  };
  touch("notes.txt"), touch("best.exr"), touch("plan2.pdf");
  EXPECT_EQ(code(), ExitCode::bad_input);
  touch("50%-0008.exr"), touch("50%-0009.exr");
  EXPECT_EQ(existing_sequence(folder, {0, 2}, "IMAGE").path(9), folder + "/50%-0009.exr");
  touch("50%-10000.exr");  // beyond the digits, still of that sequence
  EXPECT_EQ(existing_sequence(folder, {0, 2}, "IMAGE").path(10000), folder + "/50%-10000.exr");
  touch("other1.exr");
  EXPECT_EQ(code(), ExitCode::bad_input);
  EXPECT_EQ(existing_sequence(folder + "/other%d.exr", {0, 2}, "IMAGE").path(1), folder + "/other1.exr");
}

}  // namespace
}  // namespace phos
