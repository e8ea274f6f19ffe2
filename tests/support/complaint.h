// What goes wrong, as text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace phos::test {

/// "where: what" of the Error that `action` throws, "" if it throws none. Expects bad_input in one line.
template <class Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.where() + ": " + e.what();
  }
  return "";
}

}  // namespace phos::test
