#include "splat/render.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "file/atomic_file.h"
#include "scene/load.h"
#include "splat/splatter.h"

namespace phos {

namespace {

constexpr double kMaxPixels = 268435456.;  // 2^28

/// Sums over pixel samples; one entry per pixel.
struct Layers {
  explicit Layers(std::size_t n)
      : direct(n),
        indirect(n),
        glossy(n),
        specular(n),
        emission(n),
        albedo(n),
        normal(n),
        position(n),
        noise(n),
        sampled(n),
        sampled_square(n),
        indirect_error(n),
        illuminance(n),
        weight(n),
        depth(n) {}
  std::vector<Rgb> direct, indirect, glossy, specular, emission, albedo, normal, position;
  std::vector<Rgb> noise;  ///< variance of direct light and gloss, summed over pixel samples
  std::vector<Rgb> sampled, sampled_square;  ///< the two as each pixel sample saw them
  std::vector<Rgb> indirect_error;  ///< summed as if fully correlated between samples (they share records)
  std::vector<float> illuminance, weight, depth;
};

/// Offsets inside the pixel: the centre for one sample, else the additive R2 sequence about it.
Vec2 subpixel(int sample, int samples) {
  if (samples == 1) return {0.5f, 0.5f};
  const double x = 0.5 + 0.7548776662466927 * sample;
  const double y = 0.5 + 0.5698402909980532 * sample;
  return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

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

/// What shading some pixels leaves besides the layers.
struct ChunkResult {
  ShadingLog log;
  std::uint64_t looked_up = 0, missed = 0;
  void join(const ChunkResult& other) {
    looked_up += other.looked_up, missed += other.missed;
    log.counters.merge(other.log.counters);
    log.misses.insert(log.misses.end(), other.log.misses.begin(), other.log.misses.end());
  }
};

/// Of rays for a whole pixel, those of each of its samples: at least one, if there are any.
int samples_of_each(std::int64_t of_pixel, std::int64_t pixel_samples) {
  return static_cast<int>((of_pixel + pixel_samples - 1) / pixel_samples);
}

/// One sample of every pixel, from G-buffer to layers.
class SamplePass {
 public:
  SamplePass(const RayScene& rays, const Camera& camera, const Shading& shading, const RecordTree& records,
             const RenderOptions& options, bool cached_direct, const GBuffer& gbuffer,
             const SplatBuffer& splats, const std::vector<Rgb>& shadow_mapped, int sample, Layers& layers)
      : rays_(rays),
        camera_(camera),
        shading_(shading),
        records_(records),
        options_(options),
        cached_direct_(cached_direct),
        gbuffer_(gbuffer),
        splats_(splats),
        shadow_mapped_(shadow_mapped),
        sample_(sample),
        layers_(layers) {}

  void shade(std::size_t i, ChunkResult& result) const {
    if (!gbuffer_.covered(i)) return;
    const int x = static_cast<int>(i % static_cast<std::size_t>(gbuffer_.width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(gbuffer_.width));
    const Ray ray = pixel_ray(camera_, gbuffer_.width, gbuffer_.height, x, y,
                              subpixel(sample_, static_cast<int>(options_.pixel_samples)));
    const SurfacePoint point = rays_.surface(ray, gbuffer_.hit[i]);
    const Bsdf bsdf(rays_.scene(), point);
    const Vec3 wo = -ray.direction;
    // What the samples of a pixel share, and each one's own.
    RandomStream sequence(options_.seed, Stage::direct_light, i);
    RandomStream random(
        options_.seed, Stage::specular,
        i * static_cast<std::uint64_t>(options_.pixel_samples) + static_cast<std::uint64_t>(sample_));
    layers_.emission[i] += emitted_luminance(rays_.scene(), point);
    layers_.albedo[i] += bsdf.diffuse_reflectance();
    if (bsdf.has_diffuse()) {
      ++result.looked_up;
      if (!from_cache(i, point, bsdf)) {
        ++result.missed;
        result.log.misses.push_back({point.position, point.smooth_normal});
      }
    }
    Rgb sampled = from_lights(i, point, bsdf, wo, sequence);
    if (bsdf.has_gloss()) sampled += from_gloss(i, point, bsdf, wo, sequence, random, result.log);
    layers_.sampled[i] += sampled;
    layers_.sampled_square[i] += sampled * sampled;
    layers_.specular[i] += shading_.specular(point, bsdf, wo, 0, Rgb(1), random, result.log);
    if (sample_ == 0) {
      layers_.normal[i] = point.smooth_normal;
      layers_.position[i] = point.position;
      layers_.depth[i] = gbuffer_.hit[i].distance_m;
    }
  }

 private:
  bool from_cache(std::size_t i, const SurfacePoint& point, const Bsdf& bsdf) const {
    Vec4 light = splats_.light[i], error = splats_.error[i];
    if (!(light.w > 0)) {
      // On the rim of a record rounding decides, and the lookup that places records has the last word: else
      // the loop over misses would ask for the same point for ever.
      const Interpolated found = records_.interpolate(point.position, point.smooth_normal);
      light = Vec4(found.irradiance * found.weight, found.weight);
      error = Vec4(found.stderr_lx * found.weight, 0);
    }
    layers_.weight[i] += light.w;
    if (!(light.w > 0)) return false;
    const Rgb irradiance = Rgb(light) / light.w;
    const Rgb reflected = bsdf.diffuse_reflectance() / kPi;
    layers_.indirect[i] += irradiance * reflected;
    layers_.indirect_error[i] += Rgb(error) / light.w * reflected;
    layers_.illuminance[i] += luminance(irradiance);
    return true;
  }

  /// This pixel sample's part of what is asked for the whole pixel.
  SampleRange range(std::int64_t of_pixel) const {
    const int n = samples_of_each(of_pixel, options_.pixel_samples);
    return {sample_ * n, n, static_cast<int>(options_.pixel_samples) * n};
  }

  /// Returns what is subject to noise.
  Rgb from_lights(std::size_t i, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                  RandomStream& sequence) const {
    const bool diffuse = bsdf.has_diffuse() && !cached_direct_;
    if (options_.direct == DirectBy::shadow_map && diffuse) {
      layers_.direct[i] += shadow_mapped_[i] * bsdf.diffuse_reflectance() / kPi;
      layers_.illuminance[i] += luminance(shadow_mapped_[i]);
    }
    if (options_.direct != DirectBy::traced || !(diffuse || bsdf.has_gloss())) return Rgb(0);
    const DirectLight light = shading_.direct(point, bsdf, wo, range(options_.light_samples),
                                              range(options_.gloss_samples).count, sequence);
    layers_.direct[i] += light.radiance;
    layers_.noise[i] += light.variance;
    if (!cached_direct_) layers_.illuminance[i] += luminance(light.illuminance);
    return light.radiance;
  }

  Rgb from_gloss(std::size_t i, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                 RandomStream& sequence, RandomStream& random, ShadingLog& log) const {
    // Shadow maps light diffuse surfaces only: what glossy ones show of the lamps is left to these rays.
    const int light_samples = options_.direct == DirectBy::traced ? range(options_.light_samples).count : 0;
    const GlossLight light = shading_.gloss(point, bsdf, wo, range(options_.gloss_samples), light_samples, 0,
                                            sequence, random, log);
    layers_.glossy[i] += light.radiance;
    layers_.noise[i] += light.variance;
    if (options_.direct == DirectBy::none) return light.radiance;
    layers_.direct[i] += light.from_lamps;
    return light.radiance + light.from_lamps;
  }

  const RayScene& rays_;
  const Camera& camera_;
  const Shading& shading_;
  const RecordTree& records_;
  const RenderOptions& options_;
  bool cached_direct_;
  const GBuffer& gbuffer_;
  const SplatBuffer& splats_;
  const std::vector<Rgb>& shadow_mapped_;
  int sample_;
  Layers& layers_;
};

void average(std::vector<Rgb>& sums, float samples) {
  for (Rgb& v : sums) v /= samples;
}

/// `single`: each pixel sample sent one ray only, so that the noise shows in the spread of the samples alone.
Image make_image(Layers& layers, int width, int height, int samples, bool single) {
  Image image(width, height);
  const auto n = static_cast<float>(samples);
  std::vector<Rgb> beauty(image.pixels()), error(image.pixels());
  for (auto* sums : {&layers.direct, &layers.indirect, &layers.glossy, &layers.specular, &layers.emission,
                     &layers.albedo, &layers.indirect_error})
    average(*sums, n);
  for (std::size_t i = 0; i < beauty.size(); ++i) {
    beauty[i] =
        layers.direct[i] + layers.indirect[i] + layers.glossy[i] + layers.specular[i] + layers.emission[i];
    Rgb variance = layers.noise[i] / (n * n);
    if (single && samples > 1) {
      const Rgb mean = layers.sampled[i] / n;
      variance = glm::max(layers.sampled_square[i] / n - mean * mean, Rgb(0)) / (n - 1);
    }
    error[i] = glm::sqrt(variance + layers.indirect_error[i] * layers.indirect_error[i]);
  }
  image.set_rgb("", beauty);
  image.set_rgb("direct", layers.direct);
  image.set_rgb("indirect", layers.indirect);
  image.set_rgb("emission", layers.emission);
  image.set_rgb("albedo", layers.albedo);
  image.set_rgb("stderr", error);
  const auto some = [](const std::vector<Rgb>& v) {
    return std::any_of(v.begin(), v.end(), [](const Rgb& c) { return c != Rgb(0); });
  };
  if (some(layers.glossy)) image.set_rgb("glossy", layers.glossy);
  if (some(layers.specular)) image.set_rgb("specular", layers.specular);
  for (std::size_t i = 0; i < beauty.size(); ++i) {
    image.channel("illuminance.Y")[i] = layers.illuminance[i] / n;
    image.channel("weight.Y")[i] = layers.weight[i] / n;
    image.channel("Z")[i] = layers.depth[i];
    for (int c = 0; c < 3; ++c) {
      const std::string axis(1, "XYZ"[c]);
      image.channel("normal." + axis)[i] = layers.normal[i][c];
      image.channel("position." + axis)[i] = layers.position[i][c];
    }
  }
  return image;
}

/// Puts misses in a pseudo-random order, so that the first few already cover the picture, and keeps at most
/// `most`.
void spread(std::vector<Miss>& misses, std::uint64_t seed, std::size_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order(misses.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = {RandomStream(seed, Stage::camera, i).bits(), static_cast<std::uint32_t>(i)};
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), most));
  std::vector<Miss> kept;
  kept.reserve(order.size());
  for (const auto& [key, i] : order) kept.push_back(misses[i]);
  misses = std::move(kept);
}

}  // namespace

void declare_options(Options& options, RenderOptions& r) {
  options.section("Picture");
  options.text("camera", r.camera, "NAME", "camera of the scene; the first one if not given");
  options.integer("width", r.width, "PIXELS", "width; 0: from the height and the camera's aspect",
                  {0, 65536});
  options.integer("height", r.height, "PIXELS", "height; 0: from the width; both 0: 1000 on the longer side",
                  {0, 65536});
  options.integer("pixel-samples", r.pixel_samples, "N", "samples per pixel, averaged (anti-aliasing)",
                  {1, 4096});
  options.section("Light from the cache");
  options.number("accuracy", r.accuracy, "A",
                 "how far a record reaches: error allowed between records (smaller: fewer, closer records "
                 "are blended; more "
                 "misses); what the cache was placed with if not given",
                 kPositive);
  options.choice<SplatBy>("splat", r.splat, {{"gl", SplatBy::gl}, {"cpu", SplatBy::cpu}},
                          "draw the records with OpenGL (OSMesa) or on the CPU (same picture to 1e-4)");
  options.integer("max-misses", r.max_misses, "N", "at most this many points go into --misses", kNotNegative,
                  Recorded::no);
  options.section("Direct light, gloss, mirrors and glass");
  options.choice<DirectBy>(
      "direct", r.direct,
      {{"traced", DirectBy::traced}, {"shadow-map", DirectBy::shadow_map}, {"none", DirectBy::none}},
      "direct light: by shadow rays, by shadow maps (fast preview, diffuse only), or left out");
  options.integer("light-samples", r.light_samples, "N",
                  "shadow rays per area light and pixel, shared among its samples (one each at least); or "
                  "shadow maps per area light",
                  {1, 65536});
  options.integer("shadow-map-size", r.shadow_map_size, "PIXELS", "side of a shadow map", {16, 8192});
  options.integer("gloss-samples", r.gloss_samples, "N",
                  "rays per pixel on a glossy surface, shared among its samples", {0, 65536});
  options.integer("specular-depth", r.specular_depth, "N", "longest chain of mirrors and glass", {0, 1000});
  declare_isa(options, r.isa);
}

void resolve(RenderOptions& r, const Camera& camera, const IrradianceCache& cache) {
  const double aspect =
      camera.aspect > 0 && std::isfinite(camera.aspect) ? static_cast<double>(camera.aspect) : 1;
  const auto rounded = [](double pixels) {
    return static_cast<std::int64_t>(std::fmin(std::fmax(std::round(pixels), 1), 1e9));
  };
  if (r.width == 0 && r.height == 0) (aspect >= 1 ? r.width : r.height) = 1000;
  if (r.width == 0) r.width = rounded(static_cast<double>(r.height) * aspect);
  if (r.height == 0) r.height = rounded(static_cast<double>(r.width) / aspect);
  if (static_cast<double>(r.width) * static_cast<double>(r.height) > kMaxPixels)
    throw Error(ExitCode::usage, "--width",
                text(r.width, " x ", r.height, " pixels are too many; at most 2^28"));
  if (!r.accuracy) r.accuracy = cache.accuracy;
}

Rendering render_scene(const RayScene& rays, const IrradianceCache& cache, const RenderOptions& options) {
  const Camera& camera = find_camera(rays.scene(), options.camera);
  const int width = static_cast<int>(options.width);
  const int height = static_cast<int>(options.height);
  const int samples = static_cast<int>(options.pixel_samples);
  Rendering result;

  const Luminaires lights(rays.scene());
  RecordTree records(rays.scene().bounds, *options.accuracy);
  for (const IrradianceRecord& r : cache.records) records.insert(r);
  ShadingOptions shading_options;
  shading_options.specular_depth = static_cast<int>(options.specular_depth);
  shading_options.cached_direct = cache.quantity == "all";
  shading_options.reflect_direct = options.direct != DirectBy::none;
  const Shading shading(rays, lights, records, shading_options);

  std::unique_ptr<GlRenderer> gl;
  if (options.splat == SplatBy::gl || options.direct == DirectBy::shadow_map)
    gl = std::make_unique<GlRenderer>(rays.scene());
  result.renderer = gl ? gl->description() : "cpu";

  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Layers layers(pixels);
  Progress progress("rendering", pixels * static_cast<std::uint64_t>(samples), "pixel samples");
  ChunkResult total;
  for (int s = 0; s < samples; ++s) {
    GBuffer gbuffer;
    SplatBuffer splats;
    std::vector<Rgb> shadow_mapped;
    {
      const Stopwatch watch(result.seconds, "visible surface");
      gbuffer = options.splat == SplatBy::gl
                    ? gl->rasterise(camera, width, height, subpixel(s, samples))
                    : trace_gbuffer(rays, camera, width, height, subpixel(s, samples));
    }
    {
      const Stopwatch watch(result.seconds, "splat");
      splats = options.splat == SplatBy::gl ? gl->splat(cache.records, *options.accuracy, gbuffer, camera)
                                            : splat_on_cpu(cache.records, *options.accuracy, gbuffer, camera);
    }
    if (options.direct == DirectBy::shadow_map) {
      const Stopwatch watch(result.seconds, "shadow maps");
      shadow_mapped = gl->direct_illuminance(gbuffer, static_cast<int>(options.light_samples),
                                             static_cast<int>(options.shadow_map_size));
    }
    const Stopwatch watch(result.seconds, "shading");
    const SamplePass pass(rays, camera, shading, records, options, shading_options.cached_direct, gbuffer,
                          splats, shadow_mapped, s, layers);
    const ChunkResult shaded = parallel_reduce(
        pixels, 1024, ChunkResult{},
        [&](std::size_t begin, std::size_t end) {
          ChunkResult chunk;
          for (std::size_t i = begin; i < end; ++i) pass.shade(i, chunk);
          progress.advance(end - begin);
          return chunk;
        },
        [](ChunkResult& total, ChunkResult& chunk) { total.join(chunk); });
    total.join(shaded);
  }
  result.looked_up = total.looked_up, result.missed = total.missed;
  result.counters = total.log.counters;
  result.misses = std::move(total.log.misses);
  spread(result.misses, options.seed, static_cast<std::size_t>(options.max_misses));
  const bool single = samples_of_each(options.light_samples, samples) == 1 ||
                      samples_of_each(options.gloss_samples, samples) == 1;
  result.image = make_image(layers, width, height, samples, single);
  return result;
}

void write_misses(const std::string& path, const std::vector<Miss>& misses) {
  std::string csv = "x,y,z,nx,ny,nz\n";
  for (const Miss& m : misses) {
    for (int c = 0; c < 3; ++c) csv += shortest(m.position[c]) + ",";
    for (int c = 0; c < 3; ++c) csv += shortest(m.normal[c]) + (c < 2 ? "," : "\n");
  }
  AtomicFile file(path);
  file.write(csv);
  file.commit();
}

}  // namespace phos
