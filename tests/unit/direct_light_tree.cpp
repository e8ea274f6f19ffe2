// The hierarchy of lamps: nobody is left out, and probabilities are the ones stated.
#include <gtest/gtest.h>

#include "core/error.h"
#include "direct/direct_light.h"
#include "direct/light_cut.h"
#include "support/luminaires.h"
#include "support/many_lamps.h"

namespace phos::test {
namespace {

/// Points, spots that look any way, and one-sided panels, in a box of 8 m; many spots look down as downlights
/// do.
Scene lamps_any_way(int number) {
  Scene scene;
  begin_instance(scene, "walls", add_lambert(scene, "grey", 0.5f));
  add_room(scene, Vec3(0), Vec3(8));
  const std::uint32_t shine = add_lambert(scene, "light", 0, 1000);
  for (int i = 0; i < number; ++i) {
    RandomStream random(7, Stage::test, static_cast<std::uint64_t>(i));
    const Vec3 p = Vec3(1) + 6.f * Vec3(random.uniform(), random.uniform(), random.uniform());
    const Vec3 towards = glm::normalize(Vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5f);
    if (i % 4 == 0) {
      begin_instance(scene, "panel", shine);
      const Frame frame = make_frame(towards);
      add_quad(scene, p, 0.2f * frame.x, 0.2f * frame.y);
      continue;
    }
    if (i % 8 == 1) {
      hang(scene, luminaire(i % 16 == 1 ? lopsided() : lambertian(100)), p);
      continue;
    }
    if (i % 8 == 2) {
      hang(scene, luminaire(lambertian(100), {LuminousOpening::Form::box, {0.6, 0.3, 0}}), p);
      continue;
    }
    Light light;
    light.kind = i % 4 == 1 ? Light::Kind::point : Light::Kind::spot;
    light.name = "lamp", light.position = p, light.direction = i % 4 == 2 ? towards : Vec3(0, -1, 0);
    light.intensity = Rgb(10 + 100 * random.uniform());
    light.cos_inner = 0.9, light.cos_outer = 0.6;
    scene.light.push_back(light);
  }
  finalize(scene);
  return scene;
}

struct Place {
  Vec3 p, n;
};
const Place kPlaces[] = {
    {{0.5f, 0, 0.5f}, {0, 1, 0}}, {{4, 4, 4}, {1, 0, 0}}, {{4, 4, 4}, {0, -1, 0}}, {{0, 7, 3}, {1, 0, 0}}};

bool may_light(const Luminaires& lights, std::size_t i, const SurfacePoint& at) {
  for (int k = 0; k < 64; ++k) {
    Illumination light;
    RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
    if (!lights.illuminate(i, at.position, random.uniform(), random.uniform2(), light)) continue;
    if (glm::dot(at.normal, light.direction) > 0 && max_component(light.value) > 0) return true;
  }
  return false;
}

TEST(LightTree, LeavesOutNobodyWhoCouldShine) {
  const Scene scene = lamps_any_way(400);
  const Luminaires lights(scene);
  const LightTree tree(scene, lights);
  EXPECT_EQ(tree.lamps(), lights.size());
  for (const Place& place : kPlaces) {
    const SurfacePoint at = receiver(scene, place.p, place.n);
    double sum = 0;
    std::size_t none = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const double probability = tree.probability(at, i);
      sum += probability, none += probability == 0;
      EXPECT_TRUE(probability > 0 || !may_light(lights, i, at)) << i;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_GT(none, lights.size() / 20);  // those that look away
  }
}

TEST(LightTree, ChoosesWithTheProbabilityThatItStates) {
  const Scene scene = lamps_any_way(60);
  const Luminaires lights(scene);
  const LightTree tree(scene, lights);
  for (const Place& place : kPlaces) {
    const SurfacePoint at = receiver(scene, place.p, place.n);
    constexpr int kSteps = 1 << 15;
    std::vector<double> chosen(lights.size(), 0);
    for (int i = 0; i < kSteps; ++i) {
      const LightTree::Choice choice = tree.choose(LightTree::root(), at, (i + 0.5) / kSteps);
      chosen[choice.light] += 1.0 / kSteps;
      EXPECT_NEAR(choice.probability, tree.probability(at, choice.light), 1e-9);
      ASSERT_GE(choice.rest, 0);
      ASSERT_LT(choice.rest, 1);
    }
    for (std::size_t i = 0; i < lights.size(); ++i)
      EXPECT_NEAR(chosen[i], tree.probability(at, i), 2.0 / kSteps);
  }
}

/// Every lamp that could light the point is below one node of a cut, and no other is.
TEST(LightTree, CutsHoldEachLampOnce) {
  const Scene scene = lamps_any_way(300);
  const Luminaires lights(scene);
  const LightTree tree(scene, lights);
  for (const Place& place : kPlaces) {
    const SurfacePoint at = receiver(scene, place.p, place.n);
    for (const std::size_t nodes : {1, 2, 7, 50, 10000}) {
      const std::vector<CutNode> cut = light_cut(tree, at, nodes);
      EXPECT_LE(cut.size(), nodes);
      std::vector<int> times(lights.size(), 0);
      for (const CutNode& c : cut) {
        std::vector<LightTree::Index> open{c.node};
        while (!open.empty()) {
          const LightTree::Index node = open.back();
          open.pop_back();
          if (tree.is_leaf(node))
            ++times[tree.light(node)];
          else
            open.push_back(tree.first_child(node)), open.push_back(tree.first_child(node) + 1);
        }
      }
      for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_LE(times[i], 1);
        EXPECT_TRUE(times[i] == 1 || !may_light(lights, i, at)) << i << " of " << nodes;
      }
    }
  }
}

/// Of one lamp without area, the importance is its illuminance.
TEST(LightTree, ALeafIsExact) {
  const Scene scene = hall_of_lamps(1, false);
  const Luminaires lights(scene);
  const LightTree tree(scene, lights);
  const Vec3 p(7, 0, 3);
  EXPECT_NEAR(tree.importance_lx(LightTree::root(), receiver(scene, p, {0, 1, 0})) / open_hall_lx(scene, p),
              1, 1e-6);
  EXPECT_TRUE(tree.is_leaf(LightTree::root()));
}

}  // namespace
}  // namespace phos::test
