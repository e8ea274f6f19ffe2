// Radiance records at points of a glossy wall of the Cornell box: what the file says of itself, exactly, and
// the range of each column.
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

class GoldenRadiance : public GoldenCornell {
 protected:
  static void make() {
    if (std::filesystem::exists(path("radiance"))) return;
    const std::string scene = data("cornell-glossy22.glb");
    std::string points;
    for (int i = 0; i < 16; ++i)
      points += std::to_string(0.07 + 0.14 * (i % 4)) + "," + std::to_string(0.07 + 0.14 * (i / 4)) +
                ",0.5592,0,0,-1\n";
    spill(path("csv"), points);
    must({"photons", scene, "--photons", "20000", "-o", path("glossy.photons")});
    must({"radiance", scene, path("glossy.photons"), "--place", "every", "--at", path("csv"), "--rays", "500",
          "--store", "float", "-o", path("radiance")});
  }
};

TEST_F(GoldenRadiance, SaysWhatItIs) {
  make();
  // Counts hang on last bits, which processors round in their own way.
  std::string said = canonical(path("radiance"));
  const std::size_t from = said.find("counters:"), to = said.find("extra:");
  if (from < to) said.erase(from, to - from);
  expect_golden_text("radiance-cornell.txt", said);
}

TEST_F(GoldenRadiance, IsWhatItWas) {
  make();
  expect_golden_numbers("radiance-cornell.json", ranges_of(path("radiance")), 5e-3);
}

}  // namespace
}  // namespace phos::test
