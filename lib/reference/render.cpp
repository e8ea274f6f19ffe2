#include "reference/render.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/parallel.h"
#include "core/progress.h"
#include "reference/camera_view.h"
#include "reference/central_moments.h"
#include "reference/events.h"
#include "reference/map/map_light.h"
#include "reference/moments.h"
#include "reference/passes.h"
#include "reference/render_options.h"
#include "reference/sample_shares.h"
#include "scene/material/bsdf.h"
#include "scene/material/sharp_materials.h"

namespace phos::inline reference {

namespace {

constexpr std::int64_t kFirstPass = 16;
/// Adaptive: one in so many samples, and so many at least, tell where the rest should go.
constexpr std::int64_t kProbingShare = 4, kLeastProbes = 4;
constexpr std::size_t kSamplesPerChunk = 4096;
/// Light paths of a pass over the picture: one a pixel; at most so many, as all of their vertices are held,
/// and at least so many where eye paths are merged with them.
constexpr std::size_t kMostLightPaths = 32768, kLeastLightPaths = 8192;
constexpr std::size_t kVerticesPerChunk = 1024, kPixelsPerChunk = 256;
// Bit 63 distinguishes the paths of the illuminance layer from the picture's paths (pixel < 2^31).
constexpr std::uint64_t kIlluminanceItem = std::uint64_t{1} << 63;

struct Channels {
  std::array<double, 3> sum{}, squares{};
  void add(const Rgb& c) {
    for (int k = 0; k < 3; ++k) {
      const double v = c[k];
      sum[static_cast<std::size_t>(k)] += v, squares[static_cast<std::size_t>(k)] += v * v;
    }
  }
};

Rgb mean(const std::array<double, 3>& sum, double n) { return {sum[0] / n, sum[1] / n, sum[2] / n}; }

/// What a pixel's samples add up to.
struct Pixel {
  std::uint32_t taken = 0, count = 0;  // count: that were finite
  Channels total, indirect, bias;
  DVec3 emission{0}, direct{0}, glossy{0}, specular{0};
  Moments scattered, illuminance, illuminance_bias;
  CentralMoments spread;  // of the scattered light
};

PathSample& operator+=(PathSample& sum, const PathSample& part) {
  sum.emission += part.emission, sum.direct += part.direct, sum.indirect += part.indirect;
  sum.glossy += part.glossy, sum.specular += part.specular;
  return sum;
}

/// What paths from both ends need.
struct BothEnds {
  BothEnds(const RayScene& rays, const Luminaires& luminaires, const Camera& camera,
           const ReferenceOptions& options)
      : lamps(rays.scene(), luminaires),
        light(rays, luminaires, lamps, options.path),
        eyes(rays, luminaires, lamps, options.path),
        light_paths(
            std::clamp(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height),
                       has_caustic_ways(rays.scene()) ? kLeastLightPaths : 1, kMostLightPaths)),
        view(camera, static_cast<std::size_t>(options.width), static_cast<std::size_t>(options.height),
             static_cast<double>(light_paths)),
        merge_radius_m(has_caustic_ways(rays.scene()) ? first_merge_radius_m(rays.scene()) : 0) {}
  LightStarts lamps;
  LightTracer light;
  BidirectionalTracer eyes;
  std::size_t light_paths;
  CameraView view;
  float merge_radius_m;
  std::uint64_t passes = 0;
};

class Renderer {
 public:
  Renderer(const RayScene& rays, const Luminaires& luminaires, const Camera& camera,
           const ReferenceOptions& options, const MapLight* map)
      : rays_(rays),
        map_(map),
        tracer_(rays, luminaires, options.path),
        camera_(camera),
        options_(options),
        pixels_(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height)) {
    if (options.method == ReferenceMethod::bidirectional) both_.emplace(rays, luminaires, camera, options);
  }

  /// As many more samples of every pixel; or, if they are to be shared out, on the mean.
  void pass(std::int64_t more, bool shared_out);
  double error() const;
  bool trusted() const;
  std::uint64_t rejected() const { return rejected_; }
  Image image() const;

