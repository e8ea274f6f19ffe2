#include "splat/picture/render.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "hsh/limits.h"
#include "record/tree.h"
#include "scene/limits.h"
#include "scene/load.h"
#include "scene/picture.h"
#include "splat/cpu/gloss_splatter.h"
#include "splat/cpu/splatter.h"
#include "splat/direct/interleaved.h"
#include "splat/gl/renderer.h"
#include "splat/picture/edge_shader.h"
#include "splat/picture/edges.h"
#include "splat/picture/mapped_lamps.h"
#include "splat/picture/misses.h"
#include "splat/picture/overlay_legend.h"
#include "splat/picture/pixel_shader.h"

namespace phos::inline splat {

namespace {

constexpr std::size_t kChunk = 1024;
constexpr std::uint32_t kNoSlot = ~0u;

/// Adds its own life to an entry of a JSON object.
class Stopwatch {
 public:
  Stopwatch(Json& seconds, const std::string& name) : seconds_(seconds[name]) {}
  ~Stopwatch() {
    const double before = seconds_.is_null() ? 0 : seconds_.as_number();
    seconds_ = before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  Json& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The records at each visible point by lookups, with a ray to each: the result of splatting, without leaks.
SplatBuffer look_up(const RecordTree& records, const GBuffer& g) {
  SplatBuffer buffer;
  for (std::vector<Vec4>* sums : {&buffer.light, &buffer.error, &buffer.spread})
    sums->assign(g.position.size(), Vec4(0));
  buffer.unit_lx = splat_unit_lx(records.records());
  const double per_unit2 = 1 / (static_cast<double>(buffer.unit_lx) * static_cast<double>(buffer.unit_lx));
  parallel_for(g.position.size(), kChunk, [&](std::size_t i) {
    if (!g.covered(i)) return;
    Interpolated sum;
    records.add(Vec3(g.position[i]), Vec3(g.normal[i]), sum);
    buffer.light[i] = Vec4(sum.irradiance, sum.weight);
    buffer.error[i] = Vec4(sum.stderr_lx, sum.weight > 0 ? 1 : 0);
    buffer.spread[i] =
        Vec4(sum.sums.weight2, sum.sums.shared, static_cast<float>(sum.sums.value2 * per_unit2), 0);
  });
  return buffer;
}

}  // namespace

void declare_options(Options& options, RenderOptions& r) {
  options.section("Picture");
  options.text("camera", r.camera, "NAME", "camera of the scene (default: the first one)");
  options.integer("width", r.width, "PIXELS",
                  "width of the picture; 0: from the height and the camera's aspect",
                  {0, kMostPictureSide.as<double>()});
  options.integer("height", r.height, "PIXELS",
                  "height of the picture; 0: from the width; both 0: 1000 on the longer side",
                  {0, kMostPictureSide.as<double>()});
  options.integer("pixel-samples", r.pixel_samples, "N",
                  "number of samples per pixel, averaged (anti-aliasing)", {1, 4096});
  options.integer(
      "edge-samples", r.edge_samples, "N",
      "number of further samples of the pixels in which surfaces meet (anti-aliasing at edges, in a fraction "
      "of the time of --pixel-samples); 0: none. Samples lie in pairs about the centre: give an even number",
      {0, 4096});
  options.list("layers", r.layers, "all|LAYER,...",
               "layers to write: " + LayerSet::names() + " (fewer are faster)");
  options.choice<Overlay>(
      "overlay", r.overlay, {{"none", Overlay::none}, {"records", Overlay::records}},
      "marks that are drawn into the beauty layer: records: a dot at each visible record, and the outline of "
      "the zone that it lights; other layers stay as they are");
  Names<OverlayColour> colours;
  for (const OverlayColourRow& row : kOverlayColours) colours.emplace_back(row.name, row.colour);
  options.choice<OverlayColour>(
      "overlay-colour", r.overlay_colour, colours,
      "with --overlay records: quantity that the colours show: radius, or standard error over irradiance "
      "(logarithmic; blue is the least); or, of a film, the number of frames that a record lives "
      "(logarithmic; "
      "red is one frame, green the longest life)");
  options.section("Light from the cache");
  options.number("accuracy", r.accuracy, "A",
                 "error allowed in interpolation, which sets the reach of a record; smaller: fewer, closer "
                 "records are blended, with more noise and more misses (default: 2.5 times the accuracy of "
                 "the cache, but at most 0.5; for radiance records at most 0.6)",
                 kPositive);
  options.choice<SplatBy>(
      "splat", r.splat, {{"gl", SplatBy::gl}, {"cpu", SplatBy::cpu}},
      "renderer of the records: gl: OpenGL (--gl); cpu: the processor. Both give the same picture to 1e-4");
  options.choice<LeakTest>("leak-test", r.leak_test, {{"none", LeakTest::none}, {"ray", LeakTest::ray}},
                           "ray: a record lights a point only if the two see each other (records are looked "
                           "up, with a ray for each, instead of drawn); none: no test");
  options.integer("max-misses", r.max_misses, "N",
                  "largest number of points that --misses and --gloss-misses write; 0: none", kNotNegative,
                  Recorded::no);
  options.section("Direct light, gloss, mirrors and glass");
  options.choice<DirectBy>(
      "direct", r.direct,
      {{"traced", DirectBy::traced},
       {"interleaved", DirectBy::interleaved},
       {"shadow-map", DirectBy::shadow_map},
       {"none", DirectBy::none}},
      "method for direct light: traced: by shadow rays; interleaved: by shadow rays that 4 x 4 pixels of one "
      "diffuse surface share, also at edges, with more rays only where a lamp is partly hidden (a fraction "
      "of the time; shadows that noise would hide blur over up to 4 pixels); shadow-map: by "
      "shadow maps (a fast preview of diffuse surfaces alone); none: no direct light");
  options.integer("light-samples", r.light_samples, "N",
                  "number of shadow rays from a pixel to each area light or environment, shared among the "
                  "samples of the pixel (at least one for each); with --direct shadow-map: number of shadow "
                  "maps of each area light or environment",
                  {1, 65536});
  options.number(
      "noise", r.noise, "FRACTION",
      "noise of direct light and gloss to reach in each part of the picture, as a share of the pixel's "
      "light, "
      "or of a tenth of the picture's mean where that is more (0.02: 2 %). Two small pictures tell how "
      "many --light-samples and --gloss-samples reach it where: 64 (fewer to each of many lamps) to 4096",
      {1e-4, 1}, Recorded::if_given);
  options.choice<EnvironmentBy>(
      "environment-mode", r.environment,
      {{"traced", EnvironmentBy::traced}, {"hsh", EnvironmentBy::hsh}, {"sh", EnvironmentBy::sh}},
      "method for the light of the environment on seen surfaces: traced: by rays; hsh: by hemispherical "
      "harmonics, without noise and WITHOUT SHADOWS, as in an open place (lobes that are too sharp for the "
      "tables of a .brdf file, or for tables made here, are traced); sh: by spherical harmonics, for "
      "comparison");
  options.integer(
      "environment-order", r.environment_order, "N",
      "with --environment-mode hsh or sh: number of bands of the harmonics, with N x N coefficients",
      {1, kMostOrder.as<double>()});
  options.integer("shadow-map-size", r.shadow_map_size, "PIXELS",
                  "with --direct shadow-map: side of a shadow map", {16, 8192});
  options.choice<ShadowFilter>(
      "shadow-map-filter", r.shadow_filter,
      {{"none", ShadowFilter::none}, {"4", ShadowFilter::four}, {"16", ShadowFilter::sixteen}},
      "with --direct shadow-map: number of samples of each shadow map about a point (percentage-closer "
      "filtering), which soften the steps of shadows; 4 and 16 light gloss too: of lamps without an area, "
      "and "
      "where gloss is read from radiance records of all lamps; none: one sample, and rays for gloss",
      Recorded::unless_default);
  declare_options(options, r.gloss);
  options.choice<SplatBy>("gloss-splat", r.gloss_splat, {{"cpu", SplatBy::cpu}, {"gl", SplatBy::gl}},
                          "renderer of radiance records: cpu: the processor; gl: OpenGL (OSMesa takes many "
                          "times as long). Both give the same picture to 1e-4");
  options.integer("gloss-samples", r.gloss_samples, "N",
                  "number of rays from a pixel on a glossy surface whose reflection is traced, shared among "
                  "the samples of the pixel; 0: no traced reflection",
                  {0, 65536});
  options.integer("specular-depth", r.specular_depth, "N",
                  "largest number of mirrors and glass surfaces in a row; 0: mirrors and glass stay black",
                  {0, 1000});
  declare_isa(options, r.isa);
}

void resolve(RenderOptions& r, const Camera& camera, const IrradianceCache& cache,
             const RadianceCache& radiance) {
  resolve_size(camera, kPictureSide, r.width, r.height);
  if (!r.gloss_accuracy) r.gloss_accuracy = r.accuracy.value_or(reading_accuracy(radiance));
  if (!r.accuracy) r.accuracy = reading_accuracy(cache.accuracy);
  const LayerSet layers(r.layers);
  if (r.overlay != Overlay::none && !layers.has(Layer::beauty))
    throw Error(ExitCode::usage, "--overlay", "is drawn into the layer beauty; give --layers beauty too");
  if (r.shadow_filter != ShadowFilter::none && r.direct != DirectBy::shadow_map)
    throw Error(ExitCode::usage, "--shadow-map-filter", "needs shadow maps; give --direct shadow-map too");
  if (r.environment != EnvironmentBy::traced && r.direct != DirectBy::traced)
    throw Error(ExitCode::usage, "--environment-mode", "hsh and sh need --direct traced; leave --direct out");
}

namespace {

/// A picture in the making: its samples pass by pass, then more of them at edges.
class Painter {
 public:
  Painter(const RayScene& rays, const IrradianceCache& cache, const RenderOptions& options,
          std::span<const BrdfTable> brdfs, const GlossCache* gloss, const Doublings& doublings,
          Rendering& result)
      : rays_(rays),
        cache_(cache),
        gloss_(gloss),
        options_(options),
        doublings_(doublings),
        result_(result),
        camera_(find_camera(rays.scene(), options.camera)),
        width_(static_cast<int>(options.width)),
        height_(static_cast<int>(options.height)),
        samples_(static_cast<int>(options.pixel_samples)),
        pixel_rays_(camera_, width_, height_),
        lights_(rays.scene()),
        records_(tree()),
        caustics_(caustic_light()),
        shading_(rays, lights_, records_, shading_options(), gloss, caustics_.get()),
        environment_(harmonics(brdfs)),
        shader_(rays, shading_, options, doublings, cached_direct(), environment_.get()),
        layers_(width_, height_, LayerSet(options.layers), samples_ + static_cast<int>(options.edge_samples),
                spread_from()),
        count_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
               static_cast<std::uint16_t>(samples_)),
        progress_("rendering", count_.size() * static_cast<std::uint64_t>(samples_), "pixel samples") {
    if (by_gl() || gloss_by_gl() || options.direct == DirectBy::shadow_map)
      gl_ = std::make_unique<GlRenderer>(rays.scene());
    result.renderer = gl_ ? gl_->description() : "cpu";
  }

