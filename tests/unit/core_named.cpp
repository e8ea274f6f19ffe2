// Lists in one word: NAME=FILE, names, items, with commas and "=" in them.
#include <gtest/gtest.h>

#include "core/options.h"
#include "core/text/comma_list.h"
#include "core/text/named_files.h"
#include "support/complaint.h"
#include "support/run.h"

namespace phos {
namespace {

using Words = std::vector<std::string>;

Words pairs(const std::string& word) {
  Words out;
  for (const NamedFile& w : named_files({word}, "--x")) out.push_back(w.name + " | " + w.file);
  return out;
}

TEST(CommaList, EscapesArePartOfItems) {
  EXPECT_EQ(split_at_commas("a,b"), (Words{"a", "b"}));
  EXPECT_EQ(split_at_commas(R"(a\,b,c)"), (Words{"a,b", "c"}));
  EXPECT_EQ(split_at_commas(R"(a\\,c\d)"), (Words{R"(a\)", R"(c\d)"}));
  EXPECT_EQ(split_at_commas(""), (Words{""}));
  EXPECT_EQ(split_at_commas("a,,b,"), (Words{"a", "", "b"}));
}

TEST(CommaList, KnownNamesMayHoldCommas) {
  const auto split = [](const std::string& words, const Words& known) {
    return split_known_names(words, [&](const std::string& name) {
      return std::find(known.begin(), known.end(), name) != known.end();
    });
  };
  EXPECT_EQ(split("Window 1,2", {"Window 1,2"}), (Words{"Window 1,2"}));
  EXPECT_EQ(split("Window 1,2,door", {"Window 1", "Window 1,2", "door"}), (Words{"Window 1,2", "door"}));
  EXPECT_EQ(split("a,b", {"a", "b", "a,b"}), (Words{"a", "b"}));
  EXPECT_EQ(split(R"(a\,b)", {"a", "b", "a,b"}), (Words{"a,b"}));
  EXPECT_EQ(split("a,b,nobody", {"a,b"}), (Words{"a", "b", "nobody"}));
  EXPECT_EQ(split("Window,window", {"Window", "window"}), (Words{"Window", "window"}));
}

TEST(NamedFiles, CommasPartOnlyWhereNameAndFileFollow) {
  EXPECT_EQ(pairs("a=x,b=y"), (Words{"a | x", "b | y"}));
  EXPECT_EQ(pairs("Downlight 3,5 W=x.ies"), (Words{"Downlight 3,5 W | x.ies"}));
  EXPECT_EQ(pairs("lamp=iso 3,5W.ies"), (Words{"lamp | iso 3,5W.ies"}));
  EXPECT_EQ(pairs("lamp=iso 3,5W.ies,b=y"), (Words{"lamp | iso 3,5W.ies", "b | y"}));
  EXPECT_EQ(pairs("1,2=a,3=b"), (Words{"1,2 | a", "3 | b"}));
}

TEST(NamedFiles, EscapesArePartOfNamesAndFiles) {
  EXPECT_EQ(pairs(R"(a\=b=x)"), (Words{"a=b | x"}));
  EXPECT_EQ(pairs(R"(a=x\,b=y)"), (Words{"a | x,b=y"}));
  EXPECT_EQ(pairs(R"(a=x,Lamp 3\,5=y)"), (Words{"a | x", "Lamp 3,5 | y"}));
  EXPECT_EQ(pairs(R"(a\b=c\d)"), (Words{R"(a\b | c\d)"}));
}

TEST(NamedFiles, FilesThatExistDecide) {
  const std::string folder = test::scratch("named_files") + "/";
  for (const char* name : {"x.ies", "3,5.ies", "n=2.ies", "y,b=2.ies"}) test::spill(folder + name, "");
  EXPECT_EQ(pairs("a=b=" + folder + "x.ies"), (Words{"a=b | " + folder + "x.ies"}));
  EXPECT_EQ(pairs("a=" + folder + "n=2.ies"), (Words{"a | " + folder + "n=2.ies"}));
  EXPECT_EQ(pairs("a=" + folder + "x.ies,Lamp 3,5=" + folder + "3,5.ies,c=z"),
            (Words{"a | " + folder + "x.ies", "Lamp 3,5 | " + folder + "3,5.ies", "c | z"}));
  EXPECT_EQ(pairs("a=" + folder + "y,b=2.ies"), (Words{"a | " + folder + "y,b=2.ies"}));
  // A file that is missing stays the one that is complained of.
  EXPECT_EQ(pairs("a=none.ies,b=" + folder + "x.ies"), (Words{"a | none.ies", "b | " + folder + "x.ies"}));
}

TEST(NamedFiles, EachWordSplitAgainStaysOne) {
  const std::string x = test::scratch("named_again") + "/x";
  test::spill(x, "");
  for (const std::string& word : {"a=" + x + ",Lamp 3,5=" + x + ",b=c=" + x, std::string("1,2=a,3=b,c"),
                                  std::string(R"(a\=b=x\,c=d,e=f)")})
    for (const std::string& one : split_named_files(word)) EXPECT_EQ(split_named_files(one), Words{one});
}

TEST(NamedFiles, WordsOfAnotherForm) {
  for (const char* word : {"a", "=x", "a=", "", R"(a\=x)", "a,b"}) {
    const std::string why = test::complaint_of([&] { named_files({word}, "--x"); }, ExitCode::usage);
    EXPECT_NE(why.find("is not of the form NAME=FILE"), std::string::npos) << word << ": " << why;
  }
}

TEST(NamedFiles, OptionsRecordTheNames) {
  Options options("phos-x", "is a test", "");
  Words lamps;
  options.named_files("lamp", lamps, "lamps");
  const char* words[] = {"phos-x", "--lamp", "Downlight 3,5 W=x.ies,b=y", "--lamp", R"(a\=b=z)"};
  ASSERT_TRUE(options.parse(5, words));
  EXPECT_EQ(lamps, (Words{"Downlight 3,5 W=x.ies", "b=y", R"(a\=b=z)"}));
  EXPECT_EQ(options.recorded().dump(), R"({"lamp":["Downlight 3,5 W","b","a=b"]})");
}

}  // namespace
}  // namespace phos
