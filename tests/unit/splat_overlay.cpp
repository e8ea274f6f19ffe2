// Records drawn over a picture: where, which, and in what colours.
#include <gtest/gtest.h>

#include "splat/picture/overlay.h"
#include "splat/picture/overlay_legend.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr int kSide = 200;

/// A floor seen from 4 m above, 4 m wide in the picture, and a sheet 1 m above its left half.
struct FloorAndSheet {
  Scene scene;
  Camera camera;
  FloorAndSheet(float size = 1) {
    begin_instance(scene, "floor", add_lambert(scene, "floor", 0.5f));
    add_quad(scene, size * Vec3(-5, 0, -5), {0, 0, 10 * size}, {10 * size, 0, 0});
    add_quad(scene, size * Vec3(-5, 1, -5), {0, 0, 10 * size}, {5 * size, 0, 0});
    camera = look_at(size * Vec3(0, 4, 0), Vec3(0), {0, 0, -1}, 2 * std::atan(0.5f));
    scene.camera.push_back(camera);
    finalize(scene);
  }
};

IrradianceRecord record(const Vec3& p, const Vec3& n, float radius_m) {
  IrradianceRecord r;
  r.position = p, r.normal = n, r.radius_m = radius_m;
  r.irradiance = Rgb(10), r.stderr_lx = Rgb(1);
  return r;
}

Image grey_picture(float value) {
  Image image(kSide, kSide);
  image.set_rgb("", std::vector<Rgb>(image.pixels(), Rgb(value)));
  return image;
}

struct Marked {
  DrawnRecords drawn;
  std::vector<Rgb> picture;
  Rgb at(int x, int y) const { return picture[static_cast<std::size_t>(y * kSide + x)]; }
  bool coloured(int x, int y) const {
    const Rgb c = at(x, y);
    return max_component(c) - std::fmin(c.x, std::fmin(c.y, c.z)) > 0.1f * max_component(c);
  }
  int count() const {
    int n = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) n += coloured(x, y);
    return n;
  }
};

Marked draw(const FloorAndSheet& s, const std::vector<IrradianceRecord>& records,
            OverlayColour colour = OverlayColour::radius, float light = 1, const RecordLives& lives = {}) {
  Image image = grey_picture(light);
  const RayScene rays(s.scene);
  Marked m;
  m.drawn = draw_records(image, records, 0.2, rays, s.camera, colour, lives);
  m.picture = image.rgb("");
  return m;
}

/// At (1, 0, 0): 50 pixels right of the middle. a R = 0.5 m is a circle of 25 pixels; what lies at another
/// distance stays grey.
TEST(Overlay, DotAndOutline) {
  for (const float size : {1e-6f, 1.f, 1e6f}) {
    const FloorAndSheet s(size);
    const Marked m = draw(s, {record(size * Vec3(1, 0, 0), {0, 1, 0}, 2.5f * size)});
    ASSERT_EQ(m.drawn.count, 1u) << size;
    EXPECT_NEAR(m.drawn.least / static_cast<double>(size), 2.5, 1e-4);
    EXPECT_TRUE(m.coloured(150, 100));
    EXPECT_FALSE(m.coloured(150, 110));
    EXPECT_TRUE(m.coloured(150, 74) || m.coloured(150, 75));
    EXPECT_TRUE(m.coloured(150, 124) || m.coloured(150, 125));
    EXPECT_TRUE(m.coloured(174, 100) || m.coloured(175, 100));
    EXPECT_FALSE(m.coloured(150, 60));
    EXPECT_FALSE(m.coloured(20, 20));
    // About a line along the circle, of two pixels with its soft edges, and a dot.
    EXPECT_NEAR(m.count(), 2 * M_PI * 25 * 2 + 38, 60);
  }
}

TEST(Overlay, HiddenRecordsAreNotDrawn) {
  const FloorAndSheet s;
  EXPECT_EQ(draw(s, {record({-1, 0, 0}, {0, 1, 0}, 1)}).drawn.count, 0u) << "below the sheet";
  EXPECT_EQ(draw(s, {record({1, 0, 0}, {0, -1, 0}, 1)}).drawn.count, 0u) << "lights the other side";
  EXPECT_EQ(draw(s, {record({4, 0, 0}, {0, 1, 0}, 1)}).drawn.count, 0u) << "beside the picture";
  EXPECT_EQ(draw(s, {record({0, 5, 0}, {0, 1, 0}, 1)}).drawn.count, 0u) << "behind the camera";
  EXPECT_EQ(draw(s, {record({-1, 1, 0}, {0, 1, 0}, 1)}).drawn.count, 1u) << "on the sheet";
  EXPECT_EQ(draw(s, {}).drawn.count, 0u);
  EXPECT_EQ(draw(s, {record({-1, 0, 0}, {0, 1, 0}, 1)}).count(), 0);
}

