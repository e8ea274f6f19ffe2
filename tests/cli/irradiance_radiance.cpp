// Radiance records among the inputs of phos-irradiance: what they cover, and what may be given with them.
#include <gtest/gtest.h>

#include <cmath>

#include "file/container.h"
#include "support/run.h"

namespace phos::test {
namespace {

std::string scene() { return data("cornell-glossy22.glb"); }

/// Photons of the Cornell box whose back wall is glossy, and radiance records on that, made once.
const std::string& folder() {
  static const std::string path = [] {
    const std::string f = scratch("irradiance-radiance");
    EXPECT_EQ(run_tool({"photons", scene(), "--photons", "20000", "-o", f + "/c.photons"}).code, 0);
    EXPECT_EQ(run_tool({"radiance", scene(), f + "/c.photons", "--rays", "64", "--min-radius", "0.1", "-o",
                        f + "/c.radiance"})
                  .code,
              0);
    return f;
  }();
  return path;
}
std::string photons() { return folder() + "/c.photons"; }
std::string radiance() { return folder() + "/c.radiance"; }

Run irradiance(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "irradiance");
  return run_tool(arguments);
}

struct Count {
  std::size_t on_wall = 0, elsewhere = 0;
};
Count records_in(const std::string& path) {
  Count count;
  const Container file = Container::open(path, FileKind::irradiance);
  for (const Vec3& p : file.vectors("position"))
    ++(std::fabs(p.z - 0.5592f) < 1e-3f ? count.on_wall : count.elsewhere);
  return count;
}

TEST(IrradianceBesideRadiance, WhatRadianceRecordsCoverGetsNoOther) {
  const std::string alone = folder() + "/alone.irradiance", beside = folder() + "/beside.irradiance";
  ASSERT_EQ(irradiance({scene(), photons(), "-o", alone}).code, 0);
  const auto run = irradiance({radiance(), photons(), scene(), "-o", beside, "--threads", "2"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Count all = records_in(alone), fewer = records_in(beside);
  EXPECT_GT(all.on_wall, 10u);
  EXPECT_LT(fewer.on_wall, all.on_wall / 5);
  EXPECT_GT(fewer.elsewhere, all.elsewhere / 2);
  EXPECT_TRUE(Container::open(beside).provenance().inputs.contains("gloss"));
  const std::string again = folder() + "/again.irradiance";
  ASSERT_EQ(irradiance({scene(), radiance(), photons(), "-o", again, "--threads", "1"}).code, 0);
  EXPECT_EQ(slurp(again), slurp(beside));
  // Records that hold direct light too are not covered by those that do not.
  const std::string whole = folder() + "/whole.irradiance";
  ASSERT_EQ(irradiance({scene(), photons(), radiance(), "--paths", "all", "-o", whole}).code, 0);
  EXPECT_GT(records_in(whole).on_wall, 10u);
}

TEST(IrradianceBesideRadiance, RecordsOfTheFileAddedToStay) {
  const std::string one = folder() + "/one.irradiance", more = folder() + "/more.irradiance";
  ASSERT_EQ(irradiance({scene(), photons(), "--max-candidates", "20", "-o", one}).code, 0);
  ASSERT_EQ(irradiance({scene(), photons(), radiance(), "--add-to", one, "-o", more}).code, 0);
  const Container before = Container::open(one), after = Container::open(more);
  const auto kept = before.vectors("position"), all = after.vectors("position");
  ASSERT_LT(kept.size(), all.size());
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), all.begin()));
}

TEST(IrradianceBesideRadiance, RaysReadThem) {
  const std::string out = folder() + "/rays.irradiance";
  const std::vector<std::string> few{"--estimate", "gather", "--rays", "64", "--max-candidates", "100"};
  std::vector<std::string> arguments{scene(), photons(), radiance(), "-o", out};
  arguments.insert(arguments.end(), few.begin(), few.end());
  const auto run = irradiance(arguments);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_GT(records_in(out).elsewhere, 10u);
}

TEST(IrradianceBesideRadiance, WrongInputs) {
  const auto expect_failure = [](const test::Run& run, int code, const std::string& word) {
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  };
  const std::string out = folder() + "/wrong.irradiance";
  expect_failure(irradiance({scene(), photons(), radiance(), radiance(), "-o", out}), 2, "second");
  const std::string other = folder() + "/other.photons", box = data("cornell-measured.glb");
  ASSERT_EQ(run_tool({"photons", box, "--photons", "1000", "-o", other}).code, 0);
  expect_failure(irradiance({box, other, radiance(), "-o", out}), 4, "c.radiance");
  EXPECT_EQ(irradiance({box, other, radiance(), "--allow-mismatch", "-o", out}).code, 0);
}

}  // namespace
}  // namespace phos::test
