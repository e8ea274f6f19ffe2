#include "cache/image_sampler.h"

#include <algorithm>

#include "core/sampling.h"
#include "scene/mirror_images.h"

namespace phos {
namespace {

// No image is less likely than this part of an equal share: by power the lamp beside the mirror would starve.
constexpr double kMinimumShare = 0.1;

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

ImageSampler::Sample ImageSampler::sample(const SurfacePoint& point, std::int64_t most_reflections,
                                          RandomStream& random) const {
  const Choice& chain = choose(chain_, random.uniform_double());
  const Choice& lamp = choose(lamp_, random.uniform_double());
  const float u_triangle = random.uniform();
  const Vec2 u = random.uniform2();
  Sample sample;
  if (most_reflections >= 0 && chain.reflections > most_reflections) return sample;
  Illumination light;
  if (!illuminate_by_mirrors(rays_, lights_, lights_.mirrors(), chain.index, lamp.index, point,
                             std::min(u_triangle, kBelowOne), u, light))
    return sample;
  const float cosine = glm::dot(point.normal, light.direction);
  if (!(cosine > 0) || !(glm::dot(point.geometric_normal, light.direction) > 0)) return sample;
  const double chosen = (chain.up_to - chain.below) * (lamp.up_to - lamp.below);
  sample.extended = lights_[lamp.index].extended();
  sample.direction = light.direction;
  sample.lux =
      light.value * static_cast<float>(static_cast<double>(cosine) / chosen /
                                       (light.density > 0 ? static_cast<double>(light.density) : 1.0));
  return sample;
}

}  // namespace phos
