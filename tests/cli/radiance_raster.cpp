// phos-radiance --estimate raster at the command line.
#include <gtest/gtest.h>

#include <cmath>

#include "file/container.h"
#include "support/run.h"

namespace phos::test {
namespace {

Run radiance(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"radiance", data("cornell-glossy22.glb"), "--gather-bounces", "1"});
  arguments.insert(arguments.end(), {"--place", "surface", "--min-radius", "0.15", "--store", "float"});
  return run_tool(arguments);
}

double mean_light(const Container& file) {
  const std::size_t n = file.vectors("position").size();
  const auto count =
      static_cast<std::uint64_t>(std::pow(file.provenance().extra.find("order")->as_integer(), 2));
  const auto light = file.values<float>("coefficients", {n, 3, count});
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(light[i * 3 * count]);
  return sum / static_cast<double>(n);
}

TEST(RadianceRaster, SameBytesOnAnyNumberOfThreadsAndTheLightOfRays) {
  const std::string folder = scratch("radiance-raster");
  std::string bytes;
  for (const char* threads : {"1", "3"}) {
    const std::string out = folder + "/" + threads;
    const test::Run run =
        radiance({"--estimate", "raster", "--raster-side", "32", "--threads", threads, "-o", out});
    ASSERT_EQ(run.code, 0) << run.err;
    if (bytes.empty()) bytes = slurp(out);
    EXPECT_EQ(slurp(out), bytes) << threads;
  }
  ASSERT_EQ(radiance({"--rays", "1024", "-o", folder + "/rays"}).code, 0);
  const Container drawn = Container::open(folder + "/1", FileKind::radiance),
                  gathered = Container::open(folder + "/rays", FileKind::radiance);
  EXPECT_EQ(drawn.provenance().parameters.find("estimate")->as_string(), "raster");
  EXPECT_EQ(drawn.provenance().parameters.find("raster-side")->as_integer(), 32);
  EXPECT_EQ(gathered.provenance().parameters.find("raster-side"), nullptr);
  EXPECT_NEAR(mean_light(drawn) / mean_light(gathered), 1, 0.1);
}

TEST(RadianceRaster, RecordsAddedToAFileAreDrawnAlike) {
  const std::string folder = scratch("radiance-raster-add"), first = folder + "/a", grown = folder + "/b";
  ASSERT_EQ(
      radiance({"--estimate", "raster", "--raster-side", "16", "--max-radius", "0.5", "-o", first}).code, 0);
  const test::Run run = radiance({"--add-to", first, "-o", grown});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json parameters = Container::open(grown, FileKind::radiance).provenance().parameters;
  EXPECT_EQ(parameters.find("estimate")->as_string(), "raster");
  EXPECT_EQ(parameters.find("raster-side")->as_integer(), 16);
}

/// Shadow maps instead of shadow rays: recorded, the same bytes on any number of threads, and about the
/// light.
TEST(RadianceRaster, LitByShadowMaps) {
  const std::string folder = scratch("radiance-raster-maps");
  std::string bytes;
  for (const char* threads : {"1", "3"}) {
    const std::string out = folder + "/" + threads;
    const test::Run run = radiance({"--estimate", "raster", "--raster-side", "32", "--raster-light",
                                    "shadow-map", "--threads", threads, "-o", out});
    ASSERT_EQ(run.code, 0) << run.err;
    if (bytes.empty()) bytes = slurp(out);
    EXPECT_EQ(slurp(out), bytes) << threads;
  }
  const std::string traced = folder + "/traced";
  ASSERT_EQ(radiance({"--estimate", "raster", "--raster-side", "32", "-o", traced}).code, 0);
  const Container mapped = Container::open(folder + "/1", FileKind::radiance),
                  by_rays = Container::open(traced, FileKind::radiance);
  EXPECT_EQ(mapped.provenance().parameters.find("raster-light")->as_string(), "shadow-map");
  EXPECT_EQ(by_rays.provenance().parameters.find("raster-light"), nullptr);
  EXPECT_NEAR(mean_light(mapped) / mean_light(by_rays), 1, 0.05);
}

}  // namespace
}  // namespace phos::test
