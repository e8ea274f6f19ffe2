// main of every test program.
#include <gtest/gtest.h>

#include <string_view>

#include "support/update.h"

namespace {
bool updating = false;
}

bool phos::test::updating_golden() { return updating; }

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  for (int i = 1; i < argc; ++i) updating = updating || std::string_view(argv[i]) == "--update";
  return RUN_ALL_TESTS();
}
