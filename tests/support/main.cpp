// main of every test program.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "support/update.h"

namespace {

bool updating = false;

/// Appends a line "WORD KIND.SUITE.CASE" to a file that many programs write at once: "planned" for each case
/// before the first, then "passed", "failed" or "skipped" once it has ended.
class ResultLines : public testing::EmptyTestEventListener {
 public:
  ResultLines(const std::string& file, const std::string& program)
      : file_(open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)) {
    const std::string name = std::filesystem::path(program).filename().string();
    kind_ = name.substr(0, name.find('_'));
  }
  void OnTestIterationStart(const testing::UnitTest& all, int) override {
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
      const testing::TestSuite& suite = *all.GetTestSuite(i);
      for (int k = 0; k < suite.total_test_count(); ++k)
        if (suite.GetTestInfo(k)->should_run()) write_line("planned", *suite.GetTestInfo(k));
    }
  }
  void OnTestEnd(const testing::TestInfo& test) override {
    const testing::TestResult& result = *test.result();
    write_line(result.Failed() ? "failed" : result.Skipped() ? "skipped" : "passed", test);
  }

 private:
  void write_line(const char* word, const testing::TestInfo& test) const {
    const std::string line =
        std::string(word) + " " + kind_ + "." + test.test_suite_name() + "." + test.name() + "\n";
    if (write(file_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) std::abort();
  }
  int file_;
  std::string kind_;
};

}  // namespace

bool phos::test::updating_golden() { return updating; }

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  for (int i = 1; i < argc; ++i) updating = updating || std::string_view(argv[i]) == "--update";
  if (const char* file = std::getenv("PHOS_TEST_RESULTS"))
    testing::UnitTest::GetInstance()->listeners().Append(new ResultLines(file, argv[0]));
  return RUN_ALL_TESTS();
}
