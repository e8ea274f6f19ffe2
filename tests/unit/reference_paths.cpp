// The path tracer's bookkeeping: layers, bounces, determinism, files of points.
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "reference/bidirectional_points.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/scenes.h"

namespace {

using namespace phos;

Image render(const Scene& scene, const ReferenceOptions& options) {
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  return render_reference(rays, luminaires, scene.camera[0], options).image;
}

ReferenceOptions small(std::int64_t samples = 16) {
  ReferenceOptions options;
  options.width = options.height = 20, options.samples = samples;
  return options;
}

double mean(const std::vector<Rgb>& layer) {
  double sum = 0;
  for (const Rgb& c : layer) sum += luminance(c);
  return sum / static_cast<double>(layer.size());
}

TEST(ReferencePaths, SameBytesForAnyNumberOfThreads) {
  const Scene scene = test::cornell();
  set_threads(1);
  const Image one = render(scene, small());
  set_threads(4);
  const Image four = render(scene, small());
  set_threads(0);
  EXPECT_EQ(one.channels(), four.channels());
}

TEST(ReferencePaths, PointsSameBytesForAnyNumberOfThreads) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  set_threads(1);
  const PointIrradiance one = estimate_irradiance(rays, luminaires, {0.45f, 0, 0.1f}, {0, 1, 0}, 3000);
  set_threads(3);
  const PointIrradiance three = estimate_irradiance(rays, luminaires, {0.45f, 0, 0.1f}, {0, 1, 0}, 3000);
  set_threads(0);
  EXPECT_EQ(one.illuminance_lx, three.illuminance_lx);
  EXPECT_EQ(one.stderr_lx, three.stderr_lx);
  EXPECT_GT(one.illuminance_lx, 0);
}

TEST(ReferencePaths, BothEndsSameBytesForAnyNumberOfThreads) {
  Scene scene = test::cornell();
  for (Material& m : scene.material)
    if (!m.emits() && m.name != scene.material[0].name) m.model = Model::mirror, m.ks = Rgb(0.5f);
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  ReferenceOptions options = small(2);
  options.method = ReferenceMethod::bidirectional;
  PointOptions points;
  points.samples = 256;
  const std::vector<SensorPoint> sensors{{{0.45f, 0, 0.1f}, {0, 1, 0}}, {{0.2f, 0.1f, 0.1f}, {0, 0, 1}}};
  set_threads(1);
  const Image one = render(scene, options);
  const auto lux = estimate_bidirectionally(rays, luminaires, sensors, points);
  set_threads(3);
  const Image three = render(scene, options);
  const auto again = estimate_bidirectionally(rays, luminaires, sensors, points);
  set_threads(0);
  EXPECT_EQ(one.channels(), three.channels());
  for (std::size_t i = 0; i < lux.size(); ++i) {
    EXPECT_EQ(lux[i].illuminance_lx, again[i].illuminance_lx);
    EXPECT_EQ(lux[i].stderr_lx, again[i].stderr_lx);
    EXPECT_GT(lux[i].illuminance_lx, 0);
  }
}

TEST(ReferencePaths, SeedsDiffer) {
  ReferenceOptions options = small();
  const Scene scene = test::cornell();
  const Image a = render(scene, options);
  options.seed = 1;
  EXPECT_NE(a.channels(), render(scene, options).channels());
}

TEST(ReferencePaths, LayersAddUp) {
  const Image image = render(test::cornell(), small());
  const auto beauty = image.rgb(""), emission = image.rgb("emission"), direct = image.rgb("direct"),
             indirect = image.rgb("indirect");
  for (std::size_t i = 0; i < beauty.size(); ++i) {
    const Rgb sum = emission[i] + direct[i] + indirect[i];
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(beauty[i][k], sum[k], 1e-5f * sum[k]);
  }
  EXPECT_GT(mean(indirect), 0);
}

TEST(ReferencePaths, BouncesSelectLayers) {
  const Scene scene = test::cornell();
  ReferenceOptions options = small();
  const Image all = render(scene, options);
  options.path.bounces = 0;
  const Image none = render(scene, options);
  EXPECT_EQ(mean(none.rgb("direct")), 0);
  EXPECT_EQ(mean(none.rgb("indirect")), 0);
  EXPECT_EQ(none.rgb("emission"), all.rgb("emission"));
  options.path.bounces = 1;
  const Image direct = render(scene, options);
  EXPECT_EQ(mean(direct.rgb("indirect")), 0);
  EXPECT_EQ(direct.rgb("direct"), all.rgb("direct"));
  options.path.bounces = 2;
  const Image first = render(scene, options);
  EXPECT_GT(mean(first.rgb("indirect")), 0);
  EXPECT_LT(mean(first.rgb("indirect")), mean(all.rgb("indirect")));
}

