// Strict JSON: what is read, what is refused, and that printing and reading are inverse.
#include <gtest/gtest.h>

#include "core/error.h"
#include "file/json_parse.h"

namespace phos {
namespace {

std::string message(const std::string& s) {
  try {
    parse_json(s, "x.json");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_EQ(e.where(), "x.json");
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return "";
}

TEST(ParseJson, EveryType) {
  const Json v = parse_json(R"( {"a":[1,-2.5,1e3,true,false,null,"x\u00e9\n"],"b":{}} )", "");
  const Json::Array& a = v.find("a")->as_array();
  EXPECT_TRUE(a[0].is_integer());
  EXPECT_EQ(a[0].as_integer(), 1);
  EXPECT_EQ(a[1].as_number(), -2.5);
  EXPECT_FALSE(a[2].is_integer());
  EXPECT_EQ(a[2].as_number(), 1000);
  EXPECT_TRUE(a[3].as_bool());
  EXPECT_TRUE(a[5].is_null());
  EXPECT_EQ(a[6].as_string(), "x\xc3\xa9\n");
  EXPECT_TRUE(v.find("b")->as_object().empty());
}

TEST(ParseJson, PrintingIsTheInverse) {
  Json v;
  v["text"] = "quote \" backslash \\ control \x01 \xe2\x82\xac";
  v["numbers"] = Json::Array{0.1, 1e300, -1e-300, 9007199254740993, 0.1f};
  v["nested"]["deeper"] = Json::Array{Json::Array{}, Json::Object{}, Json(), true};
  EXPECT_EQ(parse_json(v.dump(), ""), v);
  EXPECT_EQ(parse_json(v.dump(3), ""), v);
}

TEST(ParseJson, ZeroKeepsItsSign) {
  for (const char* zero : {"-0", "-0.0", "-0e1", "-1e-400"})
    EXPECT_EQ(parse_json(parse_json(zero, "").dump(), "").dump(), "-0") << zero;
  EXPECT_EQ(parse_json("0", "").dump(), "0");
}

TEST(ParseJson, IntegersBeyond64BitsBecomeNumbers) {
  EXPECT_EQ(parse_json("9223372036854775807", "").as_integer(), INT64_MAX);
  EXPECT_FALSE(parse_json("9223372036854775808", "").is_integer());
  EXPECT_EQ(parse_json("18446744073709551616", "").as_number(), 0x1p64);
}

TEST(ParseJson, MalformedTextNamesTheByte) {
  EXPECT_NE(message("{\"a\":1,}").find("at byte 8"), std::string::npos) << message("{\"a\":1,}");
  for (const char* s : {"", "{", "[1,]", "nul", "{\"a\" 1}", "01", "1 2", "'a'", "\"\\x\"", "\"\n\"", "NaN",
                        "1e999", "{\"a\":1,\"a\":2}", "\"\xff\"", "// c\n1"})
    EXPECT_NE(message(s), "") << s;
}

TEST(ParseJson, AZeroByteIsNotTheEnd) { EXPECT_NE(message(std::string("1\0 2", 4)), ""); }

TEST(ParseJson, DepthIsLimited) {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_EQ(message(nested(256)), "");
  EXPECT_NE(message(nested(257)).find("deeper than 256"), std::string::npos);
  EXPECT_NE(message(std::string(1000000, '[')), "");
}

}  // namespace
}  // namespace phos
