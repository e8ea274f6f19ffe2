// Shading of visible points: every way of splitting the light between shadow rays and gloss rays gives the
// same, mirrors show what stands before them, and caches that hold direct light are not lit twice.
#include <gtest/gtest.h>

#include "estimate/shading.h"
#include "record/tree.h"
#include "support/one_material.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr float kLuminance = 50;

/// A black room of 4 m whose walls emit kLuminance, and a sheet of the material in it, facing +y.
Scene lit_sheet(const Material& material) {
  Scene scene;
  begin_instance(scene, "sky", add_lambert(scene, "sky", 0, kLuminance));
  add_room(scene, Vec3(-2), Vec3(2));
  scene.material.push_back(material);
  scene.measured = measured_tables();
  begin_instance(scene, "sheet", 1);
  add_quad(scene, {-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0});
  finalize(scene);
  return scene;
}

Vec3 towards(float cosine, float azimuth) {
  const float sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), cosine, sine * std::sin(azimuth)};
}

/// That scene, shaded without records.
struct LitSheet {
  explicit LitSheet(const Material& material) : scene(lit_sheet(material)), rays(scene), lights(scene) {}
  LitSheet(const LitSheet&) = delete;
  Scene scene;
  RayScene rays;
  Luminaires lights;
  RecordTree no_records{scene.bounds, 0.2};
};

SurfacePoint sheet_seen_from(const RayScene& rays, const Vec3& wo) {
  SurfacePoint point;
  EXPECT_TRUE(trace(rays, {Vec3(0.01f, 0, 0.02f) + 0.5f * wo, -wo}, point));
  return point;
}

/// Integral of f cos over the hemisphere about +y: directions of a low-discrepancy sequence, cosine density.
Rgb albedo(const Bsdf& bsdf, const Vec3& wo, bool gloss_only) {
  constexpr int kPoints = 1 << 17;
  DVec3 sum(0);
  for (int i = 0; i < kPoints; ++i) {
    const double u = (i + 0.5) / kPoints, v = std::fmod(i * 0.6180339887498949, 1.0);
    const Vec3 wi = towards(static_cast<float>(std::sqrt(1 - u)), static_cast<float>(2 * M_PI * v));
    sum += DVec3(gloss_only ? bsdf.evaluate_gloss(wo, wi) : bsdf.evaluate(wo, wi));
  }
  return Rgb(sum * (M_PI / kPoints));
}

struct Split {
  int light_samples, gloss_samples;
};

/// Mean of what light(random) gives with other random numbers each time, and its standard error, in units of
/// kLuminance.
template <class Light>
void repeat(int times, Rgb& mean, Rgb& error, const Light& light) {
  DVec3 sum(0), square(0);
  for (int k = 0; k < times; ++k) {
    RandomStream random(7, Stage::test, static_cast<std::uint64_t>(k));
    const DVec3 v(light(random) / kLuminance);
    sum += v, square += v * v;
  }
  const DVec3 m = sum / double(times);
  mean = Rgb(m);
  error = Rgb(glm::sqrt(glm::max(square / double(times) - m * m, DVec3(0)) / double(times - 1)));
}

/// Mean of direct() + gloss(), and its standard error, in units of kLuminance.
void measure(const Shading& shading, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, Split split,
             Rgb& mean, Rgb& error) {
  ShadingLog log;
  repeat(400, mean, error, [&](RandomStream& random) {
    Rgb light(0);
    if (split.light_samples > 0)
      light += shading.direct(point, bsdf, wo, split.light_samples, split.gloss_samples, random).radiance;
    const GlossLight gloss =
        shading.gloss(point, bsdf, wo, split.gloss_samples, split.light_samples, 0, random, random, log);
    EXPECT_EQ(gloss.radiance, Rgb(0));  // black walls show nothing but their own light
    return light + gloss.from_lamps;
  });
}

