// Flat mirrors, chains of them, and the images of lamps.
#include <gtest/gtest.h>

#include "scene/mirror/images.h"
#include "scene/mirror/sight.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

/// A box of 4 m whose walls x = 0 and x = 4 are mirrors, and a point lamp; with a black screen of constant x
/// if its box is not empty.
Scene corridor(float reflectance, bool textured_normal = false, const Bounds& screen = {}) {
  Scene scene;
  const std::uint32_t black = add_lambert(scene, "black", 0), mirror = add_lambert(scene, "mirror", 0);
  scene.material[mirror].model = Model::mirror, scene.material[mirror].ks = Rgb(reflectance);
  if (textured_normal) {
    scene.texture.push_back({"bumps", 1, 1, {Vec4(0.5f, 0.5f, 1, 1)}, {}});
    scene.material[mirror].normal.texture = 0;
  }
  begin_instance(scene, "black", black);
  add_quad(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  add_quad(scene, {0, 4, 0}, {4, 0, 0}, {0, 0, 4});
  if (!screen.empty()) add_quad(scene, screen.lo, {0, screen.size().y, 0}, {0, 0, screen.size().z});
  begin_instance(scene, "mirrors", mirror);
  add_quad(scene, {0, 0, 0}, {0, 4, 0}, {0, 0, 4});
  add_quad(scene, {4, 0, 0}, {0, 0, 4}, {0, 4, 0});
  add_point_light(scene, {1.5f, 2.5f, 2}, 1000);
  finalize(scene);
  return scene;
}

}  // namespace

TEST(MirrorPlanes, TwoThatFaceEachOtherMakeChainsAsLongAsTheyReflect) {
  const Scene scene = corridor(0.9f);
  const MirrorPlanes mirrors(scene);
  // 0.9^37 is the last above 0.02; the first mirror may be either; no light gets to the outer sides.
  std::size_t inside = 0;
  for (const MirrorPlanes::Chain& c : mirrors.chains()) {
    EXPECT_GE(c.reflectance, 0.02f);
    inside += mirrors.plane(c.plane).front_of({2, 2, 2}) == c.front;
  }
  EXPECT_EQ(inside, 2 * 37u);
  EXPECT_EQ(mirrors.chains().size(), inside);
  EXPECT_TRUE(MirrorPlanes(corridor(0.01f)).empty()) << "too little to look for";
  EXPECT_TRUE(MirrorPlanes(corridor(0.9f, true)).empty()) << "bumps are not flat";
  EXPECT_TRUE(MirrorPlanes(point_light_over_plane().scene).empty());
}

TEST(MirrorPlanes, AMirrorBehindAScreenReflectsNothing) {
  const Scene scene = corridor(0.9f, false, {{3.9f, 0, 0}, {3.9f, 4, 4}});
  const MirrorPlanes mirrors(scene);
  ASSERT_EQ(mirrors.chains().size(), 1u);
  EXPECT_EQ(mirrors.plane(mirrors.chains()[0].plane).box.hi.x, 0);
}

/// A screen just before the lower half of a mirror.
TEST(MirrorSight, TellsWhichShareIsLit) {
  const Scene scene = corridor(0.9f, false, {{3.999f, 0, 0}, {3.999f, 2, 4}});
  const std::vector<Vec3> normals{{1, 0, 0}, {-1, 0, 0}};
  std::vector<std::int32_t> plane_of(scene.triangle.size(), -1);
  for (std::size_t t = plane_of.size() - 4; t < plane_of.size(); ++t)
    plane_of[t] = t < plane_of.size() - 2 ? 0 : 1;
  const MirrorSight sight(scene, normals, plane_of);
  EXPECT_EQ(sight.lit_share({0, true}), 1);
  EXPECT_NEAR(sight.lit_share({1, true}), 0.5f, 0.02f);
  EXPECT_EQ(sight.lit_share({0, false}), 0);
  EXPECT_NEAR(sight.seen_share({0, true}, {1, true}), 0.5f, 0.05f);
  EXPECT_NEAR(sight.seen_share({1, true}, {0, true}), 0.5f, 0.05f);
  EXPECT_EQ(sight.seen_share({0, true}, {1, false}), 0);
}

