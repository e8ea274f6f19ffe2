// Tables as comma-separated values.
#include "file/csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "support/complaint.h"

namespace phos {
namespace {

TEST(Csv, ReadsWhatSpreadsheetsWrite) {
  const CsvTable t = parse_csv(
      "\xef\xbb\xbf# made by hand\r\nname, lux ,note\r\n\r\n\"a, \"\"b\"\"\", +1.5,\r\nc,-,\"two\nlines\"\r\n"
      "last,nan,x",
      "t.csv");
  EXPECT_EQ(t.columns, (std::vector<std::string>{"name", "lux", "note"}));
  ASSERT_EQ(t.rows.size(), 3u);
  EXPECT_EQ(t.rows[0][0], "a, \"b\"");
  EXPECT_EQ(t.rows[1][2], "two\nlines");
  EXPECT_EQ(t.number(0, 1), 1.5);
  EXPECT_TRUE(std::isnan(t.number(0, 2)));
  EXPECT_TRUE(std::isnan(t.number(1, 1)));
  EXPECT_TRUE(std::isnan(t.number(2, 1)));
  EXPECT_EQ(t.line, (std::vector<std::size_t>{4, 5, 7}));
  EXPECT_EQ(t.column("note", "--y"), 2u);
  EXPECT_EQ(t.names(), "name, lux, note");
}

std::string complaint(const std::string& bytes) {
  return test::complaint_of([&] { parse_csv(bytes, "t.csv"); });
}

TEST(Csv, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(complaint("").find("is empty"), std::string::npos);
  EXPECT_NE(complaint("# nothing\n").find("is empty"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,2\n3\n").find("t.csv:3"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,2,3\n").find("3 values under 2 names"), std::string::npos);
  EXPECT_NE(complaint("a,a\n1,2\n").find("twice"), std::string::npos);
  EXPECT_NE(complaint("a,b\n\"1,2\n").find("not closed"), std::string::npos);
  EXPECT_NE(complaint("a,b\n\"1\"2,3\n").find("after its quote"), std::string::npos);
  EXPECT_NE(complaint(std::string("a,b\n1,\0\n", 8)).find("not text"), std::string::npos);
  const CsvTable t = parse_csv("a,b\n1,2 m\n", "t.csv");
  EXPECT_THROW(t.number(0, 1), Error);
  EXPECT_THROW(t.column("c", "--x"), Error);
}

}  // namespace
}  // namespace phos