/// What the Lambert part of a surface makes of indirect light is kd / pi times its illuminance, whatever the
/// gloss above it does; the rest is the layer of gloss.
TEST(ReferencePaths, GlossIsALayerOfItsOwn) {
  Scene scene = test::cornell();
  for (Material& m : scene.material) {
    if (m.emits()) continue;
    m.model = Model::phong;
    m.kd = Rgb(0.5f), m.ks = Rgb(0.3f), m.exponent = 10;
  }
  finalize(scene);
  ReferenceOptions options = small(256);
  options.illuminance = true;
  const Image all = render(scene, options);
  options.path.bounces = 1;
  const Image direct = render(scene, options);
  ASSERT_TRUE(all.has_layer("glossy"));
  EXPECT_FALSE(direct.has_layer("glossy"));
  const auto beauty = all.rgb(""), emission = all.rgb("emission"), straight = all.rgb("direct"),
             indirect = all.rgb("indirect"), glossy = all.rgb("glossy");
  double lambert = 0, around_lx = 0;
  for (std::size_t i = 0; i < beauty.size(); ++i) {
    const Rgb sum = emission[i] + straight[i] + indirect[i] + glossy[i];
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(beauty[i][k], sum[k], 1e-5f * sum[k]);
    if (max_component(emission[i]) > 0) continue;
    lambert += luminance(indirect[i]);
    around_lx += all.channel("illuminance.Y")[i] - direct.channel("illuminance.Y")[i];
  }
  EXPECT_NEAR(lambert / (0.5 / std::numbers::pi * around_lx), 1, 0.03);
  EXPECT_GT(mean(glossy), 0.1 * mean(indirect));
}

/// A perfect mirror shows the lit floor: all in the specular layer, reflectance times what is seen there.
TEST(ReferencePaths, MirrorIsSpecular) {
  Scene scene = test::point_light_over_plane().scene;
  Material mirror;
  mirror.name = "mirror";
  mirror.model = Model::mirror;
  mirror.ks = Rgb(0.8f);
  scene.material.push_back(mirror);
  test::begin_instance(scene, "mirror", 1);
  test::add_quad(scene, {-8, 0, -8}, {16, 0, 0}, {0, 6, 0});  // z = -8, facing +z
  scene.camera[0] = test::look_at({0, 2, 2}, {0, 2, -8}, {0, 1, 0}, 0.3f);
  finalize(scene);
  const Image image = render(scene, small(64));
  ASSERT_TRUE(image.has_layer("specular"));
  const auto beauty = image.rgb(""), specular = image.rgb("specular");
  for (std::size_t i = 0; i < beauty.size(); ++i) EXPECT_EQ(beauty[i], specular[i]);
  // The lowest row looks down at the floor by way of the mirror: somewhere it is lit.
  EXPECT_GT(mean(specular), 0);
}

TEST(ReferencePaths, NoLightIsBlack) {
  Scene scene = test::point_light_over_plane().scene;
  scene.light.clear();
  finalize(scene);
  const Image image = render(scene, small());
  for (const char* layer : {"", "direct", "indirect", "emission", "stderr"})
    EXPECT_EQ(mean(image.rgb(layer)), 0);
}

TEST(ReferencePaths, ReadsPoints) {
  const auto points = parse_sensor_points(
      "id,x,y,z,note,nx,ny,nz\n# desk\na,1,2,3,,0,2,0\r\n\nb, 4 , 5 , 6 , 7 , 0 , 0 , -1\n", "p.csv");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(points[0].normal, Vec3(0, 1, 0));
  EXPECT_EQ(points[1].position, Vec3(4, 5, 6));
  EXPECT_EQ(points[1].normal, Vec3(0, 0, -1));
  EXPECT_EQ(parse_sensor_points("1 2 3 0 1 0\n", "p.csv").size(), 1u);
}

TEST(ReferencePaths, RefusesBadPoints) {
  for (const char* csv : {"", "x,y,z,nx,ny,nz\n", "1,2,3\n", "1,2,3,0,0,0\n", "1,2,nan,0,1,0\n",
                          "1,2,3,0,one,0\n", "1,2,3,0,1,0\nx,y,z,nx,ny,nz\n", "1e99,0,0,0,1,0\n"}) {
    EXPECT_THROW(parse_sensor_points(csv, "p.csv"), Error) << csv;
  }
  try {
    parse_sensor_points("1,2,3,0,1,0\n1,2\n", "p.csv");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_EQ(e.where(), "p.csv:2");
  }
}

TEST(ReferencePaths, WritesPoints) {
  PointIrradiance light;
  light.irradiance_lx = {1, 2, 3};
  light.illuminance_lx = 1.5;
  light.illuminance_stderr_lx = 0.25;
  EXPECT_EQ(sensor_csv({{{0, 0.5f, 0}, {0, 1, 0}}}, {light}),
            "x,y,z,nx,ny,nz,illuminance_lx,stderr_lx,r_lx,g_lx,b_lx\n0,0.5,0,0,1,0,1.5,0.25,1,2,3\n");
}

TEST(ReferencePaths, PointsStopAtTheAskedError) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  PointOptions options;
  options.samples = 1 << 20, options.relative_error = 0.05;
  const PointIrradiance e = estimate_irradiance(rays, luminaires, {0.45f, 0, 0.1f}, {0, 1, 0}, options);
  EXPECT_LE(e.illuminance_stderr_lx, 0.05 * e.illuminance_lx);
  EXPECT_LT(e.samples, 10000u);
}

TEST(ReferencePaths, SizeFromAspect) {
  Camera camera;
  camera.aspect = 2;
  ReferenceOptions options;
  resolve_size(options, camera);
  EXPECT_EQ(options.width, 512);
  EXPECT_EQ(options.height, 256);
  options.width = 0, options.height = 100;
  resolve_size(options, camera);
  EXPECT_EQ(options.width, 200);
  options.width = options.height = 65536;
  EXPECT_THROW(resolve_size(options, camera), Error);
}

}  // namespace
