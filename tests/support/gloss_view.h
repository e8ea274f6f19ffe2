// A glossy scene seen by its first camera, to draw radiance records in.
#pragma once

#include <vector>

#include "splat/cpu/gloss_splatter.h"
#include "splat/gbuffer.h"
#include "support/gloss_scenes.h"

namespace phos::test {

struct GlossView {
  static constexpr double kAccuracy = 0.25;
  static constexpr Vec2 kMiddle{0.5f, 0.5f};

  GlossView(Scene of, int width, int height)
      : scene(std::move(of)), g(trace_gbuffer(rays, camera, width, height, kMiddle)) {}
  Scene scene;
  RayScene rays{scene};
  GlossTables tables = gloss_tables(scene);
  Camera camera = scene.camera.at(0);
  GBuffer g;

  std::vector<RadianceRecord> records(std::size_t count, float lo_m, float hi_m) const {
    return radiance_in_view(rays, tables, camera, count, lo_m, hi_m);
  }
  GlossCache cache(const std::vector<RadianceRecord>& of) const {
    return gloss_cache(rays, tables, kAccuracy, of);
  }
  GlossBuffer draw(const GlossCache& of) const {
    return splat_gloss_on_cpu(of, kAccuracy, rays, g, camera, kMiddle);
  }
  GlossBuffer look_up(const GlossCache& of) const { return look_up_gloss(of, rays, g, camera, kMiddle); }
};

}  // namespace phos::test
