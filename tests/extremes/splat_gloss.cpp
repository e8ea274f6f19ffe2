// Radiance records drawn where numbers are at their ends.
#include <gtest/gtest.h>

#include "support/gloss_view.h"

namespace phos {
namespace {

/// The box at any size; what is drawn, against the lookup.
struct Box : test::GlossView {
  explicit Box(Scene of) : GlossView(std::move(of), 48, 48) {}
  /// Pixels drawn.
  std::size_t expect_as_looked_up(const std::vector<RadianceRecord>& records) const {
    const GlossCache filled = cache(records);
    const GlossBuffer drawn = draw(filled), looked_up = look_up(filled);
    std::size_t pixels = 0, other = 0;
    for (std::size_t i = 0; i < drawn.light.size(); ++i) {
      for (const Vec4& v : {drawn.light[i], drawn.error[i]})
        EXPECT_TRUE(is_finite(Vec3(v)) && std::isfinite(v.w)) << i;
      if (drawn.error[i].w != looked_up.error[i].w) {
        ++other;
        continue;
      }
      if (!(drawn.light[i].w > 0)) continue;
      ++pixels;
      EXPECT_NEAR(drawn.light[i].w, looked_up.light[i].w, 1e-4);
      const Rgb off = glm::abs(Rgb(drawn.light[i]) - Rgb(looked_up.light[i]));
      EXPECT_LE(max_component(off), 2e-3f * max_component(Rgb(looked_up.light[i])) + 1e-30f) << i;
    }
    EXPECT_LE(other, 2u);
    return pixels;
  }
};

TEST(GlossSplatExtremes, AnySizeOfScene) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    const Box box{test::scaled(test::glossy_cornell(), scale)};
    EXPECT_GT(box.expect_as_looked_up(box.records(60, 0.2f * scale, 0.8f * scale)), 200u) << scale;
  }
}

TEST(GlossSplatExtremes, AnyRadius) {
  const Box box{test::glossy_cornell()};
  for (const float radius : {1e-30f, 1e-6f, 1e6f, 1e30f}) {
    const std::size_t drawn = box.expect_as_looked_up(box.records(20, radius, radius));
    EXPECT_TRUE(drawn > 200 || radius < 1) << radius;
  }
}

TEST(GlossSplatExtremes, AnyLight) {
  const Box box{test::glossy_cornell()};
  for (const float power : {0.f, 1e-12f, 1e12f}) {
    std::vector<RadianceRecord> records = box.records(30, 0.3f, 0.8f);
    for (RadianceRecord& r : records)
      for (std::vector<float>* v : {&r.light, &r.gradient_x, &r.gradient_y, &r.stderr_light})
        for (float& x : *v) x *= power;
    EXPECT_GT(box.expect_as_looked_up(records), 200u) << power;
  }
}

/// Dark records whose light would rise at once, and bright ones that change by far more than they hold.
TEST(GlossSplatExtremes, SteepRecords) {
  const Box box{test::glossy_cornell()};
  std::vector<RadianceRecord> records = box.records(30, 0.3f, 0.8f);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i % 2 == 0) std::fill(records[i].light.begin(), records[i].light.end(), 0.f);
    for (float& x : records[i].gradient_x) x *= 1e6f;
  }
  EXPECT_GT(box.expect_as_looked_up(records), 200u);
}

/// Under the very same place.
TEST(GlossSplatExtremes, CoincidentRecords) {
  const Box box{test::glossy_cornell()};
  const std::vector<RadianceRecord> one = box.records(1, 0.8f, 0.8f);
  EXPECT_GT(box.expect_as_looked_up(std::vector<RadianceRecord>(500, one.front())), 50u);
}

}  // namespace
}  // namespace phos
