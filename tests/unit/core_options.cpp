#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/text/likeness.h"
#include "support/complaint.h"
#include "support/every_option.h"

namespace phos {
namespace {

struct Everything : test::EveryOption {
  bool parse(std::vector<const char*> words) {
    words.insert(words.begin(), "phos-x");
    return options.parse(static_cast<int>(words.size()), words.data());
  }
  std::string error(const std::vector<const char*>& words) {
    try {
      parse(words);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      return e.where() + ": " + e.what();
    }
    return "no error";
  }
};

TEST(Options, ReadsEveryKind) {
  Everything e;
  ASSERT_TRUE(e.parse({"--flag", "--number", "1e-6", "--maybe=-2", "--count", "7", "in.glb", "-o", "out",
                       "--word", "two words", "--items", "a,b", "--items", "c", "--shape", "disc"}));
  EXPECT_TRUE(e.flag);
  EXPECT_EQ(e.number, 1e-6);
  EXPECT_EQ(e.maybe, -2);
  EXPECT_EQ(e.count, 7);
  EXPECT_EQ(e.input, "in.glb");
  EXPECT_EQ(e.path, "out");
  EXPECT_EQ(e.items, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(e.shape, Everything::Shape::disc);
  EXPECT_TRUE(e.options.given("number"));
}

TEST(Options, AListTakesOneWordEachTime) {
  Everything e;
  ASSERT_TRUE(e.parse({"--items", "a,b", "in.glb", "--items", "c", "second.glb"}));
  EXPECT_EQ(e.items, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(e.input, "in.glb");
  EXPECT_EQ(e.more, (std::vector<std::string>{"second.glb"}));
}

TEST(Options, RecordsWhatChangesTheResultAndNoPaths) {
  Everything e;
  ASSERT_TRUE(e.parse({"in.glb", "-o", "out", "--number", "3"}));
  EXPECT_EQ(e.options.recorded().dump(),
            R"({"count":10,"flag":false,"items":[],"maybe":null,"number":3,"shape":"hull","word":""})");
  EXPECT_EQ(e.options.command(), "phos-x --count 10 --number 3 --shape hull");
}

TEST(Options, RecordFollowsAutomaticValues) {
  Everything e;
  ASSERT_TRUE(e.parse({"in.glb"}));
  e.maybe = 0.25;
  EXPECT_EQ(e.options.recorded().find("maybe")->as_number(), 0.25);
}

TEST(Options, ErrorsNameTheOptionAndTheMend) {
  EXPECT_NE(Everything().error({"in", "--number", "0"}).find("above 0"), std::string::npos);
  EXPECT_NE(Everything().error({"in", "--number", "nan"}).find("not a number"), std::string::npos);
  EXPECT_NE(Everything().error({"in", "--number", "1x"}).find("--number"), std::string::npos);
  EXPECT_NE(Everything().error({"in", "--count", "1.5"}).find("whole number"), std::string::npos);
  EXPECT_NE(Everything().error({"in", "--count", "101"}).find("0 to 100"), std::string::npos);
  EXPECT_NE(Everything().error({"in", "--shape", "square"}).find("hull, disc"), std::string::npos);
  EXPECT_NE(Everything().error({"in", "--nonsense"}).find("--nonsense"), std::string::npos);
  EXPECT_NE(Everything().error({}).find("usage: phos-x"), std::string::npos);
  EXPECT_NE(Everything().error({"--flag"}).find("SCENE is missing"), std::string::npos);
}

TEST(Likeness, NearestName) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("same", "same"), 0u);
  EXPECT_EQ(did_you_mean("acuracy", {"rays", "accuracy", "radius"}), "; did you mean \"accuracy\"?");
  EXPECT_EQ(did_you_mean("xyzzyxyz", {"rays", "accuracy"}), "");
  EXPECT_EQ(did_you_mean("--ordr", {"--north"}), "") << "dashes are no likeness";
}

TEST(Options, AMistypedOneIsToldTheNearest) {
  EXPECT_EQ(Everything().error({"in", "--cuont", "5"}),
            "--cuont: no such option; did you mean \"--count\"?; see phos-x --help");
  EXPECT_EQ(Everything().error({"in", "--nunber=5"}),
            "--nunber: no such option; did you mean \"--number\"?; see phos-x --help");
  EXPECT_EQ(Everything().error({"--hlep"}),
            "--hlep: no such option; did you mean \"--help\"?; see phos-x --help");
  EXPECT_EQ(Everything().error({"in", "--nonsense"}), "--nonsense: no such option; see phos-x --help");
}

TEST(Options, ReadsAFileOfOptions) {
  const std::string path = std::string(PHOS_SCRATCH) + "/options.txt";
  std::ofstream(path) << "# settings\nnumber = 5\n--flag\n\nword hello there  # trailing\n";
  Everything e;
  ASSERT_TRUE(e.parse({("@" + path).c_str(), "in"}));
  EXPECT_EQ(e.number, 5);
  EXPECT_TRUE(e.flag);
  EXPECT_EQ(e.word, "hello there");
}

TEST(Options, AFileOfOptionsMayLeaveOutAValue) {
  const std::string path = std::string(PHOS_SCRATCH) + "/options-empty.txt";
  std::ofstream(path) << "number =\n";
  EXPECT_NE(Everything().error({("@" + path).c_str(), "in"}).find("--number"), std::string::npos);
  std::ofstream(path) << "word=\n";
  Everything e;
  ASSERT_TRUE(e.parse({("@" + path).c_str(), "in"}));
  EXPECT_EQ(e.word, "");
}

TEST(Options, FilesOfOptionsThatCannotBeRead) {
  const std::string folder = PHOS_SCRATCH, large = folder + "/large-options.txt";
  std::ofstream(large) << std::string((1 << 20) + 1, '#');
  const auto said = [](const std::string& path) {
    return test::complaint_of([&] { Everything().parse({("@" + path).c_str()}); });
  };
  EXPECT_NE(said(folder).find("cannot be read"), std::string::npos) << "a folder";
  EXPECT_NE(said(folder + "/none.txt").find("cannot be read"), std::string::npos);
  EXPECT_NE(said(large).find("larger than 1 MiB"), std::string::npos);
  EXPECT_NE(said("/dev/zero").find("larger than 1 MiB"), std::string::npos);
  std::filesystem::remove(large);
}

TEST(Options, SayWhichChoiceMayBeMeant) {
  const std::string near = Everything().error({"in", "--shape", "disk"});
  EXPECT_NE(near.find("\"disk\" is not one of: hull, disc; did you mean \"disc\"?"), std::string::npos)
      << near;
  const std::string far = Everything().error({"in", "--shape", "triangle"});
  EXPECT_NE(far.find("\"triangle\" is not one of: hull, disc"), std::string::npos) << far;
  EXPECT_EQ(far.find("did you mean"), std::string::npos) << far;
}

TEST(Options, AreDescribedForPrograms) {
  Everything e;
  testing::internal::CaptureStdout();
  EXPECT_FALSE(e.parse({"--options-json"}));
  std::string out = testing::internal::GetCapturedStdout();
  std::erase(out, '\n'), std::erase(out, ' ');
  const auto said = [&](const std::string& words) { return out.find(words) != std::string::npos; };
  EXPECT_TRUE(said(R"("tool":"phos-x")"));
  // Members are sorted by name.
  EXPECT_TRUE(
      said(R"({"default":0.2,"help":"anumber","kind":"number","min":0,"min_excluded":true,)"
           R"("name":"number","recorded":true,"required":false,"section":"Options","unit":"METRES"})"));
  EXPECT_TRUE(said(R"("kind":"integer","max":100,"min":0,"min_excluded":false,"name":"count")"));
  EXPECT_TRUE(said(R"("choices":["hull","disc"],"default":"hull","help":"ashape","kind":"choice")"));
  EXPECT_TRUE(said(R"("kind":"file","name":"output","recorded":false)"));
  EXPECT_TRUE(said(R"("default":null,"help":"anumberthatmaybeabsent","kind":"number","name":"maybe")"));
  for (const char* kind : {"flag", "text", "list", "input", "inputs"})
    EXPECT_TRUE(said(std::string(R"("kind":")") + kind + '"')) << kind;
}

TEST(Options, HelpAndManualHoldEveryOption) {
  const Everything e;
  const std::string help = e.options.help();
  const std::string manual = e.options.manual();
  for (const char* name : {"flag", "number", "maybe", "count", "word", "items", "output", "shape"}) {
    EXPECT_NE(help.find(name), std::string::npos) << name;
    EXPECT_NE(manual.find(name), std::string::npos) << name;
  }
  for (const char* code : {"130", "interrupted"}) EXPECT_NE(help.find(code), std::string::npos);
  for (std::size_t begin = 0, end; (end = help.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_LE(end - begin, 110u) << help.substr(begin, end - begin);
}

/// What another run recorded is recorded as if it had been given; it was not.
TEST(Options, AdoptedValuesAreRecordedAsGiven) {
  const auto recorded = [](std::vector<const char*> words, bool adopt) {
    Options options("phos-x", "", "");
    std::string sky;
    std::optional<double> sun;
    std::int64_t bands = 0;
    options.text("sky", sky, "SKY", "", Recorded::if_given);
    options.number("sun", sun, "LUX", "", kPositive, Recorded::if_given);
    options.integer("bands", bands, "N", "", {0, 100}, Recorded::if_given);
    EXPECT_EQ(options.names(), (std::vector<std::string>{"sky", "sun", "bands"}));
    words.insert(words.begin(), "phos-x");
    options.parse(static_cast<int>(words.size()), words.data());
    if (adopt) {
      options.adopt("sky", "clear");
      options.adopt("sun", 0.1);
      options.adopt("bands", 12);
      EXPECT_FALSE(options.given("sky"));
      EXPECT_EQ(sky, "clear");
      EXPECT_EQ(sun, 0.1);
      EXPECT_EQ(bands, 12);
      EXPECT_THROW(options.adopt("bands", 101), Error);
      EXPECT_THROW(options.adopt("sun", "bright"), Error);
    }
    return options.recorded().dump() + options.command();
  };
  EXPECT_EQ(recorded({}, true), recorded({"--sky", "clear", "--sun", "0.1", "--bands", "12"}, false));
}

}  // namespace
}  // namespace phos
