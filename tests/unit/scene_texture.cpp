// Texture filtering, wrapping and transforms.
#include "scene/texture/texture.h"

#include <gtest/gtest.h>

using namespace phos;

namespace {

/// 2 x 2: 0 1 over 2 3.
Texture four(Texture::Wrap wrap, bool nearest = false) {
  Texture t;
  t.width = t.height = 2;
  t.texels = {Vec4(0), Vec4(1), Vec4(2), Vec4(3)};
  t.wrap_u = t.wrap_v = wrap;
  t.nearest = nearest;
  return t;
}

}  // namespace

TEST(Texture, InterpolatesBetweenTexelCentres) {
  const Texture t = four(Texture::Wrap::clamp);
  EXPECT_EQ(t.at({0.25f, 0.25f}).x, 0);
  EXPECT_EQ(t.at({0.75f, 0.25f}).x, 1);
  EXPECT_EQ(t.at({0.25f, 0.75f}).x, 2);
  EXPECT_EQ(t.at({0.5f, 0.5f}).x, 1.5f);
  EXPECT_EQ(t.at({0.f, 0.f}).x, 0);
  EXPECT_EQ(t.at({9.f, 9.f}).x, 3);
}

TEST(Texture, Wraps) {
  const Texture repeat = four(Texture::Wrap::repeat), mirror = four(Texture::Wrap::mirror);
  EXPECT_EQ(repeat.at({0, 0.25f}).x, 0.5f);  // half way between the last and the first
  EXPECT_FLOAT_EQ(repeat.at({3.75f, -0.75f}).x, 1);
  EXPECT_FLOAT_EQ(mirror.at({1.25f, 0.25f}).x, 1);
  EXPECT_FLOAT_EQ(mirror.at({-0.25f, 0.25f}).x, 0);
  EXPECT_FLOAT_EQ(mirror.at({1, 0.25f}).x, 1);
  EXPECT_FLOAT_EQ(mirror.at({2.f, 0.25f}).x, 0);
}

TEST(Texture, TakesTheNearestTexelWhereAsked) {
  const Texture t = four(Texture::Wrap::repeat, true);
  EXPECT_EQ(t.at({0.49f, 0.51f}).x, 2);
  EXPECT_EQ(t.at({0.51f, 0.49f}).x, 1);
  EXPECT_EQ(four(Texture::Wrap::clamp, true).at({1, 1}).x, 3);
}

TEST(Texture, CodesAreDecoded) {
  Texture t;
  t.width = 2, t.height = 1;
  t.codes = {{0, 128, 255, 128}, {51, 10, 0, 255}};
  t.wrap_u = t.wrap_v = Texture::Wrap::clamp;
  EXPECT_EQ(t.size(), 2u);
  EXPECT_EQ(t.at({0, 0.5f}), Vec4(0, 128 / 255.f, 1, 128 / 255.f));
  EXPECT_FLOAT_EQ(t.at({0.5f, 0.5f}).x, 0.1f);
  t.srgb = true;
  EXPECT_NEAR(t.texel(0).y, 0.2158605, 1e-6);          // a middle grey
  EXPECT_NEAR(t.texel(1).y, 10 / 255. / 12.92, 1e-7);  // the straight piece near black
  EXPECT_EQ(t.texel(0).w, 128 / 255.f);
}

TEST(Texture, IsFiniteForAnyCoordinates) {
  for (const auto wrap : {Texture::Wrap::repeat, Texture::Wrap::clamp, Texture::Wrap::mirror}) {
    for (const bool nearest : {false, true}) {
      const Texture t = four(wrap, nearest);
      for (const float u : {0.f, 1.f, -1e-30f, 1e-30f, 0x1.fffffep-1f, -0x1.fffffep-1f, 1e9f, -1e9f, 3e38f,
                            -3e38f, kInfinity, std::nanf("")}) {
        for (const float v : {0.3f, u}) {
          const Vec4 c = t.at({u, v});
          EXPECT_GE(c.x, 0) << u << " " << v;
          EXPECT_LE(c.x, 3) << u << " " << v;
        }
      }
    }
  }
  EXPECT_EQ(Texture().at({0.5f, 0.5f}), Vec4(1));
}

TEST(Texture, TransformScalesThenRotatesThenMoves) {
  TextureUse use;
  use.scale = {2, 3};
  use.offset = {0.1f, 0.2f};
  EXPECT_EQ(transformed(use, {1, 1}), Vec2(2.1f, 3.2f));
  use.rotation_rad = kPi / 2;  // counter-clockwise with v down: u turns to -v
  const Vec2 turned = transformed(use, {1, 0});
  EXPECT_NEAR(turned.x, 0.1f, 1e-6f);
  EXPECT_NEAR(turned.y, 0.2f - 2, 1e-6f);
}

TEST(Texture, LooksUpItsOwnSet) {
  Scene scene;
  scene.texture = {four(Texture::Wrap::clamp)};
  TextureUse use;
  EXPECT_EQ(look_up(scene, use, {0, 0}, {1, 1}), Vec4(1));
  use.texture = 0;
  EXPECT_EQ(look_up(scene, use, {0, 0}, {1, 1}).x, 0);
  use.set = 1;
  EXPECT_EQ(look_up(scene, use, {0, 0}, {1, 1}).x, 3);
}
