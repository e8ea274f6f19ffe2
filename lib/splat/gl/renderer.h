// Drawing over a G-buffer by OpenGL: pictures, irradiance and radiance records, shadow maps.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "record/irradiance_cache.h"
#include "splat/cpu/gloss_splatter.h"
#include "splat/cpu/splatter.h"
#include "splat/gbuffer.h"

namespace phos::inline splat {

struct LampMap;

/// OpenGL 4.5 core of the library that choose_gl() says. One context per object, used from the thread that
/// made it.
class GlRenderer {
 public:
  /// Throws Error(bad_input) if no context can be had; the message names the missing part, and --splat cpu,
  /// which needs no context.
  explicit GlRenderer(const Scene& scene);
  ~GlRenderer();
  GlRenderer(const GlRenderer&) = delete;
  GlRenderer& operator=(const GlRenderer&) = delete;

  /// Rasterised, with textures for the albedo; agrees with trace_gbuffer but for edges.
  GBuffer rasterise(const Camera& camera, int width, int height, const Vec2& subpixel);
  /// Instanced quads bounding each record's sphere of influence, additive RGBA32F blending.
  SplatBuffer splat(std::span<const IrradianceRecord> records, double accuracy, const GBuffer& gbuffer,
                    const Camera& camera);
  /// As splat_gloss_on_cpu(). Lobes of isotropic tables are looked up and combined with records pixel by
  /// pixel; the CPU draws the rest (anisotropic and coated lobes, mapped normals, turned records),
  /// and tells which records reach where.
  GlossBuffer splat_gloss(const GlossCache& cache, double accuracy, const RayScene& rays,
                          const GBuffer& gbuffer, const Camera& camera, const Vec2& subpixel);
  /// Direct illuminance by shadow maps (preview): per pixel, lx, visibility included. Area lights by
  /// `light_samples` points each, point lights by six faces. `taps` x `taps` texels are asked (1: no filter).
  std::vector<Rgb> direct_illuminance(const GBuffer& gbuffer, int light_samples, int map_size, int taps = 1);
  /// use(map, extended) for each of these places on lamps, one map at a time, read back. `extended`: of a
  /// lamp with an area, or of the environment. Maps of directional light are as wide as what `gbuffer` shows.
  void each_lamp_map(const GBuffer& gbuffer, int light_samples, int map_size,
                     const std::function<void(const LampMap& map, bool extended)>& use);
  const char* description() const;  ///< renderer and version, for --stats

 private:
  struct Impl;
  struct ShadowPass;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline splat
