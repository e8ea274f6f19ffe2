// A film of the cube in a box: what the file says of itself, exactly, and the range of each column.
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

class GoldenFilm : public GoldenCornell {
 protected:
  static void make_film() {
    if (std::filesystem::exists(path("film"))) return;
    must({"temporal", data("cube-in-a-box.glb"), "--frames", "100:108", "--photons", "10000", "--rays", "64",
          "--accuracy", "0.4", "--width", "40", "-o", path("film")});
  }
};

TEST_F(GoldenFilm, SaysWhatItIs) {
  make_film();
  expect_golden_text("temporal-film.txt", canonical(path("film")));
}

TEST_F(GoldenFilm, RecordsLiveAndChangeAsTheyDid) {
  make_film();
  expect_golden_numbers("temporal-film.json", ranges_of(path("film")), 1e-3);
}

}  // namespace
}  // namespace phos::test

int main(int argc, char** argv) { return phos::test::golden_main(argc, argv); }
