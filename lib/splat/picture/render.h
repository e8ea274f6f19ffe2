// A picture from a scene and a cache: splatting, direct light, gloss and specular paths, anti-aliasing,
// layers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/json.h"
#include "core/options.h"
#include "estimate/record_options.h"
#include "estimate/shading.h"
#include "image/image.h"
#include "radiance/gloss_cache.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"
#include "splat/direct/environment_harmonics.h"
#include "splat/picture/doublings.h"
#include "splat/picture/overlay.h"

namespace phos::inline splat {

enum class SplatBy { gl, cpu };
enum class DirectBy {
  traced,
  interleaved,  ///< shadow rays shared by neighbouring pixels of a diffuse surface
  shadow_map,
  none
};

/// Percentage-closer filtering of shadow maps (Reeves et al. 1987): texels each way about a point.
enum class ShadowFilter { none = 1, four = 2, sixteen = 4 };

struct RenderOptions {
  std::string camera;  ///< "" = the scene's first
  std::int64_t width = 0,
               height = 0;  ///< 0 = from the other and the camera's aspect (both 0: 1000 on the longer side)
  std::int64_t pixel_samples = 4;
  std::int64_t edge_samples = 0;  ///< more of them for pixels in which surfaces meet
  std::vector<std::string> layers{"all"};
  Overlay overlay = Overlay::none;
  OverlayColour overlay_colour = OverlayColour::radius;
  std::optional<double> accuracy;        ///< a; empty = reading_accuracy() of the cache
  std::optional<double> gloss_accuracy;  ///< of radiance records; empty = a, or their reading_accuracy()
  SplatBy splat = SplatBy::gl;
  LeakTest leak_test = LeakTest::none;
  DirectBy direct = DirectBy::traced;
  ShadowFilter shadow_filter = ShadowFilter::none;  ///< with a filter, maps light gloss too
  std::int64_t light_samples = 16, gloss_samples = 8, specular_depth = 64;
  std::optional<double> noise;  ///< chooses the first two of these (splat/picture/noise_target.h)
  std::int64_t shadow_map_size = 1024;
  GlossBy gloss = GlossBy::automatic;
  SplatBy gloss_splat = SplatBy::cpu;
  EnvironmentBy environment = EnvironmentBy::traced;
  std::int64_t environment_order = 10;
  std::int64_t max_misses = 100000;
  std::string isa;
  std::uint64_t seed = 0;
};
void declare_options(Options& options, RenderOptions& render);
/// Fills width, height and both accuracies in. Throws Error(usage) for a picture of more than 2^28 pixels, or
/// for options that exclude each other.
void resolve(RenderOptions& render, const Camera& camera, const IrradianceCache& cache,
             const RadianceCache& radiance = {});

struct Rendering {
  Image image;               ///< layers, named as image/image.h says
  std::vector<Miss> misses;  ///< visible points without a valid record, in an order that spreads them
  std::uint64_t missed = 0, looked_up = 0;  ///< of all points that read the cache
  std::vector<Miss> gloss_misses;           ///< places of lobes that no radiance record reaches
  /// Lobes that read radiance records, lobes that none reached, and the sums of drawing.
  struct {
    std::uint64_t looked_up = 0, missed = 0, pairs = 0, turned_pixels = 0;
  } gloss;
  std::uint64_t edge_pixels = 0;  ///< that had edge_samples more
  DrawnRecords drawn;             ///< over the beauty
  Counters counters;
  Json seconds = Json::Object{};  ///< per part
  std::string renderer;           ///< of the splatter
};

/// `render` must be resolved. Same bytes for any number of threads with SplatBy::cpu. `doublings`: of the
/// rays of its pixels. `brdfs`: of this scene's glossy materials, for an environment by harmonics; materials
/// that it lacks are projected. `gloss`, made for gloss_accuracy: the records that glossy surfaces read
/// (null: all gloss is traced). `lives`: of the cache's records, for OverlayColour::life. Throws Error(usage)
/// for harmonics of a scene without environment.
Rendering render_scene(const RayScene& rays, const IrradianceCache& cache, const RenderOptions& render,
                       std::span<const BrdfTable> brdfs = {}, const GlossCache* gloss = nullptr,
                       const RecordLives& lives = {}, const Doublings& doublings = {});

}  // namespace phos::inline splat
