// Lamps that shine alone: the others are dark, and nothing else is another.
#include <gtest/gtest.h>

#include "scene/lamp/shine_only.h"
#include "support/complaint.h"
#include "support/environment.h"
#include "support/scenes.h"

namespace phos {
namespace {

using namespace test;

/// Two emitting sheets of one material and two points over a floor, under a sky; not finalized.
Scene lamps() {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
  const std::uint32_t bright = add_lambert(scene, "bright", 0.2f, 100);
  for (const float x : {0.f, 1.f}) {
    begin_instance(scene, x == 0 ? "near" : "far", bright);
    add_quad(scene, {x, 2, 0}, {0.5f, 0, 0}, {0, 0, 1});
  }
  add_point_light(scene, {1, 1, 1}, 10), add_point_light(scene, {1, 1, 2}, 20);
  scene.environment = std::make_shared<const Environment>(constant_map(2, Rgb(1)));
  return scene;
}

Scene lit_by(const std::string& names) {
  Scene scene = lamps();
  if (!names.empty()) shine_only(scene, names);
  finalize(scene);
  return scene;
}

double flux_lm(const Scene& scene) {
  double sum = 0;
  for (const Light& light : scene.light) sum += static_cast<double>(luminance(light.flux_lm));
  return sum;
}

TEST(Lamps, AreNamed) {
  const std::vector<std::string> names{"environment", "far", "lamp 0", "lamp 1", "near"};
  EXPECT_EQ(lamp_names(lamps()), names);
  EXPECT_EQ(lamp_names(lit_by("")), names);
}

TEST(Lamps, ThatAreNamedShine) {
  const Scene scene = lit_by("far,lamp 1");
  ASSERT_EQ(scene.light.size(), 2u);
  EXPECT_EQ(scene.light[0].name, "lamp 1");
  EXPECT_EQ(scene.light[1].name, "far");
  EXPECT_EQ(scene.environment, nullptr);
  const Scene all = lit_by("");
  ASSERT_EQ(scene.instance.size(), all.instance.size());
  EXPECT_EQ(scene.position, all.position);
  for (std::size_t i = 0; i < all.instance.size(); ++i) {
    const Material &now = scene.material[scene.instance[i].material],
                   &then = all.material[all.instance[i].material];
    EXPECT_EQ(now.kd, then.kd) << all.instance[i].node;
    EXPECT_EQ(now.emits(), all.instance[i].node == "far");
  }
  EXPECT_NE(scene.hash, all.hash);
}

TEST(Lamps, OfDisjointGroupsAddUp) {
  const double all = flux_lm(lit_by(""));
  EXPECT_NEAR(flux_lm(lit_by("near,lamp 0")) + flux_lm(lit_by("far")) + flux_lm(lit_by("lamp 1,environment")),
              all, 1e-5 * all);
  EXPECT_EQ(lit_by("near,far,lamp 0,lamp 1,environment").hash, lit_by("").hash);
}

TEST(Lamps, ThatAreUnknownAreRefused) {
  Scene scene = lamps();
  const std::string said = complaint_of([&] { shine_only(scene, "near,lamp 3"); }, ExitCode::usage);
  EXPECT_NE(said.find("--lamps: there is no lamp \"lamp 3\"; did you mean \"lamp 0\"?"), std::string::npos)
      << said;
  EXPECT_NE(said.find("\"near\""), std::string::npos) << said;
}

TEST(Lamps, HaveIndicesByName) {
  const Scene scene = lit_by("");  // the environment comes after the points
  EXPECT_EQ(lamps_named(scene, "near"), std::vector<std::uint32_t>{3});
  EXPECT_EQ(lamps_named(scene, "lamp 1,environment,none"), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(lamps_named(scene, "").size(), 5u);
}

}  // namespace
}  // namespace phos
