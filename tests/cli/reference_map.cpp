// phos-reference --method final-gather and photons: what they read, refuse, say and record.
#include <gtest/gtest.h>

#include <filesystem>

#include "image/image.h"
#include "support/cornell_photons.h"
#include "support/gltf.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;

const std::string kBox = data("cornell-measured.glb");

class ReferenceMap : public testing::Test {
 protected:
  static const std::string& folder() {
    static const std::string made = folder_with_photons("reference-map", "20000");
    return made;
  }
  static std::string photons() { return folder() + "/c.photons"; }
  static std::string out() { return folder() + "/x.exr"; }

  /// Of a picture with the photons and these words.
  static void expect_picture_refused(const std::vector<std::string>& words, int code,
                                     const std::string& says) {
    std::vector<std::string> all{kBox, photons(), "-o", out()};
    all.insert(all.end(), words.begin(), words.end());
    expect_refused("reference", all, code, says);
    EXPECT_FALSE(std::filesystem::exists(out()));
  }
};

TEST_F(ReferenceMap, RefusesWhatAMethodCannotDo) {
  expect_refused("reference", {kBox, "--method", "final-gather", "-o", out()}, 2, "phos-photons makes it");
  expect_refused("reference", {kBox, "--method", "photons", "-o", out()}, 2, "phos-photons makes it");
  expect_refused("reference", {photons(), "--method", "photons", "-o", out()}, 2, "no scene");
  expect_refused("reference", {kBox, "--gather-rays", "4", "-o", out()}, 2, "--gather-rays");
  expect_refused("reference", {kBox, "--photons-in-disc", "40", "-o", out()}, 2, "--photons-in-disc");
  for (const char* method : {"path", "bidirectional", "auto"})
    expect_picture_refused({"--method", method}, 2, "is not read by");
  expect_picture_refused({photons(), "--method", "photons"}, 2, "second");
  expect_picture_refused({kBox, "--method", "photons"}, 2, "second scene");
  expect_picture_refused({"--method", "photons", "--gather-rays", "4"}, 2, "--gather-rays");
  expect_picture_refused({"--method", "photons", "--photons-in-disc", "1"}, 2, "--photons-in-disc");
  expect_picture_refused({"--method", "final-gather", "--gather-rays", "0"}, 2, "--gather-rays");
  expect_picture_refused({"--method", "photons", "--error", "0.1"}, 2, "--error");
  for (const char* method : {"photons", "final-gather"}) {
    expect_picture_refused({"--method", method, "--bounces", "2"}, 2, "--bounces");
    expect_picture_refused({"--method", method, "--black-emitters"}, 2, "--black-emitters");
  }
  expect_refused("reference",
                 {kBox, photons(), "--method", "photons", "--frames", "0:1", "-o", folder() + "/x%02d.exr"},
                 2, "--frames");
  expect_refused("sense", {kBox, "--exact", "--method", "photons", "--grid", "1", "--height", "0.1"}, 2,
                 "photons");
}

