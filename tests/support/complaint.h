// What goes wrong, as text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace phos::test {

/// "where: what" of the Error that `action` throws, "" if it throws none. Expects it to be of this kind, in
/// one line.
template <class Action>
std::string complaint_of(const Action& action, ExitCode code = ExitCode::bad_input) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.where() + ": " + e.what();
  }
  return "";
}

}  // namespace phos::test
