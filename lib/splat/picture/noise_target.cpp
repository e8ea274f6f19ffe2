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
constexpr int kAbout = 2;  // pixels of the pilot each way that tell the noise of a place
/// Light of a pixel, of the mean, below which noise shows no more.
constexpr double kLeastLight = 0.1;
/// Share of the pixels that may need more rays than are ever sent, before that is told.
constexpr double kFew = 0.02;
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

/// Of a layer, per pixel, the square of the noise over the light; below 0 where nothing sends light.
std::vector<double> noise_of(const Image (&image)[2], const std::string& layer,
                             const std::vector<double>& light, double least) {
  std::vector<double> squares(light.size(), 0);
  const bool there = image[0].has_layer(layer) && image[1].has_layer(layer);
  const std::vector<Rgb> one = there ? image[0].rgb(layer) : std::vector<Rgb>(),
                         other = there ? image[1].rgb(layer) : std::vector<Rgb>();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double change =
        there ? static_cast<double>(luminance(one[i] - other[i])) / std::max(light[i], least) : 0;
    squares[i] = light[i] > 0 ? change * change / 2 : -1;
  }
  return squares;
}

double root_mean(const std::vector<double>& squares) {
  double sum = 0, n = 0;
  for (const double s : squares)
    if (s >= 0) sum += s, n += 1;
  return n > 0 ? std::sqrt(sum / n) : 0;
}

/// Of what lies about each pixel, where that sends light.
std::vector<double> mean_about(const std::vector<double>& squares, int width, int height) {
  std::vector<double> mean(squares.size(), 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0, n = 0;
      for (int v = std::max(0, y - kAbout); v <= std::min(height - 1, y + kAbout); ++v) {
        for (int u = std::max(0, x - kAbout); u <= std::min(width - 1, x + kAbout); ++u) {
          const double s = squares[static_cast<std::size_t>(v * width + u)];
          if (s >= 0) sum += s, n += 1;
        }
      }
      mean[static_cast<std::size_t>(y * width + x)] = n > 0 ? sum / n : 0;
    }
  }
  return mean;
}

/// Chooses the doublings of one kind of rays.
class Chosen {
 public:
  /// `square`: of the noise that is asked for; `sent`: rays of the pilot.
  Chosen(const std::vector<double>& squares, const RenderOptions& pilot, double square, std::int64_t sent)
      : width_(static_cast<int>(pilot.width)), height_(static_cast<int>(pilot.height)) {
    const int most = std::max(0, static_cast<int>(std::floor(std::log2(static_cast<double>(kMost / sent)))));
    std::size_t beyond = 0;
    for (const double s : mean_about(squares, width_, height_)) {
      const double wanted = s > square ? std::round(std::log2(s / square)) : 0;
      beyond += wanted > most;
      doublings_.push_back(static_cast<std::uint8_t>(std::min<double>(wanted, most)));
    }
    enough_ = static_cast<double>(beyond) <= kFew * static_cast<double>(doublings_.size());
  }
  bool enough() const { return enough_; }
  /// For the pixels of a picture of another size; empty if all are 0.
  std::vector<std::uint8_t> of_picture(const RenderOptions& render) const {
    std::vector<std::uint8_t> all;
    if (std::all_of(doublings_.begin(), doublings_.end(), [](std::uint8_t d) { return d == 0; })) return all;
    all.reserve(static_cast<std::size_t>(render.width * render.height));
    for (std::int64_t y = 0; y < render.height; ++y) {
      for (std::int64_t x = 0; x < render.width; ++x)
        all.push_back(doublings_[static_cast<std::size_t>(y * height_ / render.height * width_ +
                                                          x * width_ / render.width)]);
    }
    return all;
  }

 private:
  int width_, height_;
  std::vector<std::uint8_t> doublings_;
  bool enough_ = true;
};

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
  render.light_samples = pilot.light_samples, render.gloss_samples = pilot.gloss_samples;
  const double square = *render.noise * *render.noise / 2;
  const auto choose = [&](const char* layer, std::int64_t sent, double& noise,
                          std::vector<std::uint8_t>& doublings) {
    const std::vector<double> squares = noise_of(image, layer, light, kLeastLight * mean);
    noise = root_mean(squares);
    const Chosen chosen(squares, pilot, square, sent);
    found.enough = found.enough && chosen.enough();
    doublings = chosen.of_picture(render);
  };
  choose("direct", pilot.light_samples, found.direct, found.doublings.direct);
  choose("glossy", pilot.gloss_samples, found.gloss, found.doublings.gloss);
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