  void make() {
    for (int s = 0; s < samples_; ++s) {
      pass_.gbuffer = see(s);
      if (s == 0 && options_.edge_samples > 0) find_edges(pass_.gbuffer);
      const SplatBuffer splats = light_from_cache(pass_.gbuffer);
      pass_.shared = shared_light(s, pass_.gbuffer);
      find_gloss_of_lamps(s, pass_.gbuffer);
      shade(s, pass_.gbuffer, splats, gloss_from_cache(s, pass_.gbuffer), pass_.shared);
    }
    if (!edges_.empty()) shade_edges();
    finish();
  }

 private:
  bool by_gl() const { return options_.splat == SplatBy::gl; }
  bool gloss_by_gl() const { return gloss_ && options_.gloss_splat == SplatBy::gl; }
  bool cached_direct() const { return cache_.quantity == Quantity::all; }

  RecordTree tree() const {
    RecordTree records(rays_.scene().bounds, *options_.accuracy,
                       options_.leak_test == LeakTest::ray ? &rays_ : nullptr);
    for (const IrradianceRecord& r : cache_.records) records.insert(r);
    return records;
  }

  /// Null where records hold caustic light, and where no layer shows any light.
  std::unique_ptr<const CausticLight> caustic_light() const {
    if (!cache_.caustics || !LayerSet(options_.layers).show_light()) return nullptr;
    return std::make_unique<CausticLight>(rays_, std::make_shared<CausticMap>(*cache_.caustics),
                                          kPictureCaustics);
  }

