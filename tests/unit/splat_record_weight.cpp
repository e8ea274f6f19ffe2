// record/weight.inc in its three languages: one place at a time, places side by side, and OpenGL.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/random.h"
#include "splat/cpu/gloss_kernel.h"
#include "splat/cpu/splatter.h"
#include "splat/cpu/splatter_kernel.h"
#include "splat/gl/renderer.h"
#include "support/gl.h"
#include "support/scenes.h"

namespace phos {
namespace {

constexpr float kAccuracy = 0.25f;
/// Rounding, of a weight against 1 and of light against twice the record's.
constexpr float kSame = 1e-5f;
constexpr int kSide = 16;

Vec3 direction(RandomStream& random) {
  const float z = 2 * random.uniform() - 1, turn = 6.2831853f * random.uniform(), r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// A record at `position`, its gradients of up to its own light over its radius and in a radian.
IrradianceRecord record_of(RandomStream& random, const Vec3& position, float radius_m) {
  IrradianceRecord r;
  r.position = position, r.normal = direction(random), r.radius_m = radius_m;
  r.distance_m = random.uniform() < 0.5f ? kInfinity : 0.1f * radius_m * random.uniform();
  r.weight = random.uniform() < 0.5f ? 1.f : 0.01f + 0.99f * random.uniform();
  for (int c = 0; c < 3; ++c) {
    r.irradiance[c] = 10 + 100 * random.uniform(), r.stderr_lx[c] = 0.1f * r.irradiance[c];
    r.rotation_gradient[c] = r.irradiance[c] * direction(random);
    r.translation_gradient[c] = 4 * r.irradiance[c] / radius_m * direction(random);
  }
  return r;
}

/// What each pixel of a picture shows, wherever the camera looks.
enum Place { at_the_record, facing_alike, facing_away, at_the_border, anywhere, kPlaces };

GBuffer places_about(const IrradianceRecord& r, RandomStream& random) {
  GBuffer g;
  g.width = g.height = kSide;
  g.hit.resize(kSide * kSide), g.albedo.resize(kSide * kSide);
  const Frame frame = make_frame(r.normal);
  for (int i = 0; i < kSide * kSide; ++i) {
    Vec3 step = kAccuracy * r.radius_m * random.uniform() * direction(random), n = r.normal;
    switch (i % kPlaces) {
      case at_the_record:
        step = Vec3(0);
        break;
      case facing_alike:
        break;
      case facing_away:
        n = -r.normal;
        break;
      case at_the_border:
        step = kAccuracy * r.radius_m * frame.x;
        break;
      default:
        n = glm::normalize(r.normal + 0.3f * direction(random));
    }
    g.position.emplace_back(r.position + step, 1);
    g.normal.emplace_back(n, 1);
  }
  return g;
}

/// The weight at a place and the light there, one place at a time.
float weight_of(const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  const float w = record_weight(record_error(r, p, n), kAccuracy);
  return w > kLeastWeight && !record_apart(r, p, n) ? w * r.weight : 0;
}

void expect_the_same(const IrradianceRecord& r, const GBuffer& g, const SplatBuffer& drawn,
                     std::array<int, kPlaces>& lit) {
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Vec3 p(g.position[at]), n(g.normal[at]);
    const float expected = weight_of(r, p, n), found = drawn.light[at].w;
    ASSERT_NEAR(found, expected, kSame) << "place " << i << ", radius " << r.radius_m;
    if (i % kPlaces == at_the_record) {
      ASSERT_EQ(found, r.weight);
    }
    if (i % kPlaces == facing_away) {
      ASSERT_EQ(found, 0);
    }
    if (!(found > 0 && expected > 0)) continue;
    ++lit[static_cast<std::size_t>(i % kPlaces)];
    const Rgb light = extrapolate(r, p, n);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(drawn.light[at][c], found * light[c], kSame * found * 2 * r.irradiance[c])
          << "place " << i << ", radius " << r.radius_m;
  }
}

/// The weights of a gloss record at the places of a picture.
std::vector<float> gloss_weights(const GlossSplat& splat, const GBuffer& g) {
  std::vector<float> weights;
  for (std::size_t first = 0; first < g.position.size(); first += kGlossLanes) {
    GlossGroup group{};
    for (int k = 0; k < kGlossLanes; ++k) {
      const Vec4 &p = g.position[first + static_cast<std::size_t>(k)],
                 &n = g.normal[first + static_cast<std::size_t>(k)];
      group.px.of[k] = p.x, group.py.of[k] = p.y, group.pz.of[k] = p.z;
      group.nx.of[k] = n.x, group.ny.of[k] = n.y, group.nz.of[k] = n.z;
    }
    GlossLane weight;
    gloss_kernel_plain.weights(group, splat, 1 / kAccuracy, kLeastWeight, weight);
    for (int k = 0; k < kGlossLanes; ++k) weights.push_back(weight.of[k]);
  }
  return weights;
}

GlossSplat gloss_splat(const PackedRecord& packed) {
  GlossSplat splat{};
  for (int c = 0; c < 3; ++c) splat.position[c] = packed.position[c], splat.normal[c] = packed.normal[c];
  splat.inverse_radius = packed.inverse_radius, splat.weight = packed.weight;
  splat.front_limit_m = packed.front_limit_m, splat.over_limit_m = packed.over_limit_m;
  return splat;
}

class RecordWeightBy : public ::testing::TestWithParam<float> {};

TEST_P(RecordWeightBy, IsTheSameInEachLanguage) {
  const Scene scene;  // no need to see it
  GlRenderer gl(scene);
  std::array<int, kPlaces> by_cpu{}, by_gl{};
  for (std::uint64_t item = 0; item < 20; ++item) {
    RandomStream random(3, Stage::test, item);
    const Vec3 position = GetParam() == 1 ? direction(random) : Vec3(0);
    const IrradianceRecord r = record_of(random, position, GetParam());
    const GBuffer g = places_about(r, random);
    // From within the record's reach, so that all pixels may be.
    const Camera camera = test::look_at(position, position + Vec3(1, 0, 0), {0, 0, 1}, 1);
    const SplatBuffer side_by_side = splat_on_cpu(std::vector{r}, kAccuracy, g, camera);
    expect_the_same(r, g, side_by_side, by_cpu);
    expect_the_same(r, g, gl.splat(std::vector{r}, kAccuracy, g, camera), by_gl);

    const std::vector<float> gloss = gloss_weights(gloss_splat(pack_record(r)), g);
    for (std::size_t i = 0; i < gloss.size(); ++i) ASSERT_EQ(gloss[i], side_by_side.light[i].w);
  }
  for (const std::array<int, kPlaces>& lit : {by_cpu, by_gl}) {
    EXPECT_EQ(lit[at_the_record], 20 * (kSide * kSide + kPlaces - 1) / kPlaces);
    EXPECT_GT(lit[facing_alike], 200);
    EXPECT_EQ(lit[facing_away], 0);
    EXPECT_GT(lit[anywhere], 50);
  }
}

INSTANTIATE_TEST_SUITE_P(Radius, RecordWeightBy, ::testing::Values(1e-12f, 1.f, 1e12f));

/// All of the error is used up: no weight is left, and none below nothing.
TEST(RecordWeight, EndsWhereTheErrorIsTheAccuracy) {
  IrradianceRecord r;
  r.radius_m = 4, r.irradiance = Rgb(1);
  const Vec3 border(1, 0, 0), inside(std::nextafter(1.f, 0.f), 0, 0);
  EXPECT_EQ(record_weight(record_error(r, border, r.normal), kAccuracy), 0);
  EXPECT_GT(record_weight(record_error(r, inside, r.normal), kAccuracy), 0);
  EXPECT_EQ(record_weight(std::numeric_limits<float>::quiet_NaN(), kAccuracy), 0);
  EXPECT_EQ(record_weight(kInfinity, kAccuracy), 0);
}

/// Footprints: one place at a time, side by side, and by OpenGL.
TEST(RecordWeight, OfFootprintsIsTheSame) {
  const Scene scene;  // no need to see it
  GlRenderer gl(scene);
  const auto tile = std::make_unique<SplatTile>();
  int lit = 0;
  for (std::uint64_t item = 0; item < 60; ++item) {
    RandomStream random(4, Stage::test, item);
    constexpr float kRadii[] = {1, 1e-12f, 1e12f};
    const float radius_m = kRadii[item % 3];
    const Vec3 position = radius_m == 1 ? direction(random) : Vec3(0);
    IrradianceRecord r = record_of(random, position, radius_m);
    AdaptiveFootprint::Axes axes;
    for (AdaptiveFootprint::Axis& axis : axes) {
      const auto light = [&] { return r.irradiance * (2 * random.uniform() - 1); };
      axis = {kAccuracy * radius_m * (0.2f + 0.8f * random.uniform()), light(), light(), light(), light()};
    }
    r.footprint = std::make_shared<AdaptiveFootprint>(make_frame(r.normal).x, r.normal, axes);
    r.radius_m = r.footprint->longest_m() / kAccuracy;
    const GBuffer g = places_about(r, random);
    *tile = {};
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const Vec4 &p = g.position[i], &n = g.normal[i];
      tile->px[i] = p.x, tile->py[i] = p.y, tile->pz[i] = p.z;
      tile->nx[i] = n.x, tile->ny[i] = n.y, tile->nz[i] = n.z;
    }
    splat_footprint_plain(*tile, pack_record(r), pack_footprint(r), 0, kTilePixels,
                          {1 / kAccuracy, kLeastWeight, 0.01f});
    GlossSplat splat = gloss_splat(pack_record(r));
    const PackedFootprint packed = pack_footprint(r);
    std::copy(std::begin(packed.x), std::end(packed.x), splat.x);
    std::copy(std::begin(packed.y), std::end(packed.y), splat.y);
    std::copy(std::begin(packed.inverse), std::end(packed.inverse), splat.inverse);
    splat.inverse_shortest = packed.inverse_shortest, splat.per_radius = packed.per_radius;
    const std::vector<float> gloss = gloss_weights(splat, g);
    const Camera camera = test::look_at(r.position, r.position + Vec3(1, 0, 0), {0, 0, 1}, 1);
    const SplatBuffer by_gl = gl.splat(std::vector{r}, kAccuracy, g, camera);
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      ASSERT_EQ(gloss[i], tile->light[3][i]) << "place " << i;
      const Vec3 p(g.position[i]), n(g.normal[i]);
      const float found = tile->light[3][i];
      ASSERT_NEAR(found, weight_of(r, p, n), kSame) << "place " << i;
      ASSERT_NEAR(by_gl.light[i].w, found, kSame) << "place " << i;
      if (!(found > 0)) continue;
      ++lit;
      const Rgb light = extrapolate(r, p, n);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(tile->light[c][i], found * light[c], kSame * found * 4 * r.irradiance[c])
            << "place " << i;
        ASSERT_NEAR(by_gl.light[i][c], by_gl.light[i].w * light[c], kSame * found * 4 * r.irradiance[c])
            << "place " << i;
      }
    }
  }
  EXPECT_GT(lit, 1000);
}

}  // namespace
}  // namespace phos
