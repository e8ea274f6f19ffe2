// phos-picture --discs on what phos-brdf wrote.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/refused.h"

namespace phos::test {
namespace {

TEST(BrdfDiscs, PicturesOfTablesAndHarmonics) {
  const std::string f = scratch("discs"), brdf = f + "/l.brdf";
  ASSERT_EQ(run_tool({"brdf", data("lobes.gltf"), "--resolution", "8", "--quiet", "-o", brdf}).code, 0);
  std::string before;
  for (const char* which : {"error", "order", "harmonics"}) {
    const std::string png = f + "/" + which + ".png";
    const test::Run run = run_tool({"picture", "--discs", which, brdf, "-o", png});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string bytes = slurp(png);
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_NE(bytes, before) << which;
    before = bytes;
  }
  ASSERT_EQ(run_tool({"picture", "--discs", "error", brdf, "--threads", "1", "-o", f + "/one.png"}).code, 0);
  EXPECT_EQ(slurp(f + "/one.png"), slurp(f + "/error.png"));
  expect_refused("picture", {brdf, "-o", f + "/b.png"}, 2, "pass --discs");
  expect_refused("picture", {"--discs", "error", brdf, "-o", f + "/b.svg"}, 2, "must end in .png");
  expect_refused("picture", {"--discs", "error", brdf, "--false-colour", "-o", f + "/b.png"}, 2,
                 "is for images");
  expect_refused("picture", {"--discs", "error", brdf, "--goniometric", "-o", f + "/b.png"}, 2,
                 "leave one out");
  expect_refused("picture", {"--discs", "error", data("sky.hdr"), "-o", f + "/b.png"}, 3, "sky.hdr");
  const std::string photons = f + "/p.photons";
  ASSERT_EQ(
      run_tool({"photons", data("cornell-empty.glb"), "--photons", "100", "--quiet", "-o", photons}).code, 0);
  expect_refused("picture", {"--discs", "error", photons, "-o", f + "/b.png"}, 3, "holds photons");
  const std::string none = f + "/none.brdf";
  ASSERT_EQ(run_tool({"brdf", data("cornell-empty.glb"), "--quiet", "-o", none}).code, 0);
  expect_refused("picture", {"--discs", "error", none, "-o", f + "/b.png"}, 3, "holds no table");
  EXPECT_FALSE(std::filesystem::exists(f + "/b.png"));
  std::filesystem::remove_all(f);
}

}  // namespace
}  // namespace phos::test
