// Light that comes by mirrors and glass alone: in records, on surfaces and in mid-air.
#include <gtest/gtest.h>

#include "estimate/caustic_light.h"
#include "estimate/gather.h"
#include "place/two_level.h"
#include "support/mirrors.h"
#include "support/records.h"
#include "support/sensors.h"

namespace phos::test {
namespace {

constexpr std::size_t kPhotons = 2048;

struct MirrorLight {
  MirrorBox box;
  Lit lit;
  CausticLight light;

  explicit MirrorLight(std::int64_t paths, std::uint64_t seed = 1)
      : lit(light_up(box.scene, paths, seed)),
        light(*lit.rays, std::make_shared<CausticMap>(caustics_of(lit.photons)), kPhotons) {}
};

/// Is the estimate right to within its error, by the image of the lamp?
void expect_image(const MirrorLight& of, const std::vector<Check>& places) {
  CausticLight::Worker worker;
  for (const Check& c : places) {
    const LocalDensity e = of.light.at_sensor(c.position, c.normal, worker);
    const double truth = MirrorBox::image_lx(c.position, c.normal), stated = luminance(e.stderr_lx());
    EXPECT_NEAR(double(luminance(e.irradiance)), truth, 3 * stated)
        << c.position.x << ' ' << c.position.y << ' ' << c.position.z;
    EXPECT_LT(stated, 0.3 * truth + 1) << c.position.x << ' ' << c.position.y << ' ' << c.position.z;
  }
}

TEST(Caustics, OfAMirrorWallOnSurfaces) { expect_image(MirrorLight(400'000), MirrorBox::on_surfaces()); }
TEST(Caustics, OfAMirrorWallInMidAir) { expect_image(MirrorLight(400'000), MirrorBox::in_air()); }

/// The errors stated hold: within two of them in about 95 of 100.
TEST(Caustics, StateTheirError) {
  std::vector<Check> places = MirrorBox::on_surfaces();
  for (const Check& c : MirrorBox::in_air()) places.push_back(c);
  double n = 0, within = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const MirrorLight of(40'000, seed);
    CausticLight::Worker worker;
    for (const Check& c : places) {
      const LocalDensity e = of.light.at_sensor(c.position, c.normal, worker);
      const double error = double(luminance(e.irradiance)) - MirrorBox::image_lx(c.position, c.normal);
      n += 1, within += std::fabs(error) <= 2 * double(luminance(e.stderr_lx()));
    }
  }
  EXPECT_GT(within / n, 0.86);
}

/// Records leave to the photons what photons tell of: nothing is left in a black room, by hull and by rays.
TEST(Caustics, AreNotInRecordsBesidesThem) {
  const MirrorLight of(20'000);
  const Luminaires lights(of.box.scene);
  for (const bool apart : {false, true}) {
    RecordOptions options;
    options.caustics_apart = apart;
    options.resolve(of.box.scene.bounds.diagonal_m() / 4);
    const DensityEstimator hull(of.lit.photons, *of.lit.rays, options, 1);
    options.estimate = Estimate::gather;
    const GatherEstimator gather(*of.lit.rays, lights, {}, options, 1);
    double sum = 0, sum_of_images = 0;
    for (const Check& c : MirrorBox::on_surfaces()) {
      const double truth = MirrorBox::image_lx(c.position, c.normal);
      const double by_hull = luminance(record_at(hull, c.position, c.normal).irradiance);
      if (apart) {
        EXPECT_EQ(by_hull, 0);
      }
      sum += by_hull, sum_of_images += truth;
      EXPECT_EQ(record_at(gather, c.position, c.normal).irradiance, Rgb(0)) << "a lamp without area";
    }
    if (!apart) {
      EXPECT_NEAR(sum, sum_of_images, 0.2 * sum_of_images);
    }
  }
}

/// Of a lamp of an extent, rays see the image where no photons tell of it.
TEST(Caustics, LampsSeenByMirrorsCountOnce) {
  MirrorBox box;
  box.scene = Scene();
  const Vec3 hi(4, 3, 5), x(hi.x, 0, 0), y(0, hi.y, 0), z(0, 0, hi.z);
  begin_instance(box.scene, "floor", add_lambert(box.scene, "black", 0));
  add_quad(box.scene, {}, z, x);
  begin_instance(box.scene, "lamp", add_lambert(box.scene, "glow", 0, 1000));
  add_quad(box.scene, {0.5f, 3, 1.5f}, {1.5f, 0, 0}, {0, 0, 1.5f});
  begin_instance(box.scene, "mirror", add_mirror(box.scene, "mirror", 0.8f));
  add_quad(box.scene, x, z, y);
  finalize(box.scene);
  const Lit lit = light_up(box.scene, 300'000);
  const Luminaires lights(box.scene);
  const CausticLight light(*lit.rays, std::make_shared<CausticMap>(caustics_of(lit.photons)), kPhotons);
  RecordOptions options;
  options.estimate = Estimate::gather, options.rays = 4096, options.gather_bounces = 1;
  options.resolve(box.scene.bounds.diagonal_m() / 4);
  const GatherEstimator all(*lit.rays, lights, {}, options, 1);
  options.caustics_apart = true;
  const GatherEstimator none(*lit.rays, lights, {}, options, 1);
  const Vec3 p(2.5f, 0, 2.5f), n(0, 1, 0);
  const IrradianceRecord by_rays = record_at(all, p, n);
  CausticLight::Worker worker;
  const LocalDensity by_photons = light.on_surface(p, n, worker);
  EXPECT_GT(by_rays.irradiance.x, 10);
  EXPECT_EQ(record_at(none, p, n).irradiance, Rgb(0));
  EXPECT_NEAR(double(by_photons.irradiance.x), double(by_rays.irradiance.x),
              3 * std::hypot(double(by_photons.stderr_lx().x), double(by_rays.stderr_lx.x)));
}

/// Through a file: sensors read straight light, records and caustic photons together.
TEST(Caustics, SensorsReadThemFromFiles) {
  const MirrorLight of(400'000);
  IrradianceCache cache;
  cache.scene_hash = of.box.scene.hash;
  cache.caustics = std::make_shared<CausticPhotons>(caustics_of(of.lit.photons));
  IrradianceRecord dark;
  dark.position = {2, 0, 2.5f}, dark.normal = {0, 1, 0}, dark.radius_m = 20, dark.distance_m = 3;
  cache.records.push_back(dark);
  const std::string path = scratch("sensors") + "/caustics";
  write_irradiance(path, cache, irradiance_provenance());
  const Container file = Container::open(path, FileKind::irradiance);
  std::vector<Check> places = MirrorBox::in_air();
  places.push_back({{2, 0, 2.5f}, {0, 1, 0}});
  const Read read = read_sensors_of(of.box.scene, sensors_at(places), {file}, {});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Check& c = places[i];
    const double truth =
        MirrorBox::image_lx(c.position, c.normal) + MirrorBox::straight_lx(c.position, c.normal);
    const Reading& r = read.readings[i];
    EXPECT_NEAR(double(r.illuminance_lx), truth, 3 * double(r.stderr_lx) + 1e-3 * truth) << i;
    EXPECT_NEAR(double(r.indirect_lx), MirrorBox::image_lx(c.position, c.normal),
                3 * double(r.stderr_lx) + 1e-3)
        << i;
  }
  // Records of another kind are not read beside them.
  const Container inside =
      even_cache("caustics_inside", of.box.scene, {{{2, 0, 2.5f}, {0, 1, 0}}}, 1, 1, Quantity::indirect);
  const Container both[] = {file, inside};
  EXPECT_THROW(SensorCaches(both, nullptr), Error);
}

/// A glass ball in a black box lets all light through: what lands, straight and caustic, is what the lamp
/// emits.
TEST(Caustics, AGlassBallKeepsTheLight) {
  Scene scene;
  begin_instance(scene, "box", add_lambert(scene, "black", 0));
  add_room(scene, Vec3(-1), Vec3(1));
  Material glass;
  glass.name = "glass", glass.model = Model::dielectric, glass.ior = 1.5f;
  scene.material.push_back(glass);
  begin_instance(scene, "ball", static_cast<std::uint32_t>(scene.material.size() - 1));
  constexpr int kRings = 12;
  const auto on_ball = [](int ring, int slice) {
    const double a = std::numbers::pi * ring / kRings, b = std::numbers::pi * slice / kRings;
    return 0.3f * Vec3(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int slice = 0; slice < 2 * kRings; ++slice) {
      const Vec3 a = on_ball(ring, slice), b = on_ball(ring, slice + 1), c = on_ball(ring + 1, slice),
                 d = on_ball(ring + 1, slice + 1);
      if (ring > 0) add_triangle(scene, a, b, d);
      if (ring < kRings - 1) add_triangle(scene, a, d, c);
    }
  add_point_light(scene, {0, 0.8f, 0}, 100);
  finalize(scene);
  const Lit lit = light_up(scene, 50'000);
  const CausticPhotons caustic = caustics_of(lit.photons);
  double flux = 0;
  for (std::size_t i = 0; i < lit.photons.size(); ++i) flux += static_cast<double>(lit.photons.flux[i].x);
  EXPECT_NEAR(flux, 400 * std::numbers::pi, 2e-3 * flux);
  EXPECT_GT(caustic.size(), 1000u);
  EXPECT_EQ(caustic.flights.size(), 0u) << "nothing flies from face to face outside of a convex ball";
}

}  // namespace
}  // namespace phos::test
