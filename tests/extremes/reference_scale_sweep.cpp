// The path tracer at every size and power, against itself at home and against closed forms.
#include <gtest/gtest.h>

#include "reference/point_irradiance.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/sweep.h"

namespace phos::test {
namespace {

PointIrradiance irradiance(const AnalyticScene& s, std::size_t check, std::int64_t samples) {
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  return estimate_irradiance(rays, lights, s.checks[check].position, s.checks[check].normal, samples);
}

Figures at_points(const AnalyticScene& s) {
  Figures f;
  for (std::size_t i = 0; i < s.checks.size(); ++i) {
    const PointIrradiance e = irradiance(s, i, 200);
    f.lux(e.irradiance_lx), f.lux(e.stderr_lx);
    f.add(e.illuminance_lx, -2, 1), f.add(e.illuminance_stderr_lx, -2, 1);
    f.number(static_cast<double>(e.rejected));
  }
  return f;
}

TEST(ScaleSweep, ReferenceInAFurnace) {
  sweep_scales("illuminance by the reference, furnace", furnace(0.5f), at_points);
}

TEST(ScaleSweep, ReferenceUnderASquare) {
  sweep_scales("illuminance by the reference, lit square", rectangle_light_parallel(), at_points);
}

TEST(ScaleSweep, ReferencePicture) {
  sweep_scales("picture by the reference", uniform_box(0.5f), [](const AnalyticScene& s) {
    const RayScene rays(s.scene);
    const Luminaires lights(s.scene);
    ReferenceOptions options;
    options.width = 16, options.height = 12, options.samples = 4;
    const ReferencePicture picture = render_reference(rays, lights, s.scene.camera[0], options);
    Figures f;
    for (const char* channel : {"R", "direct.G", "indirect.B", "stderr.G"})
      for (const float v : picture.image.channel(channel)) f.add(static_cast<double>(v), -2, 1);
    for (const char* channel : {"Z", "position.X"})
      for (const float v : picture.image.channel(channel)) f.metres(static_cast<double>(v));
    return f;
  });
}

TEST(ScaleSweep, ClosedFormsAtEveryAlbedo) {
  for (const float albedo : {0.f, 0.5f, 0.999f}) {
    for (const int size : {-20, 0, 20}) {
      const AnalyticScene s = resized(furnace(albedo), Scale::binades(size, 13));
      for (const std::size_t check : {0u, 3u}) {
        const PointIrradiance e = irradiance(s, check, albedo > 0.9f ? 600 : 3000);
        EXPECT_NEAR(e.illuminance_lx / s.mean_irradiance_lx, 1,
                    4.5 * e.illuminance_stderr_lx / s.mean_irradiance_lx + 1e-5)
            << "albedo " << albedo << ", 2^" << size << " m";
      }
    }
  }
  expect_limit({"illuminance by the reference", "albedo of a closed room", 0, 0.999, 0,
                "at 1 the mean is infinite: paths end, phos-scene warns", true});
}

}  // namespace
}  // namespace phos::test