  /// Null where the environment is traced.
  std::unique_ptr<EnvironmentHarmonics> harmonics(std::span<const BrdfTable> brdfs) const {
    if (options_.environment == EnvironmentBy::traced) return nullptr;
    const Scene& scene = rays_.scene();
    if (!scene.environment)
      throw Error(ExitCode::usage, "--environment-mode", "there is no environment; give --environment FILE");
    const Stopwatch watch(result_.seconds, "environment");
    return std::make_unique<EnvironmentHarmonics>(scene, *scene.environment, options_.environment,
                                                  static_cast<int>(options_.environment_order), brdfs);
  }

  /// Samples of a pixel from which on they send single rays.
  int spread_from() const {
    return shader_.single_rays(false)  ? 2
           : shader_.single_rays(true) ? samples_ + 1
                                       : std::numeric_limits<int>::max();
  }

  ShadingOptions shading_options() const {
    ShadingOptions shading;
    shading.specular_depth = static_cast<int>(options_.specular_depth);
    shading.cached_direct = cached_direct();
    shading.reflect_direct = options_.direct != DirectBy::none;
    return shading;
  }

  GBuffer see(int s) {
    const Stopwatch watch(result_.seconds, "visible surface");
    const Vec2 where = subpixel_offset(s, samples_);
    return by_gl() ? gl_->rasterise(camera_, width_, height_, where)
                   : trace_gbuffer(rays_, camera_, width_, height_, where);
  }

