// Tables of the manual's pages that the code writes. A test compares them; --update writes them anew.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/run.h"
#include "support/update.h"

namespace phos::test {

/// In the page, after the line <!-- MARK --> and an empty line, stands `table` as far as `end` says, which
/// gets the page and where that starts.
template <class End>
void expect_written(const std::string& page, const std::string& mark, const std::string& table,
                    const End& end) {
  const std::string path = std::string(PHOS_SOURCE) + "/" + page, line = "<!-- " + mark + " -->\n\n";
  std::string text = slurp(path);
  std::size_t from = text.find(line);
  ASSERT_NE(from, std::string::npos) << page << " has no line <!-- " << mark << " --> before an empty one";
  from += line.size();
  const std::size_t to = end(text, from);
  if (updating_golden())
    spill(path, text.replace(from, to - from, table));
  else
    EXPECT_EQ(text.substr(from, to - from), table) << page << ": run this test with --update";
}

/// The lines that begin with "|".
inline void expect_table(const std::string& page, const std::string& mark, const std::string& table) {
  expect_written(page, mark, table, [](const std::string& text, std::size_t to) {
    while (to < text.size() && text[to] == '|') to = std::min(text.find('\n', to), text.size() - 1) + 1;
    return to;
  });
}

/// All of the page from there on: tables and headings.
inline void expect_rest(const std::string& page, const std::string& mark, const std::string& rest) {
  expect_written(page, mark, rest, [](const std::string& text, std::size_t) { return text.size(); });
}

}  // namespace phos::test
