// Paths from both ends against closed forms, and against paths from the eye alone, within their own standard
// errors: also where light comes by mirrors and glass.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/sampling.h"
#include "reference/bidirectional_points.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/reference.h"
#include "support/scenes.h"

namespace {

using namespace phos;
using test::AnalyticScene;
using test::expect_within;

struct Lit : test::RaysAndLamps {
  using RaysAndLamps::RaysAndLamps;
  std::vector<PointIrradiance> measure(const std::vector<SensorPoint>& sensors, std::int64_t samples,
                                       std::int64_t bounces = -1) const {
    PointOptions options;
    options.samples = samples;
    options.path.bounces = bounces;
    return estimate_bidirectionally(rays, luminaires, sensors, options);
  }
};

void check_points(const AnalyticScene& s, std::int64_t samples, double relative) {
  std::vector<SensorPoint> sensors;
  for (const test::Check& check : s.checks) sensors.push_back({check.position, check.normal});
  const auto light = Lit(s.scene).measure(sensors, samples);
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_EQ(light[i].rejected, 0u);
    expect_within(light[i].illuminance_lx, light[i].illuminance_stderr_lx, s.checks[i].irradiance_lx,
                  relative, text(s.name, ", sensor ", i));
  }
}

std::uint32_t add_material(Scene& scene, Model model, float ks) {
  Material m;
  m.model = model;
  m.ks = Rgb(ks), m.kd = Rgb(1);
  scene.material.push_back(m);
  return static_cast<std::uint32_t>(scene.material.size() - 1);
}

TEST(BidirectionalAnalytic, PointScenes) {
  for (const AnalyticScene& s : test::all_point_scenes())
    if (s.name.find("furnace") == std::string::npos) check_points(s, 4096, 0.05);
}

TEST(BidirectionalAnalytic, Furnace) {
  for (const float albedo : {0.f, 0.5f, 0.9f}) check_points(test::furnace(albedo), 4096, 0.03);
}

TEST(BidirectionalAnalytic, FurnaceBounceByBounce) {
  const float albedo = 0.9f;
  const AnalyticScene s = test::furnace(albedo);
  const Lit lit(s.scene);
  for (const std::int64_t bounces : {0, 1, 2, 3, 6}) {
    const auto e = lit.measure({{s.checks[0].position, s.checks[0].normal}}, 4096, bounces);
    const double expected = bounces == 0 ? 0 : test::furnace_lx(1, albedo, static_cast<int>(bounces) - 1);
    expect_within(e[0].illuminance_lx, e[0].illuminance_stderr_lx, expected, 0.03, text(bounces, " bounces"));
  }
}

TEST(BidirectionalAnalytic, AnyScale) {
  for (const float factor : {1e-6f, 1e6f}) {
    check_points(scaled(test::rectangle_light_parallel(), factor), 1024, 0.1);
    check_points(scaled(test::furnace(0.5f), factor), 1024, 0.1);
  }
}

/// Sensors spread evenly over the inside of a box, with the normals of its walls.
std::vector<SensorPoint> over_box(const Vec3& size, std::size_t n, const std::vector<int>& walls) {
  std::vector<double> cdf;
  double area = 0;
  for (const int w : walls) {
    const int axis = w / 2;
    const float side = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    cdf.push_back(area += static_cast<double>(side));
  }
  std::vector<SensorPoint> sensors;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(n) * area;
    const auto k = static_cast<std::size_t>(std::lower_bound(cdf.begin(), cdf.end(), u) - cdf.begin());
    const int axis = walls[k] / 2;
    const Vec2 st = r2_point(static_cast<int>(i), {0.5f, 0.5f});
    SensorPoint s;
    s.position[axis] = walls[k] % 2 ? size[axis] : 0;
    s.position[(axis + 1) % 3] = st.x * size[(axis + 1) % 3];
    s.position[(axis + 2) % 3] = st.y * size[(axis + 2) % 3];
    s.normal = Vec3(0);
    s.normal[axis] = walls[k] % 2 ? -1 : 1;
    sensors.push_back(s);
  }
  return sensors;
}

struct Mean {
  double lux = 0, error = 0;  // error: mean of the sensors' own
};

