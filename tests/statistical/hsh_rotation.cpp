// The errors of every way of rotating HSH are those of data/golden/hsh/rotation_accuracy.csv (written by
// hsh_rotation_table --update), and what is said of the methods holds in it.
#include <gtest/gtest.h>

#include <map>

#include "support/golden_table.h"
#include "support/rotation_accuracy.h"

namespace phos::test {
namespace {

using Rows = std::vector<std::map<std::string, std::string>>;
Rows table() { return read_table(std::string(PHOS_SOURCE) + "/data/golden/hsh/rotation_accuracy.csv"); }

TEST(RotationAccuracy, IsThatOfTheTable) {
  const Rows rows = table();
  ASSERT_EQ(rows.size(), 90u);
  std::vector<RotationAccuracy> fresh;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    if (i % 6 == 0) fresh = rotation_accuracy(std::stoi(row.at("order")), std::stod(row.at("beta_deg")));
    const RotationAccuracy& f = fresh[i % 6];
    ASSERT_EQ(f.method, row.at("method"));
    const double lobes = std::stod(row.at("lobes_where_both_see")),
                 environments = std::stod(row.at("environments"));
    EXPECT_NEAR(f.lobes_where_both_see, lobes, 1e-3 * lobes) << row.at("order") << " " << f.method;
    EXPECT_NEAR(f.environments, environments, 1e-3 * environments) << row.at("order") << " " << f.method;
  }
}

/// Why the constant fill is the default: of the methods it is the best one, or all but, for lobes above both
/// horizons, and far better than filling with nothing where light goes on below the horizon.
TEST(RotationAccuracy, FavoursTheConstantFill) {
  std::map<std::string, std::map<std::string, double>> lobes, environments;  // by place, by method
  for (const auto& row : table()) {
    const std::string place = row.at("order") + " " + row.at("beta_deg");
    lobes[place][row.at("method")] = std::stod(row.at("lobes_where_both_see"));
    environments[place][row.at("method")] = std::stod(row.at("environments"));
  }
  ASSERT_EQ(lobes.size(), 15u);
  for (auto& [place, by] : lobes) {
    for (const auto& [method, error] : by)
      EXPECT_LT(by["constant_fill"], 1.01 * error) << place << " " << method;
    EXPECT_LT(by["constant_fill"], 0.7 * by["digon"]) << place;
    EXPECT_LT(by["constant_fill"], 0.25 * by["none"]) << place;
  }
  for (auto& [place, by] : environments) {
    for (const char* empty : {"zero_fill", "via_sh", "digon"})
      EXPECT_LT(by["constant_fill"], 0.35 * by[empty]) << place << " " << empty;
  }
}

}  // namespace
}  // namespace phos::test
