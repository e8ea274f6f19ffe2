// Splats on the CPU, and the whole pipeline (photons, records, picture), at every size and power.
#include <gtest/gtest.h>

#include "radiance/check.h"
#include "record/check.h"
#include "splat/gl/renderer.h"
#include "splat/picture/render.h"
#include "splat/raster/hemisphere_raster.h"
#include "support/gl.h"
#include "support/raster.h"
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

using Draw = std::function<SplatBuffer(const Scene&, const std::vector<IrradianceRecord>&, const GBuffer&)>;

/// The same records on what is seen of a room.
void sweep_splats(const std::string& quantity, const Draw& draw, SweepTolerance tolerance = {}) {
  const AnalyticScene room = uniform_box(0.5f);
  const RayScene rays(room.scene);
  const auto records = records_in_view(rays, room.scene.camera[0], 100, 0.2f, 2);
  sweep_scales(
      quantity,
      [&](Scale by) {
        const AnalyticScene s = resized(room, by);
        const RayScene own(s.scene);
        const GBuffer seen = trace_gbuffer(own, s.scene.camera[0], 40, 30, {0.5f, 0.5f});
        std::vector<IrradianceRecord> here = records;
        for (IrradianceRecord& r : here) {
          resize(r, by);
          if (const char* wrong = what_is_wrong(r))  // as where it is read
            throw Error(ExitCode::bad_input, "", std::string("a record has ") + wrong);
        }
        const SplatBuffer splats = draw(s.scene, here, seen);
        Figures f;
        for (std::size_t i = 0; i < splats.light.size(); ++i) {
          const Interpolated e = splats.at(i);
          f.lux(e.irradiance), f.lux(e.stderr_lx), f.number(static_cast<double>(e.weight));
        }
        return f;
      },
      tolerance);
}

TEST(ScaleSweep, SplatsOnTheCpu) {
  sweep_splats("splats on the CPU", [](const Scene& scene, const auto& records, const GBuffer& seen) {
    return splat_on_cpu(records, 0.25, seen, scene.camera[0]);
  });
}

TEST(ScaleSweep, SplatsByOpenGl) {
  const AnalyticScene room = uniform_box(0.5f);
  GlRenderer renderer(room.scene);  // splats take all that they need from the G-buffer
  sweep_splats("splats by OpenGL", [&](const Scene& scene, const auto& records, const GBuffer& seen) {
    return renderer.splat(records, 0.25, seen, scene.camera[0]);
  });
}

TEST(ScaleSweep, IrradianceByRasterising) {
  sweep_scales("irradiance by rasterising", furnace(0.5f), [](const AnalyticScene& s) {
    const RayScene rays(s.scene);
    const Luminaires lights(s.scene);
    const RasterEstimator estimator(rays, lights, {}, raster_options(s.scene, Estimate::raster), 1);
    const auto worker = estimator.make_worker();
    Figures f;
    for (std::size_t i = 0; i < 4; ++i)
      f.record(estimator.make({s.checks[i].position, s.checks[i].normal, i}, *worker).record);
    return f;
  });
}

/// Shadow rays that pixels share, and those that samples of a pixel share where surfaces meet.
TEST(ScaleSweep, SharedDirectLight) {
  sweep_scales("direct light that pixels share", rectangle_light_parallel(), [](const AnalyticScene& s) {
    const RayScene rays(s.scene);
    const IrradianceCache cache = empty_cache(Quantity::indirect, 0.2);
    RenderOptions render;
    render.width = 32, render.height = 24, render.pixel_samples = 1, render.edge_samples = 12;
    render.light_samples = 4, render.direct = DirectBy::interleaved, render.splat = SplatBy::cpu;
    resolve(render, s.scene.camera[0], cache);
    const Rendering picture = render_scene(rays, cache, render);
    Figures f;
    f.number(static_cast<double>(picture.edge_pixels));
    for (const char* channel : {"direct.G", "stderr.G"})
      for (const float v : picture.image.channel(channel)) f.add(static_cast<double>(v), -2, 1);
    return f;
  });
}

TEST(ScaleSweep, WholePipeline) {
  sweep_scales(
      "picture by the whole pipeline", uniform_box(0.5f),
      [](const AnalyticScene& s) {
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
      },
      {.decades = 0.05});  // a photon on the border of a zone counts or not
}

}  // namespace
}  // namespace phos::test