Mean mean_of(const std::vector<PointIrradiance>& light) {
  double sum = 0, errors = 0;
  for (const PointIrradiance& e : light) sum += e.illuminance_lx, errors += e.illuminance_stderr_lx;
  const auto n = static_cast<double>(light.size());
  return {sum / n, errors / n};
}

/// A wall that is a mirror of reflectance rho shows the lamp's image: rho I h / d'^3, d' from the image.
TEST(BidirectionalAnalytic, MirrorWallShowsTheLampsImage) {
  AnalyticScene s;
  s.name = "mirror wall";
  test::begin_instance(s.scene, "floor", test::add_lambert(s.scene, "black", 0));
  test::add_quad(s.scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  test::begin_instance(s.scene, "mirror", add_material(s.scene, Model::mirror, 0.8f));
  test::add_quad(s.scene, {4, 0, 0}, {0, 0, 4}, {0, 3, 0});
  test::add_point_light(s.scene, {1, 2, 2}, 1000);
  finalize(s.scene);
  s.irradiance_lx = [](const Vec3& p, const Vec3&) {
    const auto from = [&](double x) {
      return test::point_over_plane_lx(1000, 2, std::hypot(double(p.x) - x, double(p.z) - 2));
    };
    return from(1) + 0.8 * from(7);
  };
  for (const Vec2& x : {Vec2{0.5f, 0.5f}, Vec2{2, 2}, Vec2{3.5f, 2.5f}, Vec2{3.9f, 1}})
    s.check_at({x.x, 0, x.y}, {0, 1, 0});
  check_points(s, 4096, 0.06);
}

/// Grey, but for the wall at x = 1.999, which is a mirror before another.
Scene grey_box_with_mirror() {
  Scene scene;
  test::begin_instance(scene, "walls", test::add_lambert(scene, "grey", 0.5f));
  test::add_room(scene, Vec3(0), Vec3(2, 1, 1.5f));
  test::begin_instance(scene, "mirror", add_material(scene, Model::mirror, 1));
  test::add_quad(scene, {1.999f, 0, 0}, {0, 0, 1.5f}, {0, 1, 0});
  test::add_point_light(scene, {0.7f, 0.6f, 0.5f}, 100 / (4 * kPi));
  scene.camera.push_back(test::look_at({0.4f, 0.7f, 1}, {1.9f, 0, 0.6f}, {0, 1, 0}, 0.3f));
  finalize(scene);
  return scene;
}

/// The grey walls absorb what the lamp sends: (1 - albedo) x their area x mean = flux; much of it comes by
/// the mirror, and between mirrors.
TEST(BidirectionalAnalytic, GreyBoxWithMirrorWall) {
  const Scene scene = grey_box_with_mirror();
  const Vec3 inner(1.999f, 1, 1.5f);
  const Mean mean = mean_of(Lit(scene).measure(over_box(inner, 200, {0, 2, 3, 4, 5}), 256));
  const double grey_m2 = 1.5 + 2 * 2 * 1.5 + 2 * 2 * 1;
  EXPECT_NEAR(mean.lux * grey_m2 * 0.5 / 100, 1, 0.02);
}

/// What a camera sees straight away and in the mirror is what sensors there measure: L = albedo E / pi.
TEST(BidirectionalAnalytic, PictureShowsWhatSensorsMeasure) {
  Scene scene = grey_box_with_mirror();
  for (const bool perspective : {true, false}) {
    scene.camera[0].perspective = perspective;
    scene.camera[0].ymag_m = 0.2f;
    const Lit lit(scene);
    ReferenceOptions options;
    options.width = 12, options.height = 8, options.samples = 128;
    options.method = ReferenceMethod::bidirectional;
    options.illuminance = true;
    const Image image = render_reference(lit.rays, lit.luminaires, scene.camera[0], options).image;
    std::vector<SensorPoint> sensors;
    std::vector<bool> mirrored;
    for (int i = 0; i < 12 * 8; ++i) {
      const Camera::Ray eye = scene.camera[0].ray(
          {(static_cast<float>(i % 12) + 0.5f) / 12, (static_cast<float>(i / 12) + 0.5f) / 8}, 1.5f);
      SurfacePoint p;
      ASSERT_TRUE(trace(lit.rays, {eye.origin, eye.direction, 0, kInfinity}, p));
      mirrored.push_back(p.material == 1);
      if (mirrored.back()) {
        const Vec3 back = glm::reflect(eye.direction, p.geometric_normal);
        ASSERT_TRUE(trace(lit.rays, {p.leave(back), back, 0, kInfinity}, p));
      }
      sensors.push_back({p.position, p.geometric_normal});
    }
    const auto light = lit.measure(sensors, 512);
    const auto beauty = image.rgb("");
    const auto lux = image.channel("illuminance.Y");
    for (const bool by_mirror : {false, true}) {
      double seen = 0, measured = 0, layer = 0;
      for (std::size_t i = 0; i < sensors.size(); ++i)
        if (mirrored[i] == by_mirror)
          seen += double(luminance(beauty[i])), measured += light[i].illuminance_lx * 0.5 / std::numbers::pi,
              layer += double(lux[i]) * 0.5 / std::numbers::pi;
      ASSERT_GT(measured, 0) << by_mirror;
      EXPECT_NEAR(seen / measured, 1, 0.05) << "by mirror: " << by_mirror << ", perspective: " << perspective;
      if (!by_mirror) {
        EXPECT_NEAR(layer / measured, 1, 0.05) << "illuminance, perspective: " << perspective;
      }
    }
  }
}

/// A black partition stands on a grey floor; all light, straight and by a mirror, is on one side of it. Light
/// paths that end within the radius of merging are not merged with what lies behind the partition.
TEST(BidirectionalAnalytic, NoLightLeaksUnderAWall) {
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "grey", 0.5f));
  test::add_quad(scene, {-4, 0, 0}, {0, 0, 4}, {8, 0, 0});
  test::begin_instance(scene, "partition", test::add_lambert(scene, "black", 0));
  test::add_quad(scene, {0, 0, 0}, {0, 0, 4}, {0, 4, 0});
  test::begin_instance(scene, "mirror", add_material(scene, Model::mirror, 1));
  test::add_quad(scene, {4, 0, 0}, {0, 0, 4}, {0, 3, 0});
  test::add_point_light(scene, {1, 2, 2}, 1000);
  // Floor of 0.1 m on this side of the partition, and of as much on the other.
  for (const float side : {-1.f, 1.f})
    scene.camera.push_back(
        test::look_at({0.05f * side, 2, 2}, {0.05f * side, 0, 2}, {0, 0, 1}, 2 * std::atan(0.02f)));
  finalize(scene);
  const Lit lit(scene);
  ReferenceOptions options;
  options.width = options.height = 8, options.samples = 16;
  options.method = ReferenceMethod::bidirectional;
  options.illuminance = true;
  for (const Camera& camera : scene.camera) {
    const Image image = render_reference(lit.rays, lit.luminaires, camera, options).image;
    double light = 0, lux = 0;
    for (const Rgb& c : image.rgb("")) light += static_cast<double>(luminance(c)) / 64;
    for (const float e : image.channel("illuminance.Y")) lux += static_cast<double>(e) / 64;
    if (&camera == &scene.camera[0]) {
      EXPECT_EQ(light, 0);
      EXPECT_EQ(lux, 0);
    } else {
      EXPECT_NEAR(light / lux, 0.5 / std::numbers::pi, 0.1 * 0.5 / std::numbers::pi);
    }
  }
}

