// Walls that absorb nothing: in a closed room the light has no end, which is an error at once; where it can
// get out, all of it does.
#include <gtest/gtest.h>

#include "core/error.h"
#include "photon/events.h"
#include "photon/trace.h"
#include "scene/report/lint.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

PhotonTotals traced(const Scene& scene, std::int64_t paths, Counters& counters) {
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = paths;
  PhotonTotals totals;
  trace_photons(rays, options, 1, totals, counters);
  return totals;
}

TEST(AlbedoOne, ClosedRoomIsRefusedAtOnce) {
  const AnalyticScene room = uniform_box(1);
  Counters counters;
  try {
    traced(room.scene, 1000000, counters);
    FAIL() << "an infinite mean was estimated";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
    EXPECT_NE(std::string(e.what()).find("absorbs nothing"), std::string::npos) << e.what();
  }
}

TEST(AlbedoOne, TheLintSaysSo) {
  for (const float albedo : {0.999f, 1.f}) {
    bool found = false;
    for (const Finding& f : lint_scene(uniform_box(albedo).scene))
      found = found || f.code == "absorbs-nothing";
    EXPECT_EQ(found, albedo == 1) << albedo;
  }
}

/// Without its lid, every lumen leaves the room, after ever so many bounces.
TEST(AlbedoOne, OpenRoomGivesAllBack) {
  Scene s;
  begin_instance(s, "walls", add_lambert(s, "white", 1));
  const Vec3 x(2, 0, 0), y(0, 1, 0), z(0, 0, 1.5f), lo(0);
  add_quad(s, lo, z, x), add_quad(s, lo, y, z), add_quad(s, lo + x, z, y), add_quad(s, lo, x, y);
  add_quad(s, lo + z, y, x);
  add_point_light(s, {0.7f, 0.6f, 0.5f}, 100 / (4 * kPi));
  finalize(s);
  Counters counters;
  const PhotonTotals totals = traced(s, 20000, counters);
  EXPECT_EQ(totals.escaped_flux_lm, totals.emitted_flux_lm);
  EXPECT_EQ(totals.absorbed_flux_lm, Rgb(0));
  EXPECT_EQ(counters[kTooLongEvent], 0u);
}

}  // namespace
}  // namespace phos::test
