// Splats on the CPU, and the whole pipeline (photons, records, picture), at every size and power.
#include <gtest/gtest.h>

#include "splat/render.h"
#include "support/splat_records.h"
#include "support/splat_scenes.h"
#include "support/sweep.h"

namespace phos::test {
namespace {

/// Records as they are in the room of one size and power, put into the others.
void resize(IrradianceRecord& r, Scale by) {
  const auto length = static_cast<float>(by.of(1, 0)), lux = static_cast<float>(by.of(-2, 1)),
             slope = static_cast<float>(by.of(-3, 1));
  r.position *= length, r.radius_m *= length, r.distance_m *= length;
  r.irradiance *= lux, r.stderr_lx *= lux;
  for (int c = 0; c < 3; ++c) r.rotation_gradient[c] *= lux, r.translation_gradient[c] *= slope;
}

TEST(ScaleSweep, SplatsOnTheCpu) {
  const AnalyticScene room = uniform_box(0.5f);
  const RayScene rays(room.scene);
  const auto records = records_in_view(rays, room.scene.camera[0], 100, 0.2f, 2);
  const auto size = static_cast<double>(room.scene.bounds.diagonal_m());
  sweep_scales("splats on the CPU", room, [&](const AnalyticScene& s) {
    const RayScene own(s.scene);
    const Camera& camera = s.scene.camera[0];
    const GBuffer seen = trace_gbuffer(own, camera, 40, 30, {0.5f, 0.5f});
    Scale by;
    by.size =
        static_cast<int>(std::lround(std::log2(static_cast<double>(s.scene.bounds.diagonal_m()) / size)));
    by.power = static_cast<int>(std::lround(std::log2(s.mean_irradiance_lx / room.mean_irradiance_lx))) +
               2 * by.size;
    std::vector<IrradianceRecord> here = records;
    for (IrradianceRecord& r : here) resize(r, by);
    const SplatBuffer splats = splat_on_cpu(here, 0.25, seen, camera);
    Figures f;
    for (std::size_t i = 0; i < splats.light.size(); ++i) {
      const Interpolated e = splats.at(i);
      f.lux(e.irradiance), f.lux(e.stderr_lx), f.number(static_cast<double>(e.weight));
    }
    return f;
  });
}

TEST(ScaleSweep, WholePipeline) {
  sweep_scales("picture by the whole pipeline", uniform_box(0.5f), [](const AnalyticScene& s) {
    const Lit lit = light_up(s.scene, 6000);
    RecordOptions options = all_light(s.scene);
    options.paths = Quantity::indirect;
    IrradianceCache cache = empty_cache(Quantity::indirect, options.accuracy);
    Counters counters;
    place_at_photons(cache, lit.photons, *lit.rays, options, {.max_candidates = 300}, 1, counters);
    RenderOptions render;
    render.width = 24, render.height = 18, render.pixel_samples = 1, render.splat = SplatBy::cpu;
    resolve(render, s.scene.camera[0], cache);
    const Rendering picture = render_scene(*lit.rays, cache, render);
    Figures f;
    f.number(static_cast<double>(cache.records.size())), f.number(static_cast<double>(picture.missed));
    for (const char* channel : {"R", "direct.G", "indirect.B", "stderr.G", "illuminance.Y"})
      for (const float v : picture.image.channel(channel)) f.add(static_cast<double>(v), -2, 1);
    for (const float v : picture.image.channel("Z")) f.metres(static_cast<double>(v));
    return f;
  });
}

}  // namespace
}  // namespace phos::test

int main(int argc, char** argv) { return phos::test::limits_main(argc, argv); }
