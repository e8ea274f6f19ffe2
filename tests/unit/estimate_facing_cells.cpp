// Cells that know which ways photons face: a "no" is certain, and is said where a search would be long.
#include <gtest/gtest.h>

#include "core/random.h"
#include "estimate/zone/facing_cells.h"
#include "support/landed.h"

namespace phos::test {
namespace {

Vec3 some_direction(RandomStream& random) {
  const Vec3 v(random.uniform() - 0.5f, random.uniform() - 0.5f, random.uniform() - 0.5f);
  return glm::normalize(glm::length(v) > 0.01f ? v : Vec3(0, 1, 0));
}

/// As ZoneGatherer asks.
bool holds(const PhotonMap& map, const ZonePlace& place, float radius_m) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Vec3 local = place.frame.to_local(map.position[i] - place.p);
    if (local.z <= place.above_m && local.z >= -place.below_m &&
        local.x * local.x + local.y * local.y < radius_m * radius_m &&
        glm::dot(decode_octahedral(map.normal[i]), place.frame.z) >= kSameFacing)
      return true;
  }
  return false;
}

ZonePlace place_at(const Vec3& p, const Vec3& n, float radius_m) {
  ZonePlace place{p, make_frame(n), 1e-6f};
  place.above_m = place.below_m = slab_m(place, radius_m);
  return place;
}

TEST(FacingCells, NoIsCertain) {
  RandomStream random(1, Stage::test, 3);
  random.start_bounce(0);
  std::vector<Landed> landed;
  for (int i = 0; i < 300; ++i)
    landed.push_back({Vec3(4 * random.uniform(), random.uniform(), 100 * random.uniform()),
                      some_direction(random), 1, some_direction(random)});
  const PhotonMap map = map_of(landed);
  const FacingCells cells(map, [](std::uint32_t) { return true; });
  int holding = 0, denied = 0;
  for (int i = 0; i < 20000; ++i) {
    const float radius_m = std::pow(10.f, 2 * random.uniform() - 1);
    // One in two beside a photon that faces so.
    const Landed& one = landed[random.bits() % landed.size()];
    const bool near = i % 2 == 0;
    const Vec3 n = near ? glm::normalize(one.normal + 0.3f * some_direction(random)) : some_direction(random);
    const Vec3 p = near
                       ? one.position + 0.7f * radius_m * some_direction(random)
                       : Vec3(6 * random.uniform() - 1, 3 * random.uniform() - 1, 102 * random.uniform() - 1);
    const ZonePlace place = place_at(p, n, radius_m);
    const bool may = cells.may_hold(place, radius_m);
    denied += !may;
    if (!holds(map, place, radius_m)) continue;
    ++holding;
    EXPECT_TRUE(may) << i;
  }
  EXPECT_GT(holding, 500);
  EXPECT_GT(denied, 5000);
}

TEST(FacingCells, TheTopOfALampHoldsNothingOfTheFloor) {
  std::vector<Landed> landed;
  for (int x = 0; x < 100; ++x)
    for (int z = 0; z < 100; ++z) landed.push_back({0.4f * Vec3(x - 50, 0, z - 50), {0, 1, 0}});
  for (int x = 0; x < 10; ++x)  // the lamp's under side
    landed.push_back({Vec3(0, 1.5f, 0) + 0.05f * Vec3(x, 0, 0), {0, -1, 0}, 1, {0, -1, 0}});
  const PhotonMap map = map_of(landed);
  const FacingCells cells(map, [](std::uint32_t) { return true; });
  EXPECT_FALSE(cells.may_hold(place_at({0.2f, 1.5f, 0}, {0, 1, 0}, 4), 4));
  EXPECT_TRUE(cells.may_hold(place_at({0.2f, 1.5f, 0}, {0, -1, 0}, 4), 4));
  EXPECT_TRUE(cells.may_hold(place_at({0.2f, 0, 0}, {0, 1, 0}, 4), 4));
  // Of photons that do not count there are none.
  const FacingCells none(map, [](std::uint32_t) { return false; });
  EXPECT_FALSE(none.may_hold(place_at({0.2f, 0, 0}, {0, 1, 0}, 4), 4));
}

TEST(FacingCells, OfOnePhotonAndOfNone) {
  const PhotonMap one = map_of({{Vec3(1, 2, 3)}});
  const FacingCells cells(one, [](std::uint32_t) { return true; });
  EXPECT_TRUE(cells.may_hold(place_at({1, 2, 3}, {0, 1, 0}, 0.1f), 0.1f));
  EXPECT_FALSE(cells.may_hold(place_at({1, 2, 3}, {1, 0, 0}, 0.1f), 0.1f));
  EXPECT_FALSE(cells.may_hold(place_at({2, 2, 3}, {0, 1, 0}, 0.1f), 0.1f));
  const PhotonMap empty = map_of({});
  EXPECT_FALSE(
      FacingCells(empty, [](std::uint32_t) { return true; }).may_hold(place_at({1, 2, 3}, {0, 1, 0}, 1), 1));
}

}  // namespace
}  // namespace phos::test
