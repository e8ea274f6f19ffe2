// Light that total reflection keeps in glass: it ends soon, and the light that leaves is all there.
#include <gtest/gtest.h>

#include "photon/events.h"
#include "photon/trace.h"
#include "scene/material/pane.h"
#include "scene/material/total_reflections.h"
#include "support/glass.h"

namespace phos::test {
namespace {

constexpr std::int64_t kPaths = 8000;
/// Of light in glass of index 1.5 with plane faces at right angles: the share whose angle to some face is
/// within the critical one, 3 (1 - cos t), sin t = 1 / 1.5. It leaves whatever the sides of the block are.
const double kLeaves = 3 * (1 - std::sqrt(1 - 1 / 2.25));

struct Traced {
  Photons photons;
  PhotonTotals totals;
  Counters counters;
  double events = 0;  // of a path

  explicit Traced(const Scene& scene) {
    const RayScene rays(scene);
    PhotonOptions options;
    options.paths = kPaths, options.caustic_paths = 0;
    std::vector<Ray> log;
    photons = trace_photons(rays, options, 1, totals, counters, &log);
    events = static_cast<double>(log.size()) / static_cast<double>(kPaths);
  }
  double stored() const {
    return static_cast<double>(totals.stored_flux_lm.y) / static_cast<double>(totals.emitted_flux_lm.y);
  }
  /// Not a lumen is unaccounted for.
  void expect_closed() const {
    EXPECT_EQ(totals.escaped_flux_lm, Rgb(0));
    EXPECT_NEAR(static_cast<double>(totals.absorbed_flux_lm.y), static_cast<double>(totals.emitted_flux_lm.y),
                1e-6 * static_cast<double>(totals.emitted_flux_lm.y));
    EXPECT_EQ(counters[kTooLongEvent] + counters[kNonFiniteEvent], 0u);
  }
};

/// A black room, and a lamp of 100 cd.
Scene room_with_lamp(const Vec3& lamp, float half_m = 4) {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "black", 0));
  add_room(scene, {-half_m, 0, -half_m}, {half_m, 2 * half_m, half_m});
  add_point_light(scene, lamp, 100);
  add_solid_glass(scene);
  return scene;
}

Scene block_about_lamp(const Vec3& lamp, const Vec3& lo, const Vec3& hi, float room_m = 4) {
  Scene scene = room_with_lamp(lamp, room_m);
  begin_instance(scene, "block", 1);
  add_block(scene, lo, hi);
  finalize(scene);
  return scene;
}

}  // namespace

/// The k-th total reflection is reached with probability start / k, and weighs k / start.
TEST(TotalReflections, SurvivalFallsAsOneOverTheirNumber) {
  for (const float index : {1.5f, 10.f}) {
    TotalReflections path;
    const std::uint32_t start = TotalReflections::start(index);
    EXPECT_EQ(start, index == 1.5f ? 64u : 1600u);
    double reached = 1;
    for (std::uint32_t k = 1; k <= 10000; ++k) {
      reached *= static_cast<double>(path.survival(index));
      if (k <= start) {
        ASSERT_EQ(reached, 1) << k;
      } else {
        ASSERT_NEAR(reached * k / start, 1, 1e-3) << k;
      }
    }
    EXPECT_EQ(path.survival(0), 1) << "any other event";
    EXPECT_EQ(path.survival(index), 1) << "counts from the start again";
  }
}

TEST(KeptInGlass, OfALampInABlockTheCriticalConesLeave) {
  const Traced t(block_about_lamp({0, 0.5f, 0}, {-0.5f, 0.2f, -0.4f}, {0.5f, 0.8f, 0.4f}));
  t.expect_closed();
  const double sigma = std::sqrt(kLeaves * (1 - kLeaves) / kPaths);
  EXPECT_NEAR(t.stored(), kLeaves, 4.5 * sigma);
  EXPECT_NEAR(static_cast<double>(t.counters[kKeptInGlassEvent]) / kPaths, 1 - kLeaves, 4.5 * sigma);
  EXPECT_LT(t.events, 200) << "surfaces met by a path";
}

