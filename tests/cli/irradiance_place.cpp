// phos-irradiance --place: a view whose picture has no misses, and every surface.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/run.h"

namespace phos::test {
namespace {

std::size_t misses(const std::string& folder, const std::string& place) {
  const std::string scene = data("cornell-measured.glb"), photons = folder + "/a.photons",
                    cache = folder + "/" + place + ".irradiance", csv = folder + "/" + place + ".csv";
  EXPECT_EQ(run_tool({"photons", scene, "--photons", "20000", "-o", photons}).code, 0);
  std::vector<std::string> make{"irradiance", scene, photons, "--place", place, "-o", cache};
  if (place == "view") make.insert(make.end(), {"--width", "80"});
  const auto made = run_tool(make);
  EXPECT_EQ(made.code, 0) << made.err;
  const auto drawn = run_tool({"splat", scene, cache, "--width", "80", "--splat", "cpu", "--misses", csv,
                               "-o", folder + "/" + place + ".exr"});
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  const std::string points = slurp(csv);
  return static_cast<std::size_t>(std::count(points.begin(), points.end(), '\n')) - 1;
}

TEST(IrradiancePlace, APictureOfThatViewHasNoMisses) {
  EXPECT_EQ(misses(scratch("irradiance_place"), "view"), 0u);
}

TEST(IrradiancePlace, ByErrorIsOfGatheredRecordsAndTheSameForAnyNumberOfThreads) {
  const std::string folder = scratch("irradiance_by_error"), scene = data("cube-in-a-box.glb");
  const std::string photons = folder + "/a.photons";
  ASSERT_EQ(run_tool({"photons", scene, "--photons", "20000", "-o", photons}).code, 0);
  const auto make = [&](const std::string& estimate, const std::string& threads, const std::string& name) {
    return run_tool({"irradiance", scene, photons, "--estimate", estimate, "--rays", "27", "--place",
                     "surface", "--placement-error", "0.1", "--threads", threads, "-o", folder + "/" + name});
  };
  const auto refused = make("hull", "1", "hull");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--placement-error"), std::string::npos) << refused.err;
  const auto one = make("gather", "1", "one"), two = make("gather", "2", "two");
  ASSERT_EQ(one.code, 0) << one.err;
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_TRUE(slurp(folder + "/one") == slurp(folder + "/two"));
}

TEST(IrradiancePlace, OnSurfacesHardlyAny) { EXPECT_LE(misses(scratch("irradiance_place"), "surface"), 5u); }

}  // namespace
}  // namespace phos::test
