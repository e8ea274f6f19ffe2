// Light that the records of a film do not hold: noted in the film, and told by what reads it.
#include <gtest/gtest.h>

#include "file/container.h"
#include "support/filmed_slabs.h"

namespace phos::test {
namespace {

/// Two slabs, the lamp between them, and a tray of smooth steel that throws its light upwards: from frame
/// `from` on, where it lies beneath the floor before.
std::string with_steel_from(int from, const std::string& name) {
  Slabs slabs;
  Json steel;
  steel["name"] = "steel", steel["extras"]["phos"]["brdf"] = "conductor";
  steel["extras"]["phos"]["ks"] = Json::Array{0.9, 0.9, 0.9};
  steel["extras"]["phos"]["ax"] = steel["extras"]["phos"]["ay"] = 0.01;
  const int tray = slabs.slab("tray", 1, 0, 0.2f, 0, steel);
  if (from > 0)
    slabs.animate(tray, "translation", {0, static_cast<float>(from)}, {0, -3, 0, 0, 0.2f, 0}, "STEP");
  else
    slabs.animate("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 16}, {20, 100});
  return slabs.write(name, 17);
}

const std::string kTold = "reaches surfaces by way of gloss of \"steel\"";

test::Run sense(const std::string& scene, const std::string& film) {
  const std::string folder = scratch("unsampled-sense");
  spill(folder + "/p.csv", "x,y,z,nx,ny,nz\n0.3,2,0.2,0,-1,0\n");
  return run_tool({"sense", scene, film, "--frame", "2", "--points", folder + "/p.csv"});
}

TEST(TemporalUnsampled, FilmsPassItOn) {
  const std::string scene = with_steel_from(0, "unsampled-film"), folder = scratch("unsampled-film-out");
  for (const char* estimate : {"gather", "raster"}) {
    const std::string film = folder + "/" + estimate + ".irradiance";
    const std::vector<std::string> asked =
        quick({scene, "--frames", "0:4", "--estimate", estimate, "-o", film});
    std::vector<std::string> strict = asked;
    strict.push_back("--strict");
    const test::Run refused = temporal(strict);
    EXPECT_EQ(refused.code, 5) << refused.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder) || !std::filesystem::exists(film));
    const test::Run made = temporal(asked);
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find(kTold), std::string::npos) << made.err;
    EXPECT_TRUE(Container::open(film, FileKind::irradiance).has("birth"));
    EXPECT_NE(Container::open(film).provenance().extra.find("unsampled"), nullptr);
    const test::Run read = sense(scene, film);
    ASSERT_EQ(read.code, 0) << read.err;
    EXPECT_NE(read.err.find(estimate + std::string(".irradiance: lamp")), std::string::npos) << read.err;
    EXPECT_NE(read.err.find("which its records do not hold"), std::string::npos) << read.err;
  }
}

TEST(TemporalUnsampled, PhotonsHoldIt) {
  const std::string scene = with_steel_from(0, "unsampled-hull"),
                    film = scratch("unsampled-hull-out") + "/f.irradiance";
  const test::Run made =
      temporal(quick({scene, "--frames", "0:4", "--estimate", "hull", "--strict", "-o", film}));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(Container::open(film).provenance().extra.find("unsampled"), nullptr);
}

// What comes into the light in the middle of the film, and a film in which no light changes.
TEST(TemporalUnsampled, AtAnyFrame) {
  const std::string scene = with_steel_from(3, "unsampled-late"), folder = scratch("unsampled-late-out"),
                    film = folder + "/f.irradiance";
  const auto noted = [&](const char* frames) {
    const test::Run made = temporal(quick({scene, "--frames", frames, "-o", film}));
    EXPECT_EQ(made.code, 0) << made.err;
    const bool note = Container::open(film).provenance().extra.find("unsampled") != nullptr;
    EXPECT_EQ(made.err.find(kTold) != std::string::npos, note) << made.err;
    return note;
  };
  EXPECT_FALSE(noted("0:2")) << "the tray lies beneath the floor";
  EXPECT_TRUE(noted("0:4")) << "a film of two shots";
  EXPECT_TRUE(noted("4:6")) << "an ordinary cache";
  EXPECT_FALSE(Container::open(film).has("birth"));
}

}  // namespace
}  // namespace phos::test