/// Through a rod of 150 widths light leaves at the far end after up to 300 reflections, most of them
/// survivors.
TEST(KeptInGlass, ARodLeadsItsLightToItsEnds) {
  const Traced t(block_about_lamp({0.001f, 4.003f, -1.4f}, {-0.01f, 3.99f, -1.5f}, {0.01f, 4.01f, 1.5f}));
  t.expect_closed();
  EXPECT_NEAR(t.stored(), kLeaves, 0.04);
  EXPECT_LT(t.events, 300);
}

/// Whispering gallery: off the centre by 0.8 of the radius, rays that pass it farther off than 1 / 1.5 of the
/// radius leave a true ball never; facets let some of them out.
TEST(KeptInGlass, OfALampOffTheCentreOfABall) {
  Scene scene = room_with_lamp({0, 4.4f, 0});
  begin_instance(scene, "ball", 1);
  add_smooth_ball(scene, {0, 4, 0}, 0.5f);
  finalize(scene);
  const Traced t(scene);
  t.expect_closed();
  const double sine = 1 / 1.5 / 0.8, leaves = 1 - std::sqrt(1 - sine * sine);
  EXPECT_GT(t.stored(), leaves - 0.03);
  EXPECT_LT(t.stored(), 1 + 0.03);
  EXPECT_LT(t.events, 300);
}

/// On the floor under a wide block, within 0.3 m of the axis: passages of all orders by their Fresnel
/// factors; a ray of angle t in the glass lands at d tan t + h tan i.
TEST(KeptInGlass, ALampInABlockLightsTheFloor) {
  const Traced t(block_about_lamp({0, 0.5f, 0}, {-5, 0.2f, -5}, {5, 0.8f, 5}, 8));
  t.expect_closed();
  constexpr double kDisc = 0.3, kAir = 0.2, kHalf = 0.3;
  double truth = 0;
  constexpr int kSteps = 20000;
  const double critical = std::asin(1 / 1.5);
  for (int i = 0; i < kSteps; ++i) {
    const double angle = critical * (i + 0.5) / kSteps, sine = 1.5 * std::sin(angle);
    const double outside = std::sqrt(1 - sine * sine);
    const auto reflected = static_cast<double>(face_reflectance(static_cast<float>(outside), 1.5f).mean());
    double weight = 1 - reflected;
    for (int order = 0; order < 40; ++order, weight *= reflected)
      if ((kHalf + 2 * kHalf * order) * std::tan(angle) + kAir * sine / outside < kDisc)
        truth += 2 * std::numbers::pi * 100 * weight * std::sin(angle) * critical / kSteps;
  }
  double floor = 0, squares = 0;
  for (std::size_t i = 0; i < t.photons.size(); ++i) {
    const Vec3& p = t.photons.position[i];
    if (p.y > 1e-3f || std::hypot(p.x, p.z) >= static_cast<float>(kDisc)) continue;
    const auto lm = static_cast<double>(t.photons.flux[i].y);
    floor += lm, squares += lm * lm;
  }
  EXPECT_NEAR(floor, truth, 4.5 * std::sqrt(squares));
  EXPECT_LT(std::sqrt(squares), 0.08 * truth);
}

/// A lamp at the centre of a thin bulb lights as without it: the share T passes straight, and the rest comes
/// back through the centre and leaves on the other side.
TEST(KeptInGlass, AThinBulbTakesNothing) {
  Scene scene = room_with_lamp({0, 4, 0});
  scene.material[1].model = Model::thin_dielectric;
  begin_instance(scene, "bulb", 1);
  add_smooth_ball(scene, {0, 4, 0}, 0.1f);
  finalize(scene);
  const Traced t(scene);
  t.expect_closed();
  EXPECT_NEAR(t.stored(), 1, 1e-6);
  double reflected = 0;
  for (std::size_t i = 0; i < t.photons.size(); ++i)
    if (t.photons.path[i] == static_cast<std::uint8_t>(PhotonPath::caustic))
      reflected += static_cast<double>(t.photons.flux[i].y);
  constexpr double kReflected = 1 - 0.92307692;
  EXPECT_NEAR(reflected / static_cast<double>(t.totals.emitted_flux_lm.y), kReflected,
              4.5 * std::sqrt(kReflected / kPaths));
}

}  // namespace phos::test