/// Nothing gets out of a cup: sensors outside read 0, however near to the wall their discs lie.
TEST(BidirectionalAnalytic, NoLightLeaksOutOfAMirrorCup) {
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "black", 0));
  test::add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  test::begin_instance(scene, "cup", add_material(scene, Model::mirror, 0.8f));
  constexpr int kSides = 64;
  const auto corner = [](int k) {
    const float angle = 2 * kPi * static_cast<float>(k % kSides) / kSides;
    return Vec3(std::cos(angle), 0, std::sin(angle));
  };
  for (int k = 0; k < kSides; ++k) test::add_quad(scene, corner(k), corner(k + 1) - corner(k), {0, 1, 0});
  test::add_point_light(scene, {0, 0.5f, 0}, 1000);
  finalize(scene);
  std::vector<SensorPoint> sensors;
  for (const float r : {1.002f, 1.01f, 1.03f, 1.1f, 1.3f, 0.9f})
    sensors.push_back({r * Vec3(std::cos(0.3f), 0, std::sin(0.3f)), {0, 1, 0}});
  const auto light = Lit(scene).measure(sensors, 64);
  for (std::size_t i = 0; i + 1 < light.size(); ++i) EXPECT_EQ(light[i].illuminance_lx, 0) << i;
  EXPECT_GT(light.back().illuminance_lx, 100);
}

