// Records drawn over a picture: where, which, and in what colours.
#include <gtest/gtest.h>

#include "splat/picture/overlay.h"
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
            OverlayColour colour = OverlayColour::radius, float light = 1) {
  Image image = grey_picture(light);
  const RayScene rays(s.scene);
  Marked m;
  m.drawn = draw_records(image, records, 0.2, rays, s.camera, colour);
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

}  // namespace
}  // namespace phos::test
