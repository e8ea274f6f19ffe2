// What every tool owes a user who gives it something wrong.
#pragma once

#include <gtest/gtest.h>

#include "support/run.h"

namespace phos::test {

/// One line on stderr that holds `word`, and the exit code.
inline void expect_failure(const Run& run, int code, const std::string& word) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_TRUE(is_one_line(run.err)) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
}

/// The same, and nothing on stdout.
inline void expect_refused(const std::string& tool, const std::vector<std::string>& arguments, int code,
                           const std::string& word) {
  std::vector<std::string> words{tool};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Run run = run_tool(words);
  expect_failure(run, code, word);
  EXPECT_TRUE(run.out.empty()) << run.out;
}

}  // namespace phos::test