/// In an even surrounding a surface shows L x integral(f cos), however its light is split.
TEST(Gloss, EverySplitOfTheLightGivesTheAlbedo) {
  for (const Named& model : models()) {
    const LitSheet sheet(model.material);
    const Shading shading(sheet.rays, sheet.lights, sheet.no_records, {});
    for (const float cosine : {1.f, 0.6f}) {
      const Vec3 wo = towards(cosine, 1.1f);
      const SurfacePoint point = sheet_seen_from(sheet.rays, wo);
      const Bsdf bsdf(sheet.scene, point);
      const Rgb all = albedo(bsdf, wo, false), gloss = albedo(bsdf, wo, true);
      for (const Split split : {Split{64, 0}, Split{16, 8}, Split{2, 16}, Split{0, 64}}) {
        Rgb mean, error;
        measure(shading, point, bsdf, wo, split, mean, error);
        const Rgb truth = split.light_samples > 0 ? all : gloss;
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(mean[c], truth[c], 5 * error[c] + 0.01f)
              << model.name << ", cosine " << cosine << ", " << split.light_samples << " + "
              << split.gloss_samples;
      }
    }
  }
}

/// So does a place that a ray or a mirror finds, whether eight samples of the lamps and as many rays of gloss
/// are taken there, or one of one lamp, with gloss by chance.
TEST(Gloss, PlacesThatRaysFindShowTheAlbedo) {
  for (const Named& model : models()) {
    const LitSheet sheet(model.material);
    const Shading shading(sheet.rays, sheet.lights, sheet.no_records, {});
    for (const float cosine : {1.f, 0.3f}) {
      const Vec3 wo = towards(cosine, 1.1f);
      const SurfacePoint point = sheet_seen_from(sheet.rays, wo);
      const Bsdf bsdf(sheet.scene, point);
      if (bsdf.transmits_diffusely()) continue;
      Rgb truth = albedo(bsdf, wo, false);
      BsdfSample branch[2];
      const int branches = bsdf.specular_branches(wo, branch);
      for (int b = 0; b < branches; ++b) truth += branch[b].weight;
      for (const int light_samples : {8, 2, 1}) {
        Rgb mean, error;
        ShadingLog log;
        repeat(4000, mean, error, [&](RandomStream& random) {
          return shading.outgoing(point, wo, 1, Rgb(1), light_samples, random, log);
        });
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(mean[c], truth[c], 5 * error[c] + 0.005f)
              << model.name << ", cosine " << cosine << ", " << light_samples << " samples";
      }
    }
  }
}

/// Records that hold direct light have lit the Lambert part: direct() and gloss() add the rest.
TEST(CachedDirect, LeavesTheLambertPartToTheRecords) {
  for (const Named& model : models()) {
    const LitSheet sheet(model.material);
    ShadingOptions options;
    options.cached_direct = true;
    const Shading shading(sheet.rays, sheet.lights, sheet.no_records, options);
    const Vec3 wo = towards(0.6f, 1.1f);
    const SurfacePoint point = sheet_seen_from(sheet.rays, wo);
    const Bsdf bsdf(sheet.scene, point);
    const Rgb truth = albedo(bsdf, wo, true);
    Rgb mean, error;
    measure(shading, point, bsdf, wo, {16, 8}, mean, error);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], truth[c], 5 * error[c] + 0.01f) << model.name;
  }
}

/// A record that lights everything about it alike.
IrradianceRecord even_record(float irradiance_lx) {
  IrradianceRecord r;
  r.position = {0, -1, 0}, r.normal = {0, 1, 0};
  r.irradiance = Rgb(irradiance_lx);
  r.distance_m = r.radius_m = 100;
  for (int c = 0; c < 3; ++c) r.rotation_gradient[c] = r.translation_gradient[c] = Vec3(0);
  return r;
}

/// A mirror of reflectance 0.8 facing down at y = 1, a grey floor at y = -1 under a point lamp.
Scene mirror_over_floor() {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, {-3, -1, -3}, {0, 0, 6}, {6, 0, 0});
  scene.material.push_back(make_material(Model::mirror, Rgb(0), Rgb(0.8f)));
  begin_instance(scene, "mirror", 1);
  add_quad(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  add_point_light(scene, {0, 0, 0}, 40);
  finalize(scene);
  return scene;
}