 private:
  Ray ray(std::size_t pixel, const Vec2& subpixel) const;
  std::uint64_t sample(std::size_t pixel);
  std::uint64_t add(std::size_t pixel, const PathSample& light, const Rgb& bias, float lux, float lux_bias);
  Ray next_ray(std::size_t pixel, RandomStream& random, std::uint64_t& item);
  void take_both_ends();
  std::vector<PathSample> splats(const LightPass& light) const;
  std::uint64_t sample_both_ends(std::size_t pixel, const LightPass& light, const PathSample& splat);
  std::uint64_t sample_map(std::size_t pixel);
  bool sample_illuminance(const Ray& ray, std::uint64_t item, float& lux) const;
  void add_light(Image& image) const;
  void add_surfaces(Image& image) const;

  const RayScene& rays_;
  const MapLight* map_;
  EyePathTracer tracer_;
  const Camera& camera_;
  const ReferenceOptions& options_;
  std::vector<Pixel> pixels_;
  std::uint64_t rejected_ = 0;
  std::optional<BothEnds> both_;
};

Ray Renderer::ray(std::size_t pixel, const Vec2& subpixel) const {
  const auto width = static_cast<std::size_t>(options_.width);
  const Vec2 size(static_cast<float>(options_.width), static_cast<float>(options_.height));
  const Vec2 corner(static_cast<float>(pixel % width), static_cast<float>(pixel / width));
  const Camera::Ray ray = camera_.ray((corner + subpixel) / size, size.x / size.y);
  return {ray.origin, ray.direction, 0, kInfinity};
}

/// Illuminance of the surface that a camera ray sees, on the side seen; 0 where there is none.
bool Renderer::sample_illuminance(const Ray& ray, std::uint64_t item, float& lux) const {
  SurfacePoint point;
  lux = 0;
  if (!trace(rays_, ray, point)) return true;
  RandomStream random(options_.seed, Stage::reference, item | kIlluminanceItem);
  lux = luminance(tracer_.irradiance(point, random));
  return std::isfinite(lux);
}

/// Where the pixel's next sample goes; `item` is the item of its random numbers.
Ray Renderer::next_ray(std::size_t pixel, RandomStream& random, std::uint64_t& item) {
  const std::uint32_t s = pixels_[pixel].taken++;
  item = (static_cast<std::uint64_t>(pixel) << 32) | static_cast<std::uint64_t>(s);
  random = RandomStream(options_.seed, Stage::reference, item);
  random.start_bounce(0xffff);  // the lens comes before bounce 0, which the path starts itself
  const Vec2 stratum(static_cast<float>(s & 1), static_cast<float>((s >> 1) & 1));
  return ray(pixel, 0.5f * (stratum + random.uniform2()));
}

/// Returns how many samples were not finite (0 or 1).
std::uint64_t Renderer::add(std::size_t pixel, const PathSample& light, const Rgb& bias, float lux,
                            float lux_bias) {
  const Rgb total = light.total();
  if (!is_finite(total) || !is_finite(bias) || !std::isfinite(lux) || !std::isfinite(lux_bias)) return 1;
  Pixel& sum = pixels_[pixel];
  ++sum.count;
  sum.total.add(total);
  sum.indirect.add(light.indirect);
  sum.bias.add(bias);
  sum.emission += DVec3(light.emission), sum.direct += DVec3(light.direct), sum.glossy += DVec3(light.glossy),
      sum.specular += DVec3(light.specular);
  sum.scattered.add(luminance(total - light.emission));
  sum.spread.add(static_cast<double>(luminance(total - light.emission)));
  if (options_.illuminance) sum.illuminance.add(lux), sum.illuminance_bias.add(lux_bias);
  return 0;
}

/// The pixel's next. Returns how many samples were not finite (0 or 1).
std::uint64_t Renderer::sample(std::size_t pixel) {
  if (map_) return sample_map(pixel);
  RandomStream random(0, Stage::reference, 0);
  std::uint64_t item = 0;
  const Ray eye = next_ray(pixel, random, item);
  const PathSample light = tracer_.luminance(eye, random);
  float lux = 0;
  if (options_.illuminance && !sample_illuminance(eye, item, lux)) return 1;
  return add(pixel, light, Rgb(0), lux, 0);
}