TEST_F(ReferenceMap, RefusesBadPhotons) {
  const std::string other = data("cornell-empty.glb"), cut = folder() + "/cut.photons";
  expect_refused("reference", {other, photons(), "--method", "photons", "-o", out()}, 4, "another scene");
  expect_refused("reference", {kBox, folder() + "/none.photons", "--method", "photons", "-o", out()}, 3,
                 "none.photons");
  spill(cut, slurp(photons()).substr(0, 50'000));
  expect_refused("reference", {kBox, cut, "--method", "photons", "-o", out()}, 3, "cut.photons");
  const std::string records = folder() + "/c.irradiance";
  ASSERT_EQ(run_tool({"irradiance", kBox, photons(), "-o", records}).code, 0);
  expect_refused("reference", {kBox, records, "--method", "photons", "-o", out()}, 3, "c.irradiance");
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(ReferenceMap, TakesPhotonsOfAnotherSceneWhereAsked) {
  const std::string file = folder() + "/mismatch.exr";
  EXPECT_EQ(run_tool({"reference", data("cornell-empty.glb"), photons(), "--method", "photons", "--width",
                      "8", "--samples", "1", "--allow-mismatch", "-o", file})
                .code,
            0);
}

TEST_F(ReferenceMap, RefusesPointsThatHaveNoPhotons) {
  const std::string points = folder() + "/air.csv";
  spill(points, "0.45,0.0001,0.1,0,1,0\n0.45,0.2,0.1,0,1,0\n");
  expect_refused("reference", {kBox, photons(), "--method", "photons", "--points", points}, 3,
                 "point 2 lies on no surface");
  // Gathering reads none there: the box has no caustic light.
  EXPECT_EQ(run_tool({"reference", kBox, photons(), "--method", "final-gather", "--points", points,
                      "--samples", "64"})
                .code,
            0);
}

TEST_F(ReferenceMap, SameBytesOnAnyNumberOfThreadsAndInAnyOrder) {
  for (const char* method : {"photons", "final-gather"}) {
    std::string first;
    for (const char* threads : {"1", "2"}) {
      const bool photons_first = threads[0] == '2';
      const std::string file = folder() + "/" + method + threads + ".exr";
      const test::Run run = run_tool({"reference", photons_first ? photons() : kBox,
                                      photons_first ? kBox : photons(), "--method", method, "--width", "24",
                                      "--samples", "4", "--illuminance", "--threads", threads, "-o", file});
      ASSERT_EQ(run.code, 0) << run.err;
      EXPECT_NE(run.err.find("the standard error of --method"), std::string::npos) << run.err;
      if (first.empty()) first = slurp(file);
      EXPECT_EQ(slurp(file), first) << method;
    }
    const Image image = read_image(folder() + "/" + method + "1.exr");
    for (const auto& [name, values] : image.channels())
      for (const float v : values) ASSERT_TRUE(std::isfinite(v)) << name;
    for (const char* layer : {"direct", "indirect", "stderr"}) EXPECT_TRUE(image.has_layer(layer)) << layer;
    EXPECT_EQ(image.channels().count("illuminance.Y"), 1u) << method;
    EXPECT_NE(image.attributes.at("phos.command").find("--photons-in-disc 100"), std::string::npos);
    EXPECT_NE(image.attributes.at("phos.error_of").find("blur"), std::string::npos);
  }
}

TEST_F(ReferenceMap, ReusesWhatIsThere) {
  const std::string file = folder() + "/reuse.exr";
  std::vector<std::string> command{"reference", kBox,        photons(), "--method", "photons", "--width",
                                   "8",         "--samples", "1",       "-o",       file,      "--reuse"};
  ASSERT_EQ(run_tool(command).code, 0);
  EXPECT_NE(run_tool(command).err.find("up to date"), std::string::npos);
  command.insert(command.end(), {"--photons-in-disc", "50"});
  EXPECT_EQ(run_tool(command).err.find("up to date"), std::string::npos);
}

TEST_F(ReferenceMap, SaysThatAMapHasFewPhotons) {
  const std::string few = folder() + "/few.photons";
  ASSERT_EQ(run_tool({"photons", kBox, "--photons", "20", "-o", few}).code, 0);
  const test::Run run = run_tool({"reference", kBox, few, "--method", "photons", "--width", "8", "--samples",
                                  "1", "-o", folder() + "/few.exr"});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find("fewer than --photons-in-disc 100"), std::string::npos) << run.err;
}

/// A grey floor, a wall of this material and a point lamp.
std::string room(const Json& wall) {
  const auto words = [](const Json::Array& values) -> Json { return values; };
  Gltf g;
  Json grey, lamp, lamps, node, camera, eye;
  grey["name"] = "grey", grey["extras"]["phos"]["brdf"] = "lambert";
  grey["extras"]["phos"]["kd"] = words({0.5, 0.5, 0.5});
  const auto place = [&](int square, const Json::Array& at, const Json::Array& turn) {
    Json::Array nodes = g.json.find("nodes")->as_array();
    Json& n = nodes[static_cast<std::size_t>(square)];
    n["translation"] = words(at), n["rotation"] = words(turn), n["scale"] = words({4, 4, 4});
    g.json["nodes"] = nodes;
  };
  place(g.square_node(grey), {-2, 0, 2}, {-0.70710678, 0, 0, 0.70710678});
  place(g.square_node(wall), {-2, 0, -2}, {0, 0, 0, 1});
  lamp["type"] = "point", lamp["name"] = "bulb", lamp["intensity"] = 100;
  lamps["lights"] = words({lamp});
  g.json["extensions"]["KHR_lights_punctual"] = lamps;
  g.json["extensionsUsed"] = words({"KHR_lights_punctual"});
  node["name"] = "bulb", node["translation"] = words({0, 1.5, 0});
  node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  g.node(node);
  camera["type"] = "perspective", camera["perspective"]["yfov"] = 0.8, camera["perspective"]["znear"] = 0.1;
  g.json["cameras"] = words({camera});
  eye["camera"] = 0, eye["translation"] = words({0, 1.5, 4});
  g.node(eye);
  return g.bytes();
}

/// A room with its photons, and the command of a small picture of it.
std::vector<std::string> picture_of(const std::string& name, const Json& wall, const std::string& method) {
  const std::string folder = scratch(name);
  spill(folder + "/room.glb", room(wall));
  EXPECT_EQ(
      run_tool({"photons", folder + "/room.glb", "--photons", "20000", "-o", folder + "/room.photons"}).code,
      0);
  return {"reference",
          folder + "/room.glb",
          folder + "/room.photons",
          "--method",
          method,
          "--width",
          "16",
          "--samples",
          "4",
          "-o",
          folder + "/x.exr"};
}

TEST(ReferenceMapGloss, StatesNoErrorWhereFewPhotonsAreInALobe) {
  Json steel;
  steel["name"] = "steel", steel["extras"]["phos"]["brdf"] = "conductor";
  steel["extras"]["phos"]["ks"] = Json::Array{0.9, 0.9, 0.9};
  steel["extras"]["phos"]["ax"] = 0.02, steel["extras"]["phos"]["ay"] = 0.02;
  std::vector<std::string> command = picture_of("reference-map-steel", steel, "photons");
  const test::Run run = run_tool(command);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("the gloss of material \"steel\""), std::string::npos) << run.err;
  EXPECT_FALSE(read_image(command.back()).has_layer("stderr"));
  std::filesystem::remove(command.back());
  command.push_back("--strict");
  EXPECT_EQ(run_tool(command).code, 5);
  EXPECT_FALSE(std::filesystem::exists(command[command.size() - 2]));
}

TEST(ReferenceMapGloss, FollowsMirrorsAndHasNoIlluminanceOnThem) {
  Json mirror;
  mirror["name"] = "silver", mirror["extras"]["phos"]["brdf"] = "mirror";
  mirror["extras"]["phos"]["ks"] = Json::Array{0.9, 0.9, 0.9};
  for (const char* method : {"photons", "final-gather"}) {
    std::vector<std::string> command = picture_of("reference-map-mirror", mirror, method);
    const test::Run run = run_tool(command);
    ASSERT_EQ(run.code, 0) << run.err;
    const Image image = read_image(command.back());
    ASSERT_TRUE(image.has_layer("specular")) << method;
    EXPECT_TRUE(image.has_layer("stderr")) << method;
    command.push_back("--illuminance");
    command.erase(command.begin());
    expect_refused("reference", command, 2, "silver");
  }
}

}  // namespace
