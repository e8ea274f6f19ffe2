// Cases of CIE 171:2006 by the script, at toy size, against golden values.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "file/csv.h"
#include "support/script.h"

namespace phos::test {
namespace {

class Cie171 : public testing::Test {
 protected:
  void SetUp() override { folder_ = scratch("pipelines-cie171"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// Runs it and reads results.csv.
  CsvTable results(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"out", "--quick"});
    const auto run = run_script("cie171.sh", arguments, folder_);
    EXPECT_EQ(run.code, 0) << run.err << slurp(path("out/log.txt"));
    return parse_csv(slurp(path("out/results.csv")), "results.csv");
  }
  std::string folder_;
};

/// Each value within 2 % of its truth or three standard errors, of which some are exceeded by chance.
void expect_true(const CsvTable& table) {
  const std::size_t value = table.column("value", ""), error = table.column("stderr", ""),
                    truth = table.column("truth", "");
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    EXPECT_NEAR(table.number(i, value), table.number(i, truth),
                std::max(0.02 * table.number(i, truth), 3 * table.number(i, error)) + 1e-9)
        << table.rows[i][0] << " " << table.rows[i][1] << " " << table.rows[i][2] << " " << table.rows[i][4];
}

/// The truth that the script states for a point.
double truth_of(const CsvTable& table, const std::string& of_case, const std::string& variant,
                const std::string& point) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i][0] == of_case && table.rows[i][1] == variant && table.rows[i][2] == point)
      return table.number(i, table.column("truth", ""));
  return NAN;
}

}  // namespace

TEST_F(Cie171, OpeningsWithAndWithoutGlassHoldTheirValues) {
  const CsvTable table = results({"--cases", "5.9,5.12", "--skies", "5", "--estimators", "gathered,cached"});
  EXPECT_EQ(table.rows.size(), 2u * 2 * (14 + 22));
  expect_true(table);
  EXPECT_DOUBLE_EQ(truth_of(table, "5.9", "1x1", "A"), 1.04013797);
  EXPECT_DOUBLE_EQ(truth_of(table, "5.12", "2x1", "A"), 0.836418927);
  const std::string page = slurp(path("out/index.html"));
  EXPECT_NE(page.find("roof opening, 1 sky"), std::string::npos);
  EXPECT_NE(slurp(path("out/cie171.md")).find("| 5.12 |"), std::string::npos);
}

TEST_F(Cie171, LampsPanesMasksAndPicturesHoldTheirValues) {
  const CsvTable lamps = results({"--cases", "5.2,5.3,5.5", "--estimators", "gathered"});
  EXPECT_EQ(lamps.rows.size(), 10u + 14 + 54);
  expect_true(lamps);
  EXPECT_DOUBLE_EQ(truth_of(lamps, "5.2", "", "A"), 111.111111);
  EXPECT_DOUBLE_EQ(truth_of(lamps, "5.3", "", "A"), 32.676898);
  const CsvTable masks = results({"--cases", "5.14", "--skies", "5", "--estimators", "gathered"});
  expect_true(masks);
  EXPECT_DOUBLE_EQ(truth_of(masks, "5.14", "mask 3", "A"), 1.15110155);
  const CsvTable seen = results({"--cases", "5.2", "--estimators", "picture,exact"});
  expect_true(seen);
  const std::size_t estimator = seen.column("estimator", "");
  std::set<std::string> names;
  for (const auto& row : seen.rows) names.insert(row[estimator]);
  EXPECT_EQ(names, (std::set<std::string>{"exact", "picture"}));
}

TEST_F(Cie171, WrongWordsAreRefused) {
  EXPECT_EQ(run_script("cie171.sh", {}, folder_).code, 2);
  EXPECT_EQ(run_script("cie171.sh", {"out", "--what"}, folder_).code, 2);
  EXPECT_EQ(run_script("cie171.sh", {"out", "--cases", "5.99"}, folder_).code, 2);
  EXPECT_EQ(run_script("cie171.sh", {"out", "--estimators", "guess"}, folder_).code, 2);
}

}  // namespace phos::test