/// The same by a method that reads a photon map.
std::uint64_t Renderer::sample_map(std::size_t pixel) {
  RandomStream random(0, Stage::reference, 0);
  std::uint64_t item = 0;
  const Ray eye = next_ray(pixel, random, item);
  const MapSample light = map_->luminance(eye, random);
  SurfacePoint point;
  DiscIrradiance lux;
  if (options_.illuminance && trace(rays_, eye, point)) {
    RandomStream own(options_.seed, Stage::reference, item | kIlluminanceItem);
    lux = map_->irradiance(point, own);
  }
  return add(pixel, light.sum, light.noise, luminance(lux.irradiance_lx), luminance(lux.noise_lx));
}

/// What light paths bring to the camera themselves, for each pixel.
std::vector<PathSample> Renderer::splats(const LightPass& light) const {
  struct Splat {
    std::size_t pixel;
    PathSample sample;
  };
  const std::vector<LightVertex>& vertices = light.paths.vertex;
  std::vector<PathSample> sum(pixels_.size());
  const float each = 1 / static_cast<float>(light.paths.size());
  std::vector<Splat> all = parallel_reduce(
      vertices.size(), kVerticesPerChunk, std::vector<Splat>(),
      [&](std::size_t first, std::size_t last) {
        std::vector<Splat> part;
        for (std::size_t i = first; i < last; ++i) {
          PixelSight sight;
          if (!both_->view.see(vertices[i].point.position, sight)) continue;
          const PathSample sample =
              both_->eyes.splat(vertices[i], sight.towards, sight.distance_m, sight.start);
          if (sample.total() != Rgb(0)) part.push_back({sight.pixel, sample});
        }
        return part;
      },
      [](std::vector<Splat>& joined, const std::vector<Splat>& part) {
        joined.insert(joined.end(), part.begin(), part.end());
      });
  for (Splat& splat : all) {
    for (Rgb* c : {&splat.sample.direct, &splat.sample.indirect, &splat.sample.glossy}) *c *= each;
    sum[splat.pixel] += splat.sample;
  }
  return sum;
}

std::uint64_t Renderer::sample_both_ends(std::size_t pixel, const LightPass& light, const PathSample& splat) {
  RandomStream random(0, Stage::reference, 0);
  std::uint64_t item = 0;
  const Ray eye = next_ray(pixel, random, item);
  const std::size_t path = pixel % light.paths.size();
  BidirectionalSample sample =
      both_->eyes.luminance(eye, both_->view.start(eye.direction), light, path, random);
  sample.sum += splat;
  SurfacePoint point;
  BidirectionalSample lux;
  if (options_.illuminance && trace(rays_, eye, point)) {
    RandomStream own(options_.seed, Stage::reference, item | kIlluminanceItem);
    lux = both_->eyes.surface_irradiance(point, light, path, own);
  }
  return add(pixel, sample.sum, sample.bias, luminance(lux.sum.total()), luminance(lux.bias));
}

/// One more sample of every pixel.
void Renderer::take_both_ends() {
  const std::uint64_t pass = both_->passes++;
  const float radius_m = both_->merge_radius_m * static_cast<float>(std::sqrt(shrunk_area(pass)));
  const LightPass light = make_pass(both_->light, options_.seed, pass, both_->light_paths, radius_m);
  const std::vector<PathSample> splat = splats(light);
  rejected_ = parallel_reduce(
      pixels_.size(), kPixelsPerChunk, rejected_,
      [&](std::size_t first, std::size_t last) {
        std::uint64_t rejected = 0;
        for (std::size_t i = first; i < last; ++i) rejected += sample_both_ends(i, light, splat[i]);
        return rejected;
      },
      [](std::uint64_t& sum, std::uint64_t part) { sum += part; });
}

