// The light that one sample of a pixel sees.
#pragma once

#include <cstdint>

#include "estimate/shading.h"
#include "splat/direct/environment_harmonics.h"
#include "splat/direct/interleaved.h"
#include "splat/picture/doublings.h"
#include "splat/picture/layers.h"
#include "splat/picture/mapped_lamps.h"
#include "splat/picture/render.h"

namespace phos::inline splat {

/// One of the samples of a pixel: of those that every pixel has, or of those that edges have besides. Each
/// group has low-discrepancy sequences of its own.
struct SampleOfPixel {
  std::size_t pixel = 0;
  int index = 0;  ///< within its group
  bool at_edge = false;
};

/// What shading some pixels leaves besides their light.
struct ShadingResult {
  ShadingLog log;
  std::uint64_t looked_up = 0, missed = 0;
  std::uint64_t gloss_looked_up = 0, gloss_missed = 0;  ///< lobes that read radiance records
  void join(const ShadingResult& other);
};

/// Const, usable from any thread; holds references.
class PixelShader {
 public:
  /// `environment`: null where the environment is traced.
  PixelShader(const RayScene& rays, const Shading& shading, const RenderOptions& options,
              const Doublings& doublings, bool cached_direct,
              const EnvironmentHarmonics* environment = nullptr);

  /// Light of the records at a sample, already found (splatted). weight 0: none has been found yet.
  struct Splat {
    Interpolated found;             // of irradiance
    Vec4 gloss{0}, gloss_error{0};  // as in GlossBuffer
    const LampsAt* lamps =
        nullptr;  // light of lamps through glossy lobes, by shadow maps; null: rays find it
  };
  /// Does each sample of the group send one ray of a kind only, so that the noise shows in the spread of a
  /// pixel's samples alone?
  bool single_rays(bool at_edge) const;
  int lamp_rays_of_each(bool at_edge) const { return rays_of_each(at_edge, options_.light_samples); }
  /// `shared`: direct light of a diffuse surface that is known already; null: rays find it.
  PixelSample shade(const SampleOfPixel& sample, const Ray& ray, const SurfacePoint& point,
                    const Splat& splat, const SharedLight* shared, ShadingResult& result) const;
  /// What the records give a point; weight 0: too little, the samples about it are to look for themselves.
  Interpolated from_records(const SurfacePoint& point) const;
  /// Where no surface is seen.
  PixelSample background(const Ray& ray) const;

 private:
  /// Black, and no lamp: records are placed there for the layer of illuminance alone.
  bool is_dark(const SurfacePoint& point, const Bsdf& bsdf) const;
  void lux_from_cache(const SurfacePoint& point, const Bsdf& bsdf, const Splat& splat, PixelSample& light,
                      ShadingResult& result) const;
  void lux_from_lights(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                       const Vec3& wo, const SharedLight* shared, bool environment, PixelSample& light) const;
  void from_cache(const SurfacePoint& point, const Bsdf& bsdf, const Splat& splat, PixelSample& light,
                  ShadingResult& result) const;
  /// Is the gloss had from radiance records? Else it is to be traced.
  bool gloss_from_cache(const SurfacePoint& point, const Vec3& wo, const Splat& splat, PixelSample& light,
                        ShadingResult& result) const;
  int caustic_turns(const SampleOfPixel& sample) const;
  void from_caustics(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                     bool gloss, PixelSample& light, ShadingLog& log) const;
  int rays_of_each(bool at_edge, std::int64_t of_pixel) const;
  SampleRange range(const SampleOfPixel& sample, std::int64_t of_pixel, int doublings) const;
  SampleRange lamp_range(const SampleOfPixel& sample) const;
  SampleRange gloss_range(const SampleOfPixel& sample) const;
  /// Is the environment's light had without rays?
  bool from_environment(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, PixelSample& light,
                        ShadingLog& log) const;
  void from_lights(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                   const SharedLight* shared, const LampsAt* lamps, bool environment, bool gloss_by_rays,
                   RandomStream& sequence, PixelSample& light) const;
  void from_other_side(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf,
                       const Vec3& wo, RandomStream& sequence, PixelSample& light,
                       ShadingResult& result) const;
  void from_mirrors(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                    bool gloss_by_rays, RandomStream& sequence, PixelSample& light) const;
  void from_gloss(const SampleOfPixel& sample, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                  bool environment, RandomStream& sequence, RandomStream& random, PixelSample& light,
                  ShadingLog& log) const;

  const RayScene& rays_;
  const Shading& shading_;
  const RenderOptions& options_;
  const Doublings& doublings_;
  bool cached_direct_;
  bool shows_lux_;  // the layer of illuminance is asked for
  const EnvironmentHarmonics* environment_;
};

}  // namespace phos::inline splat
