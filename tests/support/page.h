// Tables of the manual's pages that the code writes. A test compares them; --update writes them anew.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/run.h"
#include "support/update.h"

namespace phos::test {

/// In the page, after the line <!-- MARK --> and an empty line, stands `table`: the lines that begin with
/// "|".
inline void expect_table(const std::string& page, const std::string& mark, const std::string& table) {
  const std::string path = std::string(PHOS_SOURCE) + "/" + page, line = "<!-- " + mark + " -->\n\n";
  std::string text = slurp(path);
  std::size_t from = text.find(line);
  ASSERT_NE(from, std::string::npos) << page << " has no line <!-- " << mark << " --> before an empty one";
  from += line.size();
  std::size_t to = from;
  while (to < text.size() && text[to] == '|') to = std::min(text.find('\n', to), text.size() - 1) + 1;
  if (updating_golden())
    spill(path, text.replace(from, to - from, table));
  else
    EXPECT_EQ(text.substr(from, to - from), table) << page << ": run this test with --update";
}

}  // namespace phos::test
