// Files of studies that fuzzers found, and small ones that ask for much.
#include <gtest/gtest.h>

#include "support/run.h"

#define LLVMFuzzerTestOneInput read_toml_bytes
#include "fuzz/fuzz_toml.cpp"
#undef LLVMFuzzerTestOneInput

namespace phos {
namespace {

int read_bytes(const std::string& bytes) {
  return read_toml_bytes(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string refusal(const std::string& bytes) {
  EXPECT_EQ(read_bytes(bytes), 0);
  try {
    const std::string path = fuzz::spilled(bytes, "study.toml");
    fuzz::spilled("", "room.glb");
    read_study(path, CommandRunner({}, fuzz::scratch()));
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

std::string repeated(const std::string& s, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += s;
  return all;
}

TEST(Regression, WhatFuzzersFoundIsAnswered) {
  for (const auto& entry : std::filesystem::directory_iterator(test::data("damaged"))) {
    if (!entry.path().filename().string().starts_with("toml-")) continue;
    SCOPED_TRACE(entry.path().string());
    EXPECT_EQ(read_bytes(test::slurp(entry.path().string())), 0);
  }
}

TEST(Sizes, KeysOfManyPartsAreRefused) {
  EXPECT_NE(refusal(repeated("a.", 50000) + "a = 1\n").find("dots"), std::string::npos);
  EXPECT_NE(refusal("[" + repeated("a.", 50000) + "a]\n").find("dots"), std::string::npos);
  EXPECT_NE(refusal(repeated("\"a\" . ", 50000) + "a = 1\n").find("dots"), std::string::npos);
  EXPECT_NE(refusal(repeated("'a' .", 50000) + "a = 1\n").find("dots"), std::string::npos);
  EXPECT_NE(refusal("x = \"\"\"a\"\"\"\n" + repeated("a.", 50000) + "a = 1\n").find("dots"),
            std::string::npos);
}

TEST(Sizes, DotsElsewhereAreTaken) {
  for (const std::string& line :
       {"x = [" + repeated("0.5, ", 1000) + "1.5]\n", "x = \"" + repeated("a.", 1000) + "\"\n",
        "# " + repeated("a.", 1000) + "\nx = 1\n", "x = '''" + repeated("a.\n'", 1000) + "'''\n",
        "x = \"\\\"" + repeated("a.", 1000) + "\"\n", std::string("x = { y.z = 1, z.y = 2 }\n")})
    EXPECT_NO_THROW(parse_toml(line, "a.toml")) << line.substr(0, 40);
}

TEST(Text, LettersOfOtherLanguagesAreTaken) {
  EXPECT_EQ(parse_toml("x = \"\"\"a\\\n  \xc3\xa9\"\"\"  # \xc3\x96\n", "a.toml").root.find("x")->as_string(),
            "a\xc3\xa9");
  EXPECT_NE(refusal("x = 1 \xc3\x96\n").find("is not TOML"), std::string::npos);
}

TEST(Sizes, NestingIsRefused) {
  EXPECT_NE(refusal("x = " + std::string(100000, '[')), "");
  EXPECT_NE(refusal("x = " + repeated("{a=", 50000)), "");
  EXPECT_NE(refusal("x = " + repeated("{a.b.c.d.e.f.g=", 200) + "1" + repeated("}", 200)), "");
}

TEST(Sizes, RepeatsAreLimited) {
  for (const char* repeats : {"100001", "1000000000000", "9223372036854775807"})
    EXPECT_NE(refusal(std::string("[study]\nscenes = \"room.glb\"\nrepeats = ") + repeats).find("at most"),
              std::string::npos);
}

}  // namespace
}  // namespace phos
