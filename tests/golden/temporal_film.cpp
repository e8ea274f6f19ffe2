// A film of the cube in a box, and one of radiance records of glossy spheres: what the file says of itself,
// and the range of each column.
#include <regex>

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
  static void make_radiance_film() {
    if (std::filesystem::exists(path("radiance-film"))) return;
    must({"temporal", data("spheres.glb"), "--kind", "radiance", "--frames", "10:14", "--photons", "5000",
          "--rays", "64", "--accuracy", "0.6", "--width", "24", "--store", "float", "-o",
          path("radiance-film")});
  }
};

/// Without how many records and events there are: at a few places the processor's rounding decides.
std::string without_counts(const std::string& said) {
  static const std::regex shape(" ([FIU][0-9]+  )[0-9]+"), count("^(  .*[^ ]  +)[0-9]+$");
  std::string section, all;
  for (const std::string& line : lines_of(said)) {
    if (line.find(' ') != 0) section = line;
    all += section == "tensors:"                           ? std::regex_replace(line, shape, " $1N")
           : section == "counters:" || section == "extra:" ? std::regex_replace(line, count, "$1N")
                                                           : line;
    all += "\n";
  }
  return all;
}

TEST_F(GoldenFilm, SaysWhatItIs) {
  make_film();
  expect_golden_text("temporal-film.txt", without_counts(canonical(path("film"))));
}

TEST_F(GoldenFilm, RecordsLiveAndChangeAsTheyDid) {
  make_film();
  expect_golden_numbers("temporal-film.json", ranges_of(path("film")), 0.05);
}

TEST_F(GoldenFilm, OfRadianceSaysWhatItIs) {
  make_radiance_film();
  expect_golden_text("temporal-radiance-film.txt", without_counts(canonical(path("radiance-film"))));
}

TEST_F(GoldenFilm, RadianceRecordsLiveAndChangeAsTheyDid) {
  make_radiance_film();
  expect_golden_numbers("temporal-radiance-film.json", ranges_of(path("radiance-film")), 0.05);
}

}  // namespace
}  // namespace phos::test
