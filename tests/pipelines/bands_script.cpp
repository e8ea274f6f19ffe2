// pipelines/bands.sh, at toy size: a lamp with gaps in its spectrum, paints with spectra, sensors.
#include <gtest/gtest.h>

#include <cmath>

#include "file/csv.h"
#include "image/image.h"
#include "support/script.h"

namespace phos::test {
namespace {

TEST(BandsScript, MakesAPictureAndReadings) {
  const std::string folder = scratch("bands-script");
  spill(folder + "/points.csv", "id,x,y,z,nx,ny,nz\nfloor,0.278,0.001,0.1,0,1,0\nleft,0.5,0.2,0.1,-1,0,0\n");
  const std::vector<std::string> words = {data("cornell-measured.glb"),
                                          "out",
                                          "12",
                                          "--photons",
                                          "20000",
                                          "--rays",
                                          "32",
                                          "--width",
                                          "40",
                                          "--samples",
                                          "1",
                                          "--points",
                                          "points.csv",
                                          "--spectrum",
                                          "light=" + data("spectra/cornell-light.csv"),
                                          "--spectrum",
                                          "white=" + data("spectra/cornell-white.csv"),
                                          "--",
                                          "--seed",
                                          "3"};
  const test::Run run = run_script("bands.sh", words, folder);
  ASSERT_EQ(run.code, 0) << run.err;
  // Cornell's lamp was not measured beyond 700 nm.
  EXPECT_EQ(run.out.find("dark"), std::string::npos) << "the last of 4 triplets begins at 680 nm";
  const Image image = read_image(folder + "/out/cornell-measured.exr");
  EXPECT_EQ(image.width(), 40);
  for (const auto& [name, values] : image.channels())
    for (const float v : values) ASSERT_TRUE(std::isfinite(v)) << name;
  EXPECT_GT(std::filesystem::file_size(folder + "/out/cornell-measured.png"), 0u);
  const std::string path = folder + "/out/cornell-measured-lux.csv";
  const CsvTable table = parse_csv(slurp(path), path);
  ASSERT_EQ(table.rows.size(), 2u);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_GT(table.number(row, table.column("E_lx", "test")), 1);
    EXPECT_GT(table.number(row, table.column("CCT_K", "test")), 1500);
    EXPECT_LT(table.number(row, table.column("CCT_K", "test")), 5000);
  }
  // What is there is kept.
  const auto written = std::filesystem::last_write_time(folder + "/out/triplets/2.photons");
  ASSERT_EQ(run_script("bands.sh", words, folder).code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(folder + "/out/triplets/2.photons"), written);
}

TEST(BandsScript, LeavesDarkTripletsOut) {
  const std::string folder = scratch("bands-script-dark");
  const test::Run run =
      run_script("bands.sh",
                 {data("cornell-measured.glb"), "out", "12", "--photons", "10000", "--rays", "16", "--width",
                  "20", "--spectrum", "light=" + data("spectra/sodium.csv")},
                 folder);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* dark : {"triplet 1 of 4: dark", "triplet 2 of 4: dark", "triplet 4 of 4: dark"})
    EXPECT_NE(run.out.find(dark), std::string::npos) << run.out;
  EXPECT_GT(std::filesystem::file_size(folder + "/out/cornell-measured.exr"), 0u);
}

TEST(BandsScript, IsParticular) {
  const std::string folder = scratch("bands-script-bad");
  EXPECT_EQ(run_script("bands.sh", {}, folder).code, 2);
  EXPECT_EQ(run_script("bands.sh", {data("cornell-measured.glb"), "out", "2"}, folder).code, 2);
  EXPECT_EQ(run_script("bands.sh", {data("cornell-measured.glb"), "out", "many"}, folder).code, 2);
  EXPECT_EQ(run_script("bands.sh", {"none.glb", "out", "12"}, folder).code, 3);
  EXPECT_EQ(run_script("bands.sh", {data("cornell-measured.glb"), "out", "12", "--colour"}, folder).code, 2);
  EXPECT_EQ(run_script("bands.sh",
                       {data("cornell-measured.glb"), "out", "12", "--spectrum", "light=none.csv"}, folder)
                .code,
            3);
}

}  // namespace
}  // namespace phos::test
