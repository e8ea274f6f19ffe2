#include "direct/image_sampler.h"

#include <algorithm>
#include <array>

#include "core/sampling.h"
#include "scene/mirror/images.h"

namespace phos::inline direct {
namespace {

// No image is less likely than this part of an equal share: by power the lamp beside the mirror would starve.
constexpr double kMinimumShare = 0.1;
/// sample_all() takes every image that promises at least this part of the light that all images promise
/// together.
constexpr double kGoodPart = 0.02;

template <class Choices>
void normalise(Choices& choices) {
  double below = 0;
  for (auto& c : choices) {
    c.below = below;
    below = c.up_to = below + c.up_to;
  }
  for (auto& c : choices) c.below /= below, c.up_to /= below;
}

}  // namespace

ImageSampler::ImageSampler(const RayScene& rays, const Luminaires& lights) : rays_(rays), lights_(lights) {
  const std::vector<MirrorPlanes::Chain>& chains = lights.mirrors().chains();
  if (chains.empty() || lights.size() == 0) return;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    // A chain comes after the one that it makes longer.
    const auto before = chains[i].before;
    const std::int64_t so_far =
        before == MirrorPlanes::kNone ? 0 : chain_[static_cast<std::size_t>(before)].reflections;
    chain_.push_back({i, 0, static_cast<double>(chains[i].reflectance), so_far + 1});
  }
  for (std::size_t i = 0; i < chains.size(); ++i) {
    auto side = std::find_if(side_.begin(), side_.end(), [&](const Side& s) {
      return s.plane == chains[i].plane && s.front == chains[i].front;
    });
    if (side == side_.end()) side = side_.insert(side, {chains[i].plane, chains[i].front, {}});
    side->chain.push_back(i);
  }
  const std::vector<double> share = lights.power_shares(kMinimumShare);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (has_images(rays.scene(), lights[i])) lamp_.push_back({i, 0, share[i], 0});
  normalise(chain_), normalise(lamp_);
}

const ImageSampler::Choice& ImageSampler::choose(const std::vector<Choice>& among, double u) {
  const auto above = std::upper_bound(among.begin(), among.end() - 1, u,
                                      [](double x, const Choice& c) { return x < c.up_to; });
  return *above;
}

template <class F>
void ImageSampler::each_image(const SurfacePoint& point, F&& f) const {
  for (const Side& side : side_) {
    const std::optional<ImageBounds::Sight> mirror =
        ImageBounds::sight(lights_.mirrors().plane(side.plane), side.front, point);
    if (!mirror) continue;
    for (const std::size_t chain : side.chain)
      for (const Choice& lamp : lamp_) {
        const auto promise = static_cast<double>(lights_.image_promise_lx(chain, lamp.index, *mirror, point));
        if (promise > 0) f(Image{chain, lamp.index, 1, chain_[chain].reflections}, promise);
      }
  }
}

std::optional<ImageSampler::Image> ImageSampler::choose(const SurfacePoint& point, double u) const {
  if (!compares()) {
    const Choice& chain = choose(chain_, u);
    const Choice& lamp = choose(lamp_, (u - chain.below) / (chain.up_to - chain.below));
    return Image{chain.index, lamp.index, (chain.up_to - chain.below) * (lamp.up_to - lamp.below),
                 chain.reflections};
  }
  struct Promise {
    std::uint32_t chain, light;
    double up_to;  // sum of this one's and those before it, lx
  };
  std::array<Promise, kMostCompared> promises;
  std::size_t n = 0;
  double sum = 0;
  each_image(point, [&](const Image& image, double promise) {
    sum += promise;
    promises[n++] = {static_cast<std::uint32_t>(image.chain), static_cast<std::uint32_t>(image.light), sum};
  });
  if (n == 0) return {};
  const auto last = promises.begin() + static_cast<std::ptrdiff_t>(n) - 1;
  const auto chosen = std::upper_bound(promises.begin(), last, u * sum,
                                       [](double x, const Promise& p) { return x < p.up_to; });
  const double below = chosen == promises.begin() ? 0 : std::prev(chosen)->up_to;
  return Image{chosen->chain, chosen->light, (chosen->up_to - below) / sum,
               chain_[chosen->chain].reflections};
}

ImageSampler::Sample ImageSampler::sample_of(const Image& image, const SurfacePoint& point, float u_triangle,
                                             const Vec2& u) const {
  Sample sample;
  Illumination light;
  if (!illuminate_by_mirrors(rays_, lights_, image.chain, image.light, point, std::min(u_triangle, kBelowOne),
                             u, light))
    return sample;
  const float cosine = glm::dot(point.normal, light.direction);
  if (!(cosine > 0) || !(glm::dot(point.geometric_normal, light.direction) > 0)) return sample;
  sample.extended = lights_[image.light].extended();
  sample.direction = light.direction;
  sample.lux =
      light.value * static_cast<float>(static_cast<double>(cosine) / image.probability /
                                       (light.density > 0 ? static_cast<double>(light.density) : 1.0));
  return sample;
}

ImageSampler::Sample ImageSampler::sample(const SurfacePoint& point, std::int64_t most_reflections,
                                          RandomStream& random) const {
  const std::optional<Image> image = choose(point, random.uniform_double());
  if (!image || (most_reflections >= 0 && image->reflections > most_reflections)) return {};
  const float u_triangle = random.uniform();
  return sample_of(*image, point, u_triangle, random.uniform2());
}

void ImageSampler::sample_all(const SurfacePoint& point, int k, int total, RandomStream& sequence,
                              std::vector<Sample>& out) const {
  out.clear();
  const auto spread = [&](float u) { return (static_cast<float>(k) + u) / static_cast<float>(total); };
  const float u_step = spread(sequence.uniform()), u_triangle = spread(sequence.uniform());
  const std::uint32_t shift[2] = {sequence.bits(), sequence.bits()};
  const Vec2 u = sobol_point(k, shift[0], shift[1]);
  const auto take = [&](const Image& image) {
    const Sample sample = sample_of(image, point, u_triangle, u);
    if (max_component(sample.lux) > 0) out.push_back(sample);
  };
  double all = 0;
  each_image(point, [&](const Image&, double promise) { all += promise; });
  // Systematic sampling: of those that promise less than a step, one a step of the sum of their promises.
  const double step = kGoodPart * all;
  double sum = 0, next = step * static_cast<double>(u_step);
  each_image(point, [&](Image image, double promise) {
    if (!(promise < step)) return take(image);
    sum += promise;
    if (!(sum > next)) return;
    next += step;
    image.probability = promise / step;
    take(image);
  });
}

}  // namespace phos::inline direct