TEST(Mirror, ShowsCacheAndDirectLight) {
  const Scene scene = mirror_over_floor();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RecordTree records(scene.bounds, 0.2);
  records.insert(even_record(30));
  const Vec3 wo = glm::normalize(Vec3(0.2f, -1, 0.1f));
  const Vec3 seen = Vec3(0.2f, 1, 0);
  SurfacePoint point;
  ASSERT_TRUE(trace(rays, {seen + 0.1f * wo, -wo}, point));
  const Bsdf bsdf(scene, point);
  // The floor point that the mirror shows, 2 m below, and its distance to the lamp 1 m above the floor.
  const Vec3 down = glm::normalize(Vec3(-0.2f, -1, -0.1f));
  const Vec3 floor = seen + down * (2 / -down.y);
  const double away = std::hypot(double(floor.x), double(floor.z));
  // Straight, and by the image that the lamp has in the mirror, 3 m above the floor.
  const double direct = point_over_plane_lx(40, 1, away) + 0.8 * point_over_plane_lx(40, 3, away);
  const auto show = [&](const ShadingOptions& options, ShadingLog& log) {
    const Shading shading(rays, lights, records, options);
    RandomStream random(1, Stage::test, 1);
    return static_cast<double>(shading.specular(point, bsdf, wo, 0, Rgb(1), false, random, log).y);
  };
  ShadingLog log;
  EXPECT_NEAR(show({}, log), 0.8 * 0.5 / M_PI * (30 + direct), 1e-3 * (30 + direct));
  ShadingOptions options;
  options.cached_direct = true;  // the 30 lx are all there is
  EXPECT_NEAR(show(options, log), 0.8 * 0.5 / M_PI * 30, 1e-3);
  options = {};
  options.reflect_direct = false;
  EXPECT_NEAR(show(options, log), 0.8 * 0.5 / M_PI * 30, 1e-3);
  EXPECT_TRUE(log.misses.empty());
  EXPECT_EQ(log.counters["specular paths cut"], 0u);
  options = {};
  options.specular_depth = 0;
  EXPECT_EQ(show(options, log), 0);
  EXPECT_EQ(log.counters["specular paths cut"], 1u);
}

TEST(Mirror, AMissIsLoggedWhereItIsSeen) {
  const Scene scene = mirror_over_floor();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordTree no_records(scene.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {});
  SurfacePoint point;
  ASSERT_TRUE(trace(rays, {{0.2f, 0.5f, 0.3f}, {0, 1, 0}}, point));
  ShadingLog log;
  RandomStream random(1, Stage::test, 1);
  shading.specular(point, Bsdf(scene, point), {0, -1, 0}, 0, Rgb(1), false, random, log);
  ASSERT_EQ(log.misses.size(), 1u);
  EXPECT_NEAR(glm::distance(log.misses[0].position, Vec3(0.2f, -1, 0.3f)), 0, 1e-5f);
  EXPECT_EQ(log.misses[0].normal, Vec3(0, 1, 0));
}