void Renderer::pass(std::int64_t more, bool shared_out) {
  if (both_) {
    Progress progress("reference", static_cast<std::uint64_t>(more), "passes");
    for (std::int64_t i = 0; i < more; ++i) take_both_ends(), progress.advance();
    return;
  }
  const auto mean = static_cast<std::size_t>(more);
  std::vector<std::uint32_t> share;
  if (shared_out) {
    std::vector<double> variance;
    for (const Pixel& p : pixels_) variance.push_back(p.scattered.variance());
    share = sample_shares(variance, static_cast<std::size_t>(options_.width), more);
  }
  const std::size_t chunk = std::max<std::size_t>(1, kSamplesPerChunk / mean);
  Progress progress("reference", pixels_.size() * mean, "samples");
  rejected_ = parallel_reduce(
      pixels_.size(), chunk, rejected_,
      [&](std::size_t first, std::size_t last) {
        std::uint64_t rejected = 0, taken = 0;
        for (std::size_t pixel = first; pixel < last; ++pixel) {
          const std::uint32_t count = shared_out ? share[pixel] : static_cast<std::uint32_t>(more);
          for (std::uint32_t s = 0; s < count; ++s) rejected += sample(pixel);
          taken += count;
        }
        progress.advance(taken);
        return rejected;
      },
      [](std::uint64_t& sum, std::uint64_t part) { sum += part; });
}

double Renderer::error() const {
  double squares = 0, light = 0;
  for (const Pixel& p : pixels_) {
    squares += p.scattered.standard_error() * p.scattered.standard_error();
    light += p.scattered.mean();
    if (!map_ || p.count == 0) continue;
    // Samples of a pixel share the noise of its photons, in all channels alike.
    const double noise = static_cast<double>(luminance(mean(p.bias.sum, p.count)));
    squares += noise * noise;
  }
  const auto n = static_cast<double>(pixels_.size());
  return light > 0 ? std::sqrt(squares / n) / (light / n) : 0;
}

bool Renderer::trusted() const {
  double squares = 0, fourths = 0;
  bool any = false;
  for (const Pixel& p : pixels_)
    squares += p.spread.squares(), fourths += p.spread.fourths(), any |= p.spread.any();
  return any && !(fourths > kFewBright * squares * squares);
}

Rgb standard_error(const Channels& c, double n) {
  Rgb error(0);
  if (n < 2) return error;
  for (std::size_t k = 0; k < 3; ++k) {
    const double m = c.sum[k] / n;
    error[static_cast<int>(k)] =
        static_cast<float>(std::sqrt(std::max(0.0, (c.squares[k] / n - m * m) / (n - 1))));
  }
  return error;
}

/// With the bias, as far as it is more than its own noise.
Rgb standard_error(const Pixel& p, double n) {
  const DVec3 noise(standard_error(p.total, n)), bias(mean(p.bias.sum, n)), doubt(standard_error(p.bias, n));
  return Rgb(glm::sqrt(noise * noise + glm::max(DVec3(0), bias * bias - doubt * doubt)));
}

void Renderer::add_light(Image& image) const {
  const auto set = [&](const std::string& layer, const auto& value) {
    std::vector<Rgb> values(pixels_.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = value(pixels_[i], std::max(1.0, static_cast<double>(pixels_[i].count)));
    image.set_rgb(layer, values);
  };
  set("", [](const Pixel& p, double n) { return mean(p.total.sum, n); });
  set("emission", [](const Pixel& p, double n) { return Rgb(p.emission / n); });
  set("direct", [](const Pixel& p, double n) { return Rgb(p.direct / n); });
  set("indirect", [](const Pixel& p, double n) { return mean(p.indirect.sum, n); });
  set("stderr", [](const Pixel& p, double n) { return standard_error(p, n); });
  set("indirect_stderr", [](const Pixel& p, double n) { return standard_error(p.indirect, n); });
  for (const auto& [layer, part] :
       {std::pair{"glossy", &Pixel::glossy}, std::pair{"specular", &Pixel::specular}}) {
    const auto of = [part = part](const Pixel& p) { return p.*part; };
    if (std::any_of(pixels_.begin(), pixels_.end(), [&](const Pixel& p) { return of(p) != DVec3(0); }))
      set(layer, [&](const Pixel& p, double n) { return Rgb(of(p) / n); });
  }
  if (!options_.illuminance) return;
  const std::span<float> lux = image.channel("illuminance.Y");
  const std::span<float> error = image.channel("illuminance_stderr.Y");
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    lux[i] = static_cast<float>(pixels_[i].illuminance.mean());
    error[i] =
        static_cast<float>(with_bias(pixels_[i].illuminance.standard_error(), pixels_[i].illuminance_bias));
  }
}

