#include "splat/picture/noise_target.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "splat/limits.h"

namespace phos::inline splat {
namespace {

constexpr std::int64_t kPilotSide = 128;  // pixels, of the longer side
constexpr std::int64_t kPilotRays = 64;   // to one lamp; to each of many fewer
constexpr std::int64_t kMost = kMostNoiseRays.most;
constexpr double kKept = 0.98;  // of the differences, the smallest
/// Light of a pixel, of the mean, below which noise shows no more.
constexpr double kLeastLight = 0.1;
/// Random numbers of the two pilots, other than the picture's own.
constexpr std::uint64_t kSeeds[2] = {0x9e3779b97f4a7c15u, 0xbf58476d1ce4e5b9u};

/// Noise of many lamps averages out.
std::int64_t pilot_rays(const Scene& scene) {
  const auto lamps = std::count_if(scene.light.begin(), scene.light.end(),
                                   [](const Light& light) { return light.extended(); });
  const double each = static_cast<double>(kPilotRays) / std::sqrt(static_cast<double>(std::max(lamps, 1l)));
  return std::max<std::int64_t>(4, std::llround(each));
}

/// What surfaces send on in each pixel, cd/m2: the mean of both pictures.
std::vector<double> scattered(const Image (&image)[2]) {
  std::vector<double> light(image[0].pixels());
  for (const Image& one : image) {
    const std::vector<Rgb> beauty = one.rgb(""), emission = one.rgb("emission");
    for (std::size_t i = 0; i < light.size(); ++i)
      light[i] += static_cast<double>(luminance(beauty[i] - emission[i])) / 2;
  }
  return light;
}

/// Of a layer, root mean square of the noise over the light; but for the pixels where it is largest.
double noise_of(const Image (&image)[2], const std::string& layer, const std::vector<double>& light,
                double least) {
  if (!image[0].has_layer(layer) || !image[1].has_layer(layer)) return 0;
  const std::vector<Rgb> one = image[0].rgb(layer), other = image[1].rgb(layer);
  std::vector<double> squares;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double change = static_cast<double>(luminance(one[i] - other[i])) / std::max(light[i], least);
    if (light[i] > 0) squares.push_back(change * change / 2);
  }
  std::sort(squares.begin(), squares.end());
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(squares.size()));
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += squares[i];
  return kept > 0 ? std::sqrt(sum / static_cast<double>(kept)) : 0;
}

}  // namespace

NoiseTarget choose_rays(const RayScene& rays, const IrradianceCache& cache, RenderOptions& render,
                        std::span<const BrdfTable> brdfs, const GlossCache* gloss) {
  NoiseTarget found;
  if (!render.noise) return found;
  RenderOptions pilot = render;
  const double scale = std::min(
      1., static_cast<double>(kPilotSide) / static_cast<double>(std::max(render.width, render.height)));
  for (std::int64_t* side : {&pilot.width, &pilot.height})
    *side = std::max<std::int64_t>(1, std::llround(scale * static_cast<double>(*side)));
  pilot.pixel_samples = 1, pilot.edge_samples = 0, pilot.gloss_samples = kPilotRays;
  pilot.light_samples = pilot_rays(rays.scene());
  pilot.layers = {"beauty", "emission", "direct", "glossy"}, pilot.overlay = Overlay::none,
  pilot.max_misses = 0;
  Image image[2];
  for (int i = 0; i < 2; ++i) {
    pilot.seed = render.seed ^ kSeeds[i];
    image[i] = render_scene(rays, cache, pilot, brdfs, gloss).image;
  }
  const std::vector<double> light = scattered(image);
  double mean = 0;
  for (const double l : light) mean += std::max(l, 0.) / static_cast<double>(light.size());
  if (!(mean > 0)) return found;
  found.direct = noise_of(image, "direct", light, kLeastLight * mean);
  found.gloss = noise_of(image, "glossy", light, kLeastLight * mean);
  const double share = *render.noise / std::sqrt(2.);
  const auto rays_for = [&](double noise, std::int64_t sent) {
    const double wanted = std::ceil(static_cast<double>(sent) * (noise / share) * (noise / share));
    found.enough = found.enough && wanted <= static_cast<double>(kMost);
    return static_cast<std::int64_t>(
        std::clamp(wanted, static_cast<double>(sent), static_cast<double>(kMost)));
  };
  render.light_samples = rays_for(found.direct, pilot.light_samples);
  render.gloss_samples = rays_for(found.gloss, pilot.gloss_samples);
  return found;
}

void require_one_choice(const Options& given, const RenderOptions& render) {
  if (!render.noise) return;
  for (const char* name : {"light-samples", "gloss-samples"})
    if (given.given(name))
      throw Error(ExitCode::usage, "--noise", text("chooses the number of rays; leave out --", name));
  if (render.direct == DirectBy::shadow_map)
    throw Error(ExitCode::usage, "--noise", "needs shadow rays; give --direct traced or interleaved");
}

}  // namespace phos::inline splat
