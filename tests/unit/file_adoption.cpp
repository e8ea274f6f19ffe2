// Options that a run takes from the file that it adds to: those declared so, and no others.
#include "file/adoption.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "support/container.h"
#include "support/run.h"

namespace phos {
namespace {

enum class Shape { round, square };
const Names<Shape> kShapes{{"round", Shape::round}, {"square", Shape::square}};

/// A program with an option of every kind.
struct Program {
  Options options{"phos-test", "", ""};
  double number = 1;
  std::optional<double> maybe;
  std::int64_t count = 2;
  bool flag = false;
  std::string word = "a";
  Shape shape = Shape::round, late = Shape::round;
  double passes = 4;

  explicit Program(std::vector<const char*> words = {}) {
    options.number("number", number, "X", "", {0, 10}, Adopted::estimate);
    options.number("maybe", maybe, "X", "", kPositive, Adopted::estimate);
    options.integer("count", count, "N", "", {}, Adopted::estimate);
    options.flag("flag", flag, "", Adopted::estimate);
    options.text("word", word, "W", "", {Recorded::if_given, Adopted::estimate});
    options.choice("shape", shape, kShapes, "", Adopted::estimate);
    options.choice("late", late, kShapes, "", {Recorded::unless_default, Adopted::estimate});
    options.choice("form", shape, kShapes, "", Recorded::no);
    options.another_name("form", "shape");
    options.number("passes", passes, "N", "");
    words.insert(words.begin(), "phos-test");
    options.parse(static_cast<int>(words.size()), words.data());
  }
};

class Adoption : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::scratch("adoption"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  Container file(const Json& parameters) const {
    Provenance provenance = test::sample_provenance();
    provenance.parameters = parameters;
    ContainerWriter().write(folder_ + "/cache", provenance);
    return Container::open(folder_ + "/cache");
  }
  static Json other_values() {
    return Json::Object{{"number", 3.5}, {"maybe", 0.1},      {"count", 7},       {"flag", true},
                        {"word", "b c"}, {"shape", "square"}, {"late", "square"}, {"passes", 9}};
  }
  void expect_refused(const Json& parameters, std::vector<const char*> words, ExitCode code,
                      const std::string& says) const {
    Program program(std::move(words));
    try {
      adopt_estimate(program.options, file(parameters));
      ADD_FAILURE() << "not refused: " << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), code) << e.what();
      EXPECT_EQ(e.where(), folder_ + "/cache");
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
  std::string folder_;
};

TEST_F(Adoption, FollowsFromTheDeclarationAlone) {
  Program program;
  adopt_estimate(program.options, file(other_values()));
  EXPECT_EQ(program.number, 3.5);
  EXPECT_EQ(program.maybe, 0.1);
  EXPECT_EQ(program.count, 7);
  EXPECT_TRUE(program.flag);
  EXPECT_EQ(program.word, "b c");
  EXPECT_EQ(program.shape, Shape::square);
  EXPECT_EQ(program.late, Shape::square);
  EXPECT_EQ(program.passes, 4) << "of the run";
  Json recorded = other_values();
  recorded["passes"] = 4.0;
  EXPECT_EQ(program.options.recorded().dump(), recorded.dump());
}

TEST_F(Adoption, WhatIsGivenMayOnlySayTheSame) {
  Program same({"--number", "3.5", "--form", "square", "--passes", "1"});
  EXPECT_NO_THROW(adopt_estimate(same.options, file(other_values())));
  EXPECT_EQ(same.passes, 1);
  for (const auto& [words, says] : std::vector<std::pair<std::vector<const char*>, std::string>>{
           {{"--number", "1"}, "was made with --number 3.5, not 1; leave --number out"},
           {{"--maybe", "2"}, "was made with --maybe 0.1, not 2"},
           {{"--count", "2"}, "was made with --count 7, not 2"},
           {{"--word", "a"}, "was made with --word b c, not a"},
           {{"--shape", "round"}, "was made with --shape square, not round; leave --shape out"},
           {{"--form", "round"}, "was made with --shape square, not round; leave --form out"},
           {{"--late", "round"}, "was made with --late square, not round"}})
    expect_refused(other_values(), words, ExitCode::mismatch, says);
}

TEST_F(Adoption, UnrecordedValues) {
  Program old({"--number", "3", "--word", "z"});
  adopt_estimate(old.options, file(Json::Object{{"count", 7}}));
  EXPECT_EQ(old.number, 3) << "not known of an older file";
  EXPECT_EQ(old.word, "z");
  EXPECT_EQ(old.count, 7);
  expect_refused(Json::Object{}, {"--late", "square"}, ExitCode::mismatch,
                 "was made with --late round, not square");
  expect_refused(Json::Object{{"maybe", Json()}}, {"--maybe", "2"}, ExitCode::mismatch,
                 "was made without --maybe; leave --maybe out");
}

TEST_F(Adoption, DamagedValuesAreTheFiles) {
  for (const auto& [name, value] : std::vector<std::pair<std::string, Json>>{{"number", 11},
                                                                             {"number", "3"},
                                                                             {"count", 1.5},
                                                                             {"flag", "true"},
                                                                             {"shape", "flat"},
                                                                             {"word", Json::Array{1}}})
    expect_refused(Json::Object{{name, value}}, {}, ExitCode::bad_input, "damaged metadata: --" + name);
}

TEST_F(Adoption, HelpAndDescriptionSayWhich) {
  Program program;
  std::string cache;
  program.options.file("add-to", cache, "kept", FileUse::grown);
  for (const std::string& text : {program.options.help(), program.options.manual()}) {
    std::string flat;
    for (const char c : text)
      if (c != '\\' && c != '\n' && !(c == ' ' && flat.ends_with(' '))) flat += c;
    EXPECT_NE(flat.find("taken from this file"), std::string::npos) << flat;
  }
  EXPECT_EQ(program.options.names(Adopted::estimate),
            (std::vector<std::string>{"number", "maybe", "count", "flag", "word", "shape", "late"}));
  EXPECT_TRUE(program.options.names(Adopted::site).empty());
}

TEST_F(Adoption, TwoNamesOfOneValueAreNotGivenTogether) {
  try {
    Program({"--form", "round", "--shape", "round"});
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_STREQ(e.what(), "sets the same as --shape; give one of the two");
  }
}

}  // namespace
}  // namespace phos