/// What the ray through the centre of each pixel finds.
void Renderer::add_surfaces(Image& image) const {
  std::vector<Rgb> albedo(pixels_.size());
  std::array<std::span<float>, 3> normal, position;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis(1, "XYZ"[k]);
    normal[k] = image.channel("normal." + axis), position[k] = image.channel("position." + axis);
  }
  const std::span<float> z = image.channel("Z");
  parallel_for(pixels_.size(), 1024, [&](std::size_t i) {
    SurfacePoint point;
    if (!trace(rays_, ray(i, {0.5f, 0.5f}), point)) return;
    albedo[i] = Bsdf(rays_.scene(), point).diffuse_reflectance();
    for (std::size_t k = 0; k < 3; ++k) {
      normal[k][i] = point.smooth_normal[static_cast<int>(k)];
      position[k][i] = point.position[static_cast<int>(k)];
    }
    z[i] = point.distance_m;
  });
  image.set_rgb("albedo", albedo);
}

Image Renderer::image() const {
  Image image(static_cast<int>(options_.width), static_cast<int>(options_.height));
  add_light(image);
  add_surfaces(image);
  return image;
}

}  // namespace

double reference_bytes(const ReferenceOptions& options) {
  // Layers: nine of three channels, normal, position, Z, and two of illuminance; one more while it is filled.
  constexpr double kLayers = sizeof(float) * (9 * 3 + 3 + 3 + 1 + 2 + 3);
  double of_pixel = sizeof(Pixel) + kLayers;
  if (options.method == ReferenceMethod::bidirectional) of_pixel += sizeof(PathSample);
  return of_pixel * static_cast<double>(options.width) * static_cast<double>(options.height);
}

ReferencePicture render_reference(const RayScene& rays, const Luminaires& luminaires, const Camera& camera,
                                  const ReferenceOptions& options, const MapLight* map) {
  Renderer renderer(rays, luminaires, camera, options, map);
  ReferencePicture result;
  while (result.samples < options.samples) {
    std::int64_t next = options.samples;
    if (result.samples == 0) {
      if (options.adaptive) next = std::min(next, std::max(kLeastProbes, next / kProbingShare / 4 * 4));
      if (options.error) next = std::min(next, kFirstPass);
    } else if (options.error) {
      // The error falls with the root of the number; a little beyond, and no more than fourfold on a noisy
      // estimate.
      const double ratio = result.error / std::max(*options.error, 1e-9);
      const double wanted = static_cast<double>(result.samples) * std::clamp(1.02 * ratio * ratio, 1.1, 4.0);
      next = std::min(next, 4 * ((static_cast<std::int64_t>(wanted) + 3) / 4));
    }
    renderer.pass(next - result.samples, options.adaptive && result.samples > 0);
    result.samples = next;
    result.error = renderer.error();
    result.trusted = luminaires.size() == 0 || renderer.trusted();
    if (options.error && result.error <= *options.error && result.trusted) break;
  }
  result.image = renderer.image();
  const std::uint64_t rejected = renderer.rejected();
  if (rejected > 0) result.counters.count(kNonFiniteSampleEvent, rejected);
  const auto trials = result.image.pixels() * static_cast<std::uint64_t>(result.samples);
  result.counters.require_allowed(kNonFiniteSampleEvent, trials);
  return result;
}

}  // namespace phos::inline reference