  SplatBuffer light_from_cache(const GBuffer& gbuffer) {
    if (options_.leak_test == LeakTest::ray) {
      const Stopwatch watch(result_.seconds, "lookups with leak test");
      return look_up(records_, gbuffer);
    }
    const Stopwatch watch(result_.seconds, "splat");
    return by_gl() ? gl_->splat(cache_.records, *options_.accuracy, gbuffer, camera_)
                   : splat_on_cpu(cache_.records, *options_.accuracy, gbuffer, camera_);
  }

  /// Empty if all gloss is traced.
  GlossBuffer gloss_from_cache(int s, const GBuffer& gbuffer) {
    if (!gloss_ || gloss_->size() == 0) return {};
    const Stopwatch watch(result_.seconds, "gloss splat");
    const Vec2 where = subpixel_offset(s, samples_);
    const double accuracy = *options_.gloss_accuracy;
    GlossBuffer drawn =
        options_.leak_test == LeakTest::ray ? look_up_gloss(*gloss_, rays_, gbuffer, camera_, where)
        : gloss_by_gl() ? gl_->splat_gloss(*gloss_, accuracy, rays_, gbuffer, camera_, where)
                        : splat_gloss_on_cpu(*gloss_, accuracy, rays_, gbuffer, camera_, where);
    result_.gloss.pairs += drawn.pairs, result_.gloss.turned_pixels += drawn.turned;
    return drawn;
  }

  /// Shadow maps have no light through panes: shadow rays stand in for them.
  bool by_maps() const { return options_.direct == DirectBy::shadow_map && !rays_.has_panes(); }
  int taps() const { return static_cast<int>(options_.shadow_filter); }

