// Drawing irradiance records over a G-buffer (radiance cache splatting): on the CPU, and through OSMesa.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "record/irradiance_cache.h"
#include "splat/cpu/gloss_splatter.h"
#include "splat/gbuffer.h"

namespace phos::inline splat {

/// What blending leaves per pixel, before normalisation.
struct SplatBuffer {
  std::vector<Vec4> light;  ///< rgb = sum w E (lx), w = sum w
  std::vector<Vec4> error;  ///< rgb = sum w stderr (lx), w = number of records
  /// x = sum w^2, y = sum w IrradianceRecord::shared, z = sum w (luminance of E / unit_lx)^2, w = 0.
  std::vector<Vec4> spread;
  float unit_lx = 1;

  /// E of a pixel and its standard error (blended_error), lx. Of no record: 0.
  Interpolated at(std::size_t pixel) const;
};

/// The unit that keeps squares of the records' irradiance within the range of floats: the largest of it.
float splat_unit_lx(std::span<const IrradianceRecord> records);

/// Every record's weight (record_weight at `accuracy`) and extrapolated irradiance, summed. Tiled,
/// vectorised, same bytes for any number of threads. The oracle for the OSMesa splatter.
SplatBuffer splat_on_cpu(std::span<const IrradianceRecord> records, double accuracy, const GBuffer& gbuffer,
                         const Camera& camera);

/// OpenGL 4.5 core through OSMesa (llvmpipe). One context per object, used from the thread that made it.
class GlRenderer {
 public:
  /// Throws Error(bad_input) if no context can be had, saying what is missing and that --splat cpu needs
  /// none.
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
  /// pixel; the CPU draws what else there is (anisotropic and coated lobes, mapped normals, turned records),
  /// and tells which records reach where.
  GlossBuffer splat_gloss(const GlossCache& cache, double accuracy, const RayScene& rays,
                          const GBuffer& gbuffer, const Camera& camera, const Vec2& subpixel);
  /// Direct illuminance by shadow maps (preview): per pixel, lx, visibility included. Area lights by
  /// `light_samples` points each, point lights by six faces.
  std::vector<Rgb> direct_illuminance(const GBuffer& gbuffer, int light_samples, int map_size);
  const char* description() const;  ///< renderer and version, for --stats

 private:
  struct Impl;
  struct ShadowPass;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline splat
