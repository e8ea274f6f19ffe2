// Sensors on the floor and in the air of the Cornell box: the columns, exactly, and every number within
// tolerance.
#include "file/csv.h"
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

class GoldenSense : public GoldenCornell {
 protected:
  static void make() {
    make_irradiance();
    if (std::filesystem::exists(path("csv"))) return;
    // A row near the floor, which the caches reach, one on a workplane and one that looks at a wall.
    std::string points = "id,x,y,z,nx,ny,nz\n";
    for (int i = 0; i < 12; ++i) {
      const std::string x = std::to_string(0.08 + 0.13 * (i % 4));
      points += "p" + std::to_string(i) + "," + x +
                (i < 4   ? ",0.001,0.05,0,1,0"
                 : i < 8 ? ",0.4,0.25,0,1,0"
                         : ",0.45,0.3,-1,0,0") +
                "\n";
    }
    spill(path("points"), points);
    must({"sense", scene(), path("irradiance"), "--points", path("points"), "--rays", "256", "-o",
          path("csv")});
  }
  static CsvTable table() { return parse_csv(slurp(path("csv")), path("csv")); }
};

TEST_F(GoldenSense, SaysWhatItIs) {
  make();
  expect_golden_text("sense-cornell.txt", table().names() + "\n");
}

TEST_F(GoldenSense, MeasuresWhatItDid) {
  make();
  const CsvTable measured = table();
  Numbers numbers;
  for (std::size_t column = 0; column < measured.columns.size(); ++column) {
    if (measured.columns[column] == "id") continue;
    for (std::size_t row = 0; row < measured.rows.size(); ++row)
      numbers[measured.columns[column] + ".p" + std::to_string(row)] = measured.number(row, column);
  }
  expect_golden_numbers("sense-cornell.json", numbers, 0.01);
}

}  // namespace
}  // namespace phos::test