  /// Light of the lamps by shadow maps.
  std::vector<LampsAt> mapped_lamps(const GBuffer& gbuffer, std::span<const SeenSample> samples) {
    std::vector<LampsAt> light(samples.size());
    const MappedLamps lamps(rays_, taps(), options_.shadow_filter != ShadowFilter::none);
    gl_->each_lamp_map(gbuffer, static_cast<int>(options_.light_samples),
                       static_cast<int>(options_.shadow_map_size),
                       [&](const LampMap& map, bool extended) { lamps.add(map, extended, samples, light); });
    return light;
  }

  /// Of pixels on glossy surfaces; empty where rays light those, or there are none.
  void find_gloss_of_lamps(int s, const GBuffer& gbuffer) {
    gloss_lamps_.clear(), gloss_slot_.clear();
    if (!by_maps() || options_.shadow_filter == ShadowFilter::none) return;
    const Stopwatch watch(result_.seconds, "shadow maps");
    const Scene& scene = rays_.scene();
    std::vector<SeenSample> samples;
    gloss_slot_.assign(count_.size(), kNoSlot);
    for (std::size_t i = 0; i < count_.size(); ++i) {
      if (!gbuffer.covered(i)) continue;
      const std::uint32_t instance = scene.triangle_instance[gbuffer.hit[i].triangle];
      if (scene.material[scene.instance[instance].material].diffuse_alone()) continue;
      gloss_slot_[i] = static_cast<std::uint32_t>(samples.size());
      samples.push_back({ray_of(i, subpixel_offset(s, samples_)), gbuffer.hit[i]});
    }
    if (!samples.empty()) gloss_lamps_ = mapped_lamps(gbuffer, samples);
  }

  /// Empty if direct light is had another way.
  std::vector<SharedLight> shared_light(int s, const GBuffer& gbuffer) {
    const bool by_maps = this->by_maps();
    if (options_.direct == DirectBy::interleaved || (options_.direct == DirectBy::shadow_map && !by_maps)) {
      if (cached_direct()) return std::vector<SharedLight>(count_.size());
      const Stopwatch watch(result_.seconds, "interleaved direct light");
      return interleaved_light(rays_, lights_, gbuffer, pixel_rays_, subpixel_offset(s, samples_),
                               {shader_.lamp_rays_of_each(false), s, samples_, doublings_.direct},
                               options_.seed);
    }
    std::vector<SharedLight> shared;
    if (!by_maps) return shared;
    const Stopwatch watch(result_.seconds, "shadow maps");
    for (const Rgb& e : gl_->direct_illuminance(gbuffer, static_cast<int>(options_.light_samples),
                                                static_cast<int>(options_.shadow_map_size), taps()))
      shared.push_back({e, Rgb(0)});
    return shared;
  }

  void find_edges(const GBuffer& gbuffer) {
    const Stopwatch watch(result_.seconds, "edges");
    edges_ = edge_pixels(rays_.scene(), gbuffer);
    for (const std::uint32_t i : edges_)
      count_[i] = static_cast<std::uint16_t>(options_.pixel_samples + options_.edge_samples);
  }

  Ray ray_of(std::size_t pixel, const Vec2& where) const {
    const auto width = static_cast<std::size_t>(width_);
    return pixel_rays_(static_cast<int>(pixel % width), static_cast<int>(pixel / width), where);
  }

  void shade(int s, const GBuffer& gbuffer, const SplatBuffer& splats, const GlossBuffer& gloss,
             const std::vector<SharedLight>& shared) {
    const Stopwatch watch(result_.seconds, "shading");
    const Vec2 where = subpixel_offset(s, samples_);
    run(count_.size(), kChunk, [&](std::size_t i, ShadingResult& result) {
      const Ray ray = ray_of(i, where);
      if (!gbuffer.covered(i)) return layers_.add(i, shader_.background(ray));
      const SurfacePoint point = rays_.surface(ray, gbuffer.hit[i]);
      PixelShader::Splat splat{splats.at(i)};
      if (!gloss_lamps_.empty() && gloss_slot_[i] != kNoSlot) splat.lamps = &gloss_lamps_[gloss_slot_[i]];
      if (!gloss.light.empty()) splat.gloss = gloss.light[i], splat.gloss_error = gloss.error[i];
      layers_.add(i, shader_.shade({i, s}, ray, point, splat, shared.empty() ? nullptr : &shared[i], result));
      if (s == 0) layers_.set_surface(i, point.position, point.smooth_normal, point.distance_m);
    });
  }

