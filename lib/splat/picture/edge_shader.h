// Shading of the further samples of pixels in which surfaces meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "splat/direct/edge_light.h"
#include "splat/direct/same_surface.h"
#include "splat/gbuffer.h"
#include "splat/picture/layers.h"
#include "splat/picture/mapped_lamps.h"
#include "splat/picture/pixel_shader.h"

namespace phos::inline splat {

/// What one sample of each pixel sees.
struct SeenPicture {
  GBuffer gbuffer;
  std::vector<SharedLight> shared;  ///< of pixels that share their shadow rays; else empty
};

/// Where pixels share their shadow rays: samples on one surface have the records' light of the middle
/// between them, and share shadow rays if it is diffuse (EdgeLight); on a face that is the same all over they
/// share everything. Where pixels share nothing, each sample is shaded by itself. Const, usable from any
/// thread; holds references.
class EdgeShader {
 public:
  /// `cached_direct`: the cache holds direct light too.
  EdgeShader(const RayScene& rays, const Luminaires& lights, const PixelRays& pixel_rays,
             const PixelShader& shader, const RenderOptions& options, const Doublings& doublings,
             bool cached_direct, const SeenPicture& picture);

  /// Adds options.edge_samples samples of the pixel. `lamps`: the light of the lamps at each of seen();
  /// empty: it is found by rays.
  void shade(std::size_t pixel, Layers& layers, ShadingResult& result,
             std::span<const LampsAt> lamps = {}) const;
  /// These samples, for maps to light.
  std::vector<SeenSample> seen(std::size_t pixel) const;

 private:
  struct Samples {
    std::size_t pixel;
    std::vector<Ray> ray;
    std::vector<Hit> hit;
    bool seen(std::size_t s) const { return std::isfinite(hit[s].distance_m); }
  };
  /// Those on one triangle.
  struct Face {
    std::uint32_t triangle, surface, first;  // first: sample
    int samples;
  };
  /// Those that may stand for each other.
  struct Surface {
    SeenSurface seen;
    SharedLight light;
    const SharedLight* direct = nullptr;  // null: rays of each sample find it
    PixelShader::Splat splat;
    std::vector<std::uint32_t> sample;
  };
  struct Sorted {
    std::vector<Face> face;
    std::vector<Surface> surface;
  };
  Samples trace(std::size_t pixel) const;
  Sorted sort(const Samples& samples) const;
  SurfacePoint middle_of(const Samples& samples, const Surface& surface) const;
  void find_light(const Samples& samples, Sorted& sorted) const;
  PixelSample sample(const Samples& samples, std::size_t s, const Surface* surface,
                     ShadingResult& result) const;
  void shade_mapped(const Samples& samples, std::span<const LampsAt> lamps, Layers& layers,
                    ShadingResult& result) const;
  void add(const Samples& samples, const Sorted& sorted, Layers& layers, ShadingResult& result) const;

  const RayScene& rays_;
  const PixelRays& pixel_rays_;
  const PixelShader& shader_;
  const RenderOptions& options_;
  const Doublings& doublings_;
  const SeenPicture& picture_;
  bool cached_direct_;
  EdgeLight edge_light_;
  std::vector<bool> diffuse_, even_;  // per material: without another lobe; and the same all over
};

}  // namespace phos::inline splat