/// Two mirrors face to face, a lamp shining through neither: n reflections of 0.8 and then the depth ends.
TEST(Mirror, EndlessReflectionsEndAtTheDepth) {
  Scene scene;
  scene.material.push_back(make_material(Model::mirror, Rgb(0), Rgb(0.8f)));
  begin_instance(scene, "mirrors", 0);
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  add_quad(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordTree no_records(scene.bounds, 0.2);
  ShadingOptions options;
  options.specular_depth = 5;
  const Shading shading(rays, lights, no_records, options);
  SurfacePoint point;
  ASSERT_TRUE(trace(rays, {{0, 0.5f, 0}, {0, 1, 0}}, point));
  ShadingLog log;
  RandomStream random(1, Stage::test, 1);
  EXPECT_EQ(shading.specular(point, Bsdf(scene, point), {0, -1, 0}, 0, Rgb(1), false, random, log), Rgb(0));
  EXPECT_EQ(log.counters["specular paths cut"], 1u);
}

/// A pane seen from one end leads light from a lamp beyond the other end, by some 40 total reflections.
/// Entering and leaving it costs Fresnel's share each; what the ends reflect back and forth is next to
/// nothing.
TEST(Glass, LeadsLightFromEndToEnd) {
  constexpr double kIndex = 1.5, kTurns = 40.5, kThick_m = 0.01, kOutside = 0.45;
  const double sine = kOutside / kIndex, cosine = std::sqrt(1 - sine * sine);
  const auto length = static_cast<float>(kTurns * kThick_m * cosine / sine),
             thick = static_cast<float>(kThick_m);
  Scene scene;
  begin_instance(scene, "lamp", add_lambert(scene, "lamp", 0, kLuminance));
  add_quad(scene, {length + 0.01f, -1, -1}, {0, 0, 2}, {0, 2, 0});
  scene.material.push_back(make_material(Model::dielectric, Rgb(0), Rgb(1)));
  begin_instance(scene, "pane", 1);
  const Vec3 x(length, 0, 0), y(0, thick, 0), z(0, 0, 1), corner(0, 0, -0.5f);
  add_quad(scene, corner, x, z), add_quad(scene, corner + y, z, x);  // outwards: -y, +y
  add_quad(scene, corner, z, y), add_quad(scene, corner + x, y, z);  // -x, +x
  add_quad(scene, corner, y, x), add_quad(scene, corner + z, x, y);  // -z, +z
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordTree no_records(scene.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {});
  const auto out = static_cast<float>(std::sqrt(1 - kOutside * kOutside));
  const Vec3 way(out, static_cast<float>(kOutside), 0), end(0, thick / 2, 0);
  SurfacePoint point;
  ASSERT_TRUE(trace(rays, {end - 0.1f * way, way}, point));
  ShadingLog log;
  RandomStream random(1, Stage::test, 1);
  const Rgb seen = shading.specular(point, Bsdf(scene, point), -way, 0, Rgb(1), false, random, log);
  const double across = (out - kIndex * cosine) / (out + kIndex * cosine),
               along = (kIndex * out - cosine) / (kIndex * out + cosine);
  const double lost = (across * across + along * along) / 2;
  EXPECT_NEAR(static_cast<double>(seen.y), kLuminance * (1 - lost) * (1 - lost), 0.003 * kLuminance);
}

/// However many mirrors and panes it is seen by way of, a sharp lobe shows the lamps that it points to,
/// without rare samples of great weight.
TEST(Gloss, IsSeenAsWellByWayOfOthers) {
  Material sharp = make_material(Model::phong, Rgb(0), Rgb(0.6f));
  sharp.exponent = 20000;
  const Scene scene = lit_sheet(sharp);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordTree no_records(scene.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {});
  const Vec3 wo = towards(0.8f, 0.4f);
  const SurfacePoint point = sheet_seen_from(rays, wo);
  const double expected = 0.8 * 0.6 * double(kLuminance);  // modified Phong: the cosine stays
  for (const int depth : {0, 2, 3, 10}) {
    constexpr int kDraws = 4000;
    double sum = 0, greatest = 0;
    ShadingLog log;
    for (int k = 0; k < kDraws; ++k) {
      RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
      const double light = double(shading.outgoing(point, wo, depth, Rgb(1), 1, random, log).y);
      sum += light, greatest = std::max(greatest, light);
    }
    EXPECT_NEAR(sum / kDraws, expected, 0.08 * expected) << depth;
    EXPECT_LT(greatest, 2.5 * expected) << depth;
  }
}

/// A pane of thin glass lets 1 - 2F/(1+F) through and sends the rest back.
TEST(Glass, APaneSplitsTheLight) {
  Scene scene;
  begin_instance(scene, "left", add_lambert(scene, "left", 0, 10));
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});  // at z = 0, facing +z
  begin_instance(scene, "right", add_lambert(scene, "right", 0, 1000));
  add_quad(scene, {-1, -1, 2}, {0, 2, 0}, {2, 0, 0});  // at z = 2, facing -z
  Material pane = make_material(Model::thin_dielectric, Rgb(0), Rgb(0));
  pane.ior = 1.5f;
  scene.material.push_back(pane);
  begin_instance(scene, "pane", 2);
  add_quad(scene, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordTree no_records(scene.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {});
  SurfacePoint point;
  ASSERT_TRUE(trace(rays, {{0.1f, 0.2f, 0.5f}, {0, 0, 1}}, point));
  ShadingLog log;
  RandomStream random(1, Stage::test, 1);
  const double f = 0.04, back = 2 * f / (1 + f);
  EXPECT_NEAR(shading.specular(point, Bsdf(scene, point), {0, 0, -1}, 0, Rgb(1), false, random, log).y,
              back * 10 + (1 - back) * 1000, 0.01);
}

}  // namespace
}  // namespace phos::test