  void shade_edges() {
    const Stopwatch watch(result_.seconds, "edges");
    const EdgeShader edge(rays_, lights_, pixel_rays_, shader_, options_, doublings_, cached_direct(), pass_);
    const auto each = static_cast<std::size_t>(options_.edge_samples);
    std::vector<LampsAt> lamps;
    if (by_maps()) {
      std::vector<SeenSample> samples(edges_.size() * each);
      parallel_for(edges_.size(), 64, [&](std::size_t e) {
        const std::vector<SeenSample> seen = edge.seen(edges_[e]);
        std::copy(seen.begin(), seen.end(), samples.begin() + static_cast<std::ptrdiff_t>(e * each));
      });
      lamps = mapped_lamps(pass_.gbuffer, samples);
    }
    run(edges_.size(), 64, [&](std::size_t e, ShadingResult& result) {
      edge.shade(edges_[e], layers_, result,
                 lamps.empty() ? std::span<const LampsAt>() : std::span(lamps).subspan(e * each, each));
    });
  }

  /// body(i, result) for i < n; results are joined in order.
  template <class Body>
  void run(std::size_t n, std::size_t chunk, const Body& body) {
    total_ = parallel_reduce(
        n, chunk, std::move(total_),
        [&](std::size_t begin, std::size_t end) {
          ShadingResult result;
          for (std::size_t i = begin; i < end; ++i) body(i, result);
          progress_.advance(end - begin);
          return result;
        },
        [](ShadingResult& total, ShadingResult& part) { total.join(part); });
  }

  void finish() {
    result_.looked_up = total_.looked_up, result_.missed = total_.missed;
    result_.edge_pixels = edges_.size();
    result_.counters = total_.log.counters;
    result_.misses = std::move(total_.log.misses), result_.gloss_misses = std::move(total_.log.gloss_misses);
    result_.gloss.looked_up = total_.gloss_looked_up, result_.gloss.missed = total_.gloss_missed;
    for (std::vector<Miss>* misses : {&result_.misses, &result_.gloss_misses})
      spread_misses(*misses, options_.seed, static_cast<std::size_t>(options_.max_misses));
    result_.image = layers_.image(count_);
  }

  const RayScene& rays_;
  const IrradianceCache& cache_;
  const GlossCache* gloss_;
  const RenderOptions& options_;
  const Doublings& doublings_;
  Rendering& result_;
  const Camera& camera_;
  int width_, height_, samples_;
  PixelRays pixel_rays_;
  Luminaires lights_;
  RecordTree records_;
  std::unique_ptr<const CausticLight> caustics_;
  Shading shading_;
  std::unique_ptr<const EnvironmentHarmonics> environment_;
  PixelShader shader_;
  std::unique_ptr<GlRenderer> gl_;
  Layers layers_;
  std::vector<std::uint16_t> count_;  // samples of each pixel
  std::vector<std::uint32_t> edges_;
  SeenPicture pass_;                       // the latest
  std::vector<LampsAt> gloss_lamps_;       // of it, of glossy pixels
  std::vector<std::uint32_t> gloss_slot_;  // by pixel, where there
  ShadingResult total_;
  Progress progress_;
};

}  // namespace

Rendering render_scene(const RayScene& rays, const IrradianceCache& cache, const RenderOptions& options,
                       std::span<const BrdfTable> brdfs, const GlossCache* gloss, const RecordLives& lives,
                       const Doublings& doublings) {
  Rendering result;
  Painter(rays, cache, options, brdfs, gloss, doublings, result).make();
  if (options.overlay == Overlay::records) {
    result.drawn = draw_records(result.image, cache.records, *options.accuracy, rays,
                                find_camera(rays.scene(), options.camera), options.overlay_colour, lives);
    draw_legend(result.image, result.drawn, options.overlay_colour);
  }
  return result;
}

}  // namespace phos::inline splat
