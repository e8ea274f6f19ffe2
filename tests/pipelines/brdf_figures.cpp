// pipelines/hsh-figures.sh, at toy size: its curves and its table say what is known of the bases.
#include <gtest/gtest.h>

#include "file/csv.h"
#include "support/script.h"

namespace phos::test {
namespace {

CsvTable table(const std::string& path) { return parse_csv(slurp(path), path); }

/// The last column of the row that starts so.
double value(const CsvTable& t, const std::vector<std::string>& start, std::size_t column) {
  for (std::size_t r = 0; r < t.rows.size(); ++r)
    if (std::equal(start.begin(), start.end(), t.rows[r].begin())) return t.number(r, column);
  ADD_FAILURE() << t.where << ": no row " << start.front() << " " << start.back();
  return 0;
}

TEST(HshFigures, ToySize) {
  const std::string folder = scratch("pipelines-hsh-figures");
  const std::string sky = data("sky.hdr");
  // A pyramid, with normals of its faces shared.
  spill(folder + "/pyramid.obj",
        "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.2 0\nf 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n");
  const test::Run run = run_script("hsh-figures.sh",
                                   {"out", "pyramid.obj", sky, "--width", "48", "--samples", "1", "--rays",
                                    "256", "--photons", "2000", "--exponent", "8"},
                                   folder);
  ASSERT_EQ(run.code, 0) << run.err;
  const CsvTable errors = table(folder + "/out/errors.csv");
  EXPECT_EQ(errors.rows.size(), 4u);
  const double hsh = value(errors, {"hsh", "open"}, 3), sh = value(errors, {"sh", "open"}, 3);
  EXPECT_GT(hsh, 0);
  EXPECT_LT(hsh, 0.5 * sh);
  EXPECT_LT(sh, 1);
  EXPECT_GT(value(errors, {"hsh", "traced"}, 4), 20);  // dB

  const CsvTable bases = table(folder + "/out/bases.csv");
  const std::string phong = "Phong cos^5", ward = "Ward 0.2 / 0.5";
  EXPECT_NEAR(value(bases, {phong, "cosine", "hsh", "25"}, 4), 0.998, 0.003);
  EXPECT_NEAR(value(bases, {phong, "cosine", "sh", "25"}, 4), 0.933, 0.01);
  EXPECT_NEAR(value(bases, {phong, "none", "hsh", "25"}, 4), 0.966, 0.01);
  EXPECT_GT(value(bases, {ward, "cosine", "hsh", "49"}, 4), value(bases, {ward, "cosine", "sh", "49"}, 4));
  for (const char* name : {"bases-phong.svg", "bases-ward-cosine.svg", "hsh.png", "sh.png", "open.png",
                           "traced.png", "hsh-traced.png"})
    EXPECT_GT(std::filesystem::file_size(folder + "/out/" + name), 500u) << name;
  std::filesystem::remove_all(folder);
}

TEST(HshFigures, SaysHowItIsUsed) {
  const std::string folder = scratch("pipelines-hsh-usage");
  EXPECT_EQ(run_script("hsh-figures.sh", {}, folder).code, 2);
  const test::Run run = run_script("hsh-figures.sh", {"out", "nowhere.obj"}, folder);
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("nowhere.obj"), std::string::npos) << run.err;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace phos::test
