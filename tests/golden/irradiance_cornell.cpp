// Records of the Cornell box: what the file says of itself, exactly, and the range of each column.
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

TEST_F(GoldenCornell, RecordsSayWhatTheyAre) {
  make_irradiance();
  expect_golden_text("irradiance-cornell.txt", canonical(path("irradiance")));
}

TEST_F(GoldenCornell, RecordsAreWhereTheyWere) {
  make_irradiance();
  expect_golden_numbers("irradiance-cornell.json", ranges_of(path("irradiance")), 1e-3);
}

}  // namespace
}  // namespace phos::test