TEST(Overlay, ColoursTellTheValue) {
  const FloorAndSheet s;
  std::vector<IrradianceRecord> records{record({1, 0, -1}, {0, 1, 0}, 0.1f), record({1, 0, 1}, {0, 1, 0}, 1)};
  const Marked radius = draw(s, records);
  EXPECT_NEAR(radius.drawn.least, 0.1, 1e-6);
  EXPECT_NEAR(radius.drawn.most, 1, 1e-6);
  const Rgb small = radius.at(150, 50), large = radius.at(150, 150);
  EXPECT_GT(small.z, small.x) << "blue";
  EXPECT_GT(large.x, large.z) << "red";
  records[0].stderr_lx = Rgb(5);
  const Marked error = draw(s, records, OverlayColour::stderr_);
  EXPECT_NEAR(error.drawn.least, 0.1, 1e-6);
  EXPECT_NEAR(error.drawn.most, 0.5, 1e-6);
  EXPECT_GT(error.at(150, 50).x, error.at(150, 50).z);
  EXPECT_GT(error.at(150, 150).z, error.at(150, 150).x);
}

/// Colours follow the brightness of the picture; black pictures and records without light do no harm.
TEST(Overlay, AnyBrightness) {
  const FloorAndSheet s;
  std::vector<IrradianceRecord> records{record({1, 0, 0}, {0, 1, 0}, 1)};
  const float one = draw(s, records).at(150, 100).y;
  EXPECT_NEAR(draw(s, records, OverlayColour::radius, 1e6f).at(150, 100).y / one, 1e6, 2e3);
  records[0].irradiance = records[0].stderr_lx = Rgb(0);
  const Marked black = draw(s, records, OverlayColour::stderr_, 0);
  EXPECT_EQ(black.drawn.count, 1u);
  for (const Rgb& c : black.picture) ASSERT_TRUE(is_finite(c));
  EXPECT_GT(max_component(black.at(150, 100)), 0);
}

/// Lives of 1, 4 and 16 frames of at most 16: the ends of the scale and its middle; a record of a cache that
/// is no film is white.
TEST(Overlay, ColoursTellLives) {
  const FloorAndSheet s;
  std::vector<IrradianceRecord> records;
  for (const float z : {-1.5f, -0.5f, 0.5f, 1.5f}) records.push_back(record({1, 0, z}, {0, 1, 0}, 0.1f));
  const Marked m = draw(s, records, OverlayColour::life, 1, {.frames = {1, 4, 16, 0}, .most = 16});
  EXPECT_EQ(m.drawn.least, 1);
  EXPECT_EQ(m.drawn.most, 16);
  const OverlayColourRow& row = row_of(OverlayColour::life);
  for (int i = 0; i < 3; ++i) {
    const Rgb told = scene_colour(row.at(0.5 * i), m.drawn.key_cd_m2);
    const Rgb seen = m.at(150, 25 + 50 * i);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], told[c], 1e-5) << i;
  }
  EXPECT_GT(m.at(150, 25).x, 2 * m.at(150, 25).y) << "red";
  EXPECT_GT(m.at(150, 125).y, m.at(150, 125).x) << "green";
  const Rgb white = m.at(150, 175);
  EXPECT_NEAR(white.x, white.y, 1e-5f);
  EXPECT_NEAR(white.x, white.z, 1e-5f);
}

/// Letters of 13 pixels: the scale is 156 pixels wide, 20 from the left, and 24 to 41 above the bottom.
TEST(Overlay, LegendInTheCorner) {
  Image image(400, 400);
  image.set_rgb("", std::vector<Rgb>(image.pixels(), Rgb(1)));
  const Image before = image;
  DrawnRecords drawn;
  draw_legend(image, drawn, OverlayColour::radius);
  EXPECT_EQ(image.rgb(""), before.rgb("")) << "no record is drawn";
  drawn.count = 2, drawn.least = 0.01, drawn.most = 1;
  draw_legend(image, drawn, OverlayColour::radius);
  const std::vector<Rgb> picture = image.rgb("");
  const auto at = [&](int x, int y) { return picture[static_cast<std::size_t>(y * 400 + x)]; };
  const OverlayColourRow& row = row_of(OverlayColour::radius);
  for (const int x : {25, 97, 170}) {
    const Rgb told = scene_colour(row.at((x - 20 + 0.5) / 156), 1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(x, 367)[c], told[c], 0.05f * max_component(told)) << x;
  }
  EXPECT_EQ(at(300, 350), Rgb(1));
  EXPECT_EQ(at(25, 300), Rgb(1));
  Image small(100, 100);
  small.set_rgb("", std::vector<Rgb>(small.pixels(), Rgb(1)));
  draw_legend(small, drawn, OverlayColour::radius);
  EXPECT_EQ(small.rgb("")[0], Rgb(1));
  EXPECT_EQ(small.rgb("")[99 * 100], Rgb(1)) << "no room";
}

}  // namespace
}  // namespace phos::test
