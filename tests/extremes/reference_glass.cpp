// Light paths of a lamp in a block of glass: they end soon, and the light that leaves is all there.
#include <gtest/gtest.h>

#include "reference/light_path.h"
#include "support/glass.h"

namespace phos::test {
namespace {

/// Total reflection keeps what is beyond the critical angle at all six faces; 3 (1 - cos t), sin t = 1 / 1.5,
/// of the light leaves.
TEST(ReferenceGlass, LightLeavesABlockWithinTheCriticalCones) {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "black", 0));
  add_room(scene, {-2, 0, -2}, {2, 2, 2});
  add_point_light(scene, {0, 0.5f, 0}, 100);
  begin_instance(scene, "block", add_solid_glass(scene));
  add_block(scene, {-0.5f, 0.2f, -0.4f}, {0.5f, 0.8f, 0.4f});
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  const LightStarts lamps(scene, luminaires);
  const LightTracer tracer(rays, luminaires, lamps, PathOptions());
  constexpr std::size_t kPaths = 8000;
  const LightPaths paths = trace_light(tracer, 1, 0, kPaths, 0, true);
  double lumens = 0;
  for (const SharpSegment& s : paths.segment) lumens += static_cast<double>(s.flux_lm.y) / kPaths;
  const double leaves = 3 * (1 - std::sqrt(1 - 1 / 2.25));
  EXPECT_NEAR(lumens / (400 * std::numbers::pi), leaves, 4.5 * std::sqrt(leaves * (1 - leaves) / kPaths));
  EXPECT_LE(paths.segment.size(), kPaths) << "those in the glass are of no sensor";
}

}  // namespace
}  // namespace phos::test