/// Twelve pentagons' worth of triangles about a ball, refined; vertex normals are the sphere's.
void add_ball(Scene& scene, const Vec3& centre, float radius_m) {
  const AnalyticScene sphere = test::integrating_sphere(0.5f, 5120, radius_m);
  const auto first = static_cast<std::uint32_t>(scene.position.size());
  for (const Vec3& p : sphere.scene.position) {
    scene.position.push_back(p + centre);
    scene.normal.push_back(glm::normalize(p));
  }
  for (const Triangle& t : sphere.scene.triangle) {
    const Vec3 a = sphere.scene.position[t.v[0]], b = sphere.scene.position[t.v[1]],
               c = sphere.scene.position[t.v[2]];
    const bool outward = glm::dot(glm::cross(b - a, c - a), a + b + c) > 0;
    scene.triangle.push_back({{first + t.v[0], first + t.v[outward ? 1 : 2], first + t.v[outward ? 2 : 1]}});
    scene.triangle_instance.push_back(static_cast<std::uint32_t>(scene.instance.size() - 1));
    ++scene.instance.back().triangle_count;
  }
}

/// A ball of glass without absorption in a black box: what the lamp sends all comes to the walls, a part of
/// it as a caustic.
TEST(BidirectionalAnalytic, LightThroughGlassBallIsAllThere) {
  Scene scene;
  const Vec3 size(1, 1, 1);
  test::begin_instance(scene, "walls", test::add_lambert(scene, "black", 0));
  test::add_room(scene, Vec3(0), size);
  test::begin_instance(scene, "ball", add_material(scene, Model::dielectric, 0));
  add_ball(scene, {0.53f, 0.4f, 0.46f}, 0.2f);
  test::add_point_light(scene, {0.53f, 0.85f, 0.46f}, 100 / (4 * kPi));
  finalize(scene);
  const Lit lit(scene);
  const auto lumens = [&](std::vector<SensorPoint> sensors, double area) {
    return mean_of(lit.measure(sensors, 16)).lux * area;
  };
  // The caustic lies below the ball, brightest on the axis: the floor is measured more closely there.
  const auto below = [](const SensorPoint& s) {
    return std::max(std::fabs(s.position.x - 0.53f), std::fabs(s.position.z - 0.46f)) < 0.15f;
  };
  std::vector<SensorPoint> near = over_box(size, 4000, {2}), about = over_box(size, 300, {2});
  std::erase_if(near, [&](const SensorPoint& s) { return !below(s); });
  std::erase_if(about, below);
  const double flux =
      lumens(near, 0.09) + lumens(about, 0.91) + lumens(over_box(size, 200, {0, 1, 3, 4, 5}), 5);
  EXPECT_NEAR(flux / 100, 1, 0.03);
}

TEST(BidirectionalAnalytic, PictureIsThatOfPathTracing) {
  const Scene scene = test::cornell();
  const Lit lit(scene);
  ReferenceOptions options;
  options.width = options.height = 16, options.samples = 128;
  const Image path = render_reference(lit.rays, lit.luminaires, scene.camera[0], options).image;
  options.method = ReferenceMethod::bidirectional;
  const Image both = render_reference(lit.rays, lit.luminaires, scene.camera[0], options).image;
  for (const char* layer : {"emission", "direct", "indirect"}) {
    double sum[2] = {0, 0};
    const auto a = path.rgb(layer), b = both.rgb(layer);
    for (std::size_t i = 0; i < a.size(); ++i) sum[0] += luminance(a[i]), sum[1] += luminance(b[i]);
    EXPECT_NEAR(sum[1] / sum[0], 1, 0.02) << layer;
  }
  double z2 = 0, n = 0;
  const auto a = path.rgb(""), b = both.rgb(""), ea = path.rgb("stderr"), eb = both.rgb("stderr");
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double e = std::hypot(double(ea[i].y), double(eb[i].y));
    if (e > 0) z2 += std::pow((double(a[i].y) - double(b[i].y)) / e, 2), n += 1;
  }
  EXPECT_NEAR(z2 / n, 1, 5 * std::sqrt(2 / n));
}

}  // namespace
