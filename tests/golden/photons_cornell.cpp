// Photons of the Cornell box: what the file says of itself, exactly, and the range of each column.
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

TEST_F(GoldenCornell, PhotonsSayWhatTheyAre) {
  make_photons();
  expect_golden_text("photons-cornell.txt", canonical(path("photons")));
}

TEST_F(GoldenCornell, PhotonsAreWhereTheyWere) {
  make_photons();
  expect_golden_numbers("photons-cornell.json", ranges_of(path("photons")), 1e-4);
}

}  // namespace
}  // namespace phos::test