TEST(MirrorPlanes, FollowsWhatItTook) {
  const Scene scene = corridor(0.9f);
  const MirrorPlanes mirrors(scene);
  const std::uint32_t left = 4, right = 6;  // triangles of the mirrors
  std::int32_t chain = MirrorPlanes::kNone;
  for (int k = 0; k < 37; ++k) {
    chain = mirrors.follow(chain, k % 2 == 0 ? left : right, true);
    ASSERT_NE(chain, MirrorPlanes::kNone) << k;
  }
  EXPECT_EQ(mirrors.follow(chain, right, true), MirrorPlanes::kNone) << "too faint";
  EXPECT_EQ(mirrors.follow(MirrorPlanes::kNone, 0, true), MirrorPlanes::kNone) << "no mirror";
  const std::int32_t one = mirrors.follow(MirrorPlanes::kNone, right, true);
  EXPECT_EQ(mirrors.follow(one, right, true), MirrorPlanes::kNone) << "light leaves it";
  const Vec3 image = mirrors.image(one, {1, 2, 3});
  EXPECT_NEAR(image.x, 7, 1e-5f);
  EXPECT_NEAR(image.y, 2, 1e-5f);
}

/// I rho^n / d2 towards the image, none where the mirror ends.
TEST(MirrorImages, ShineFromBehindTheMirror) {
  const Scene scene = corridor(0.9f);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  SurfacePoint p;
  p.position = {2, 1, 2}, p.error_m = 1e-6f;
  p.geometric_normal = p.normal = {0, 1, 0};
  const std::int32_t right = lights.mirrors().follow(MirrorPlanes::kNone, 6, true);
  Illumination light;
  ASSERT_TRUE(
      illuminate_by_mirrors(rays, lights, static_cast<std::size_t>(right), 0, p, 0, Vec2(0.5f), light));
  const Vec3 way = Vec3(6.5f, 2.5f, 2) - p.position;
  EXPECT_NEAR(light.distance_m, glm::length(way), 1e-5f);
  EXPECT_NEAR(light.value.x, 0.9f * 1000 / glm::dot(way, way), 1e-3f);
  EXPECT_LT(glm::length(light.direction - glm::normalize(way)), 1e-6f);
  // From beyond the mirror's end its image is not seen.
  p.position = {2, 1, -20};
  EXPECT_FALSE(
      illuminate_by_mirrors(rays, lights, static_cast<std::size_t>(right), 0, p, 0, Vec2(0.5f), light));
}

/// A point lamp between mirrors that face each other sends I / d^2 by each image that a point sees: of the
/// chains along the room, all. What the bounds leave out has no image there.
TEST(ImageBounds, LeaveOutNoImageThatIsSeen) {
  const Scene scene = corridor(0.9f);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const MirrorPlanes& mirrors = lights.mirrors();
  std::size_t seen = 0, left_out = 0;
  for (const Vec3& place : {Vec3(2, 1, 2), Vec3(0.1f, 3.9f, 0.1f), Vec3(3.9f, 0.1f, 3.5f), Vec3(5, 1, 2)}) {
    SurfacePoint p;
    p.position = place, p.error_m = 1e-6f;
    p.geometric_normal = p.normal = {0, 1, 0};
    for (std::size_t chain = 0; chain < mirrors.chains().size(); ++chain) {
      const float promise = lights.image_promise_lx(chain, 0, p);
      // An image is seen where its way meets each mirror, as x alone decides in this room.
      const Vec3 image = mirrors.image_of_lamp(static_cast<std::int32_t>(chain), scene.light[0].position);
      const MirrorPlanes::Chain& last = mirrors.chains()[chain];
      const bool there =
          place.x < 4 && mirrors.plane(last.plane).front_of(place) == last.front && image.y > place.y;
      if (!(promise > 0)) {
        ++left_out;
        EXPECT_FALSE(there && last.before == MirrorPlanes::kNone) << chain;
        continue;
      }
      Illumination light;
      if (!illuminate_by_mirrors(rays, lights, chain, 0, p, 0, Vec2(0.5f), light)) continue;
      ++seen;
      const float d = glm::distance(image, place);
      EXPECT_NEAR(light.value.x, last.reflectance * 1000 / (d * d), 1e-3f * light.value.x);
    }
  }
  // At each of the three places between the mirrors: chains of 1 to 37 reflections, either mirror first.
  EXPECT_EQ(seen, 3 * 2 * 37u);
  EXPECT_GT(left_out, 0u) << "from behind a mirror";
}

}  // namespace phos::test
