#include "splat/picture/edge_shader.h"

#include <algorithm>
#include <cmath>

#include "scene/picture.h"

namespace phos::inline splat {
namespace {

bool same_all_over(const Scene& scene, const Material& material) {
  const auto uses = material.texture_uses();
  return scene.colour.empty() &&
         std::none_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->used(); });
}

}  // namespace

EdgeShader::EdgeShader(const RayScene& rays, const Luminaires& lights, const PixelRays& pixel_rays,
                       const PixelShader& shader, const RenderOptions& options, const Doublings& doublings,
                       bool cached_direct, const SeenPicture& picture)
    : rays_(rays),
      pixel_rays_(pixel_rays),
      shader_(shader),
      options_(options),
      doublings_(doublings),
      picture_(picture),
      cached_direct_(cached_direct),
      edge_light_(rays, lights, shader.lamp_rays_of_each(true), options.seed) {
  for (const Material& m : rays.scene().material) {
    diffuse_.push_back(m.diffuse_alone());
    even_.push_back(m.diffuse_alone() && same_all_over(rays.scene(), m));
  }
}

EdgeShader::Samples EdgeShader::trace(std::size_t pixel) const {
  const auto width = static_cast<std::size_t>(picture_.gbuffer.width);
  const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
  const auto before = static_cast<int>(options_.pixel_samples),
             more = static_cast<int>(options_.edge_samples);
  Samples samples{pixel, {}, std::vector<Hit>(static_cast<std::size_t>(options_.edge_samples))};
  for (int s = 0; s < more; ++s) samples.ray.push_back(pixel_rays_(x, y, further_offset(s, more, before)));
  rays_.intersect(samples.ray, samples.hit);
  return samples;
}

/// By triangle and by surface, in order of their first.
EdgeShader::Sorted EdgeShader::sort(const Samples& samples) const {
  Sorted sorted;
  for (std::uint32_t s = 0; s < samples.hit.size(); ++s) {
    if (!samples.seen(s)) continue;
    const Hit& hit = samples.hit[s];
    auto face = std::find_if(sorted.face.begin(), sorted.face.end(),
                             [&](const Face& f) { return f.triangle == hit.triangle; });
    if (face == sorted.face.end()) {
      const SeenSurface seen = SeenSurface::of(rays_.surface(samples.ray[s], hit));
      auto surface = std::find_if(sorted.surface.begin(), sorted.surface.end(),
                                  [&](const Surface& other) { return same_surface(other.seen, seen); });
      if (surface == sorted.surface.end())
        surface = sorted.surface.insert(surface, Surface{seen, {}, nullptr, {}, {}});
      const auto number = static_cast<std::uint32_t>(surface - sorted.surface.begin());
      face = sorted.face.insert(face, {hit.triangle, number, s, 0});
    }
    ++face->samples;
    sorted.surface[face->surface].sample.push_back(s);
  }
  return sorted;
}

SurfacePoint EdgeShader::middle_of(const Samples& samples, const Surface& surface) const {
  const auto place = [&](std::uint32_t s) {
    return samples.ray[s].origin + samples.hit[s].distance_m * samples.ray[s].direction;
  };
  Vec3 sum(0);
  for (const std::uint32_t s : surface.sample) sum += place(s);
  const Vec3 mean = sum / static_cast<float>(surface.sample.size());
  const std::uint32_t nearest =
      *std::min_element(surface.sample.begin(), surface.sample.end(), [&](std::uint32_t a, std::uint32_t b) {
        return glm::distance(place(a), mean) < glm::distance(place(b), mean);
      });
  SurfacePoint middle = rays_.surface(samples.ray[nearest], samples.hit[nearest]);
  middle.position = mean;
  return middle;
}

void EdgeShader::find_light(const Samples& samples, Sorted& sorted) const {
  EdgeLight::Scratch scratch;
  for (std::uint32_t k = 0; k < sorted.surface.size(); ++k) {
    Surface& surface = sorted.surface[k];
    const std::optional<std::size_t> about = nearest_alike(surface.seen, picture_.gbuffer, samples.pixel);
    surface.splat.found = shader_.from_records(middle_of(samples, surface));
    if (!diffuse_[static_cast<std::size_t>(surface.seen.material)]) continue;
    surface.direct = &surface.light;
    if (cached_direct_) continue;
    surface.light = edge_light_.light({samples.pixel, k, samples.ray, samples.hit, surface.sample,
                                       Doublings::of(doublings_.direct, samples.pixel)},
                                      about ? &picture_.shared[*about] : nullptr, scratch);
  }
}

PixelSample EdgeShader::sample(const Samples& samples, std::size_t s, const Surface* surface,
                               ShadingResult& result) const {
  const SurfacePoint point = rays_.surface(samples.ray[s], samples.hit[s]);
  return shader_.shade({samples.pixel, static_cast<int>(s), true}, samples.ray[s], point,
                       surface ? surface->splat : PixelShader::Splat(), surface ? surface->direct : nullptr,
                       result);
}

void EdgeShader::add(const Samples& samples, const Sorted& sorted, Layers& layers,
                     ShadingResult& result) const {
  const auto even = [&](const Surface& surface) {
    return even_[static_cast<std::size_t>(surface.seen.material)];
  };
  for (const Face& face : sorted.face) {
    const Surface& surface = sorted.surface[face.surface];
    if (even(surface)) layers.add(samples.pixel, sample(samples, face.first, &surface, result), face.samples);
  }
  for (const Surface& surface : sorted.surface) {
    if (even(surface)) continue;
    for (const std::uint32_t s : surface.sample)
      layers.add(samples.pixel, sample(samples, s, &surface, result));
  }
}

std::vector<SeenSample> EdgeShader::seen(std::size_t pixel) const {
  const Samples samples = trace(pixel);
  std::vector<SeenSample> all;
  for (std::size_t s = 0; s < samples.hit.size(); ++s) all.push_back({samples.ray[s], samples.hit[s]});
  return all;
}

void EdgeShader::shade_mapped(const Samples& samples, std::span<const LampsAt> lamps, Layers& layers,
                              ShadingResult& result) const {
  for (std::size_t s = 0; s < samples.hit.size(); ++s) {
    if (!samples.seen(s)) {
      layers.add(samples.pixel, shader_.background(samples.ray[s]));
      continue;
    }
    const SharedLight shared{lamps[s].lux, DVec3(0)};
    PixelShader::Splat splat;
    splat.lamps = &lamps[s];
    const SurfacePoint point = rays_.surface(samples.ray[s], samples.hit[s]);
    layers.add(samples.pixel, shader_.shade({samples.pixel, static_cast<int>(s), true}, samples.ray[s], point,
                                            splat, &shared, result));
  }
}

void EdgeShader::shade(std::size_t pixel, Layers& layers, ShadingResult& result,
                       std::span<const LampsAt> lamps) const {
  const Samples samples = trace(pixel);
  if (!lamps.empty()) return shade_mapped(samples, lamps, layers, result);
  const bool alone = picture_.shared.empty();
  if (!alone) {
    Sorted sorted = sort(samples);
    find_light(samples, sorted);
    add(samples, sorted, layers, result);
  }
  for (std::size_t s = 0; s < samples.hit.size(); ++s) {
    if (!samples.seen(s))
      layers.add(pixel, shader_.background(samples.ray[s]));
    else if (alone)
      layers.add(pixel, sample(samples, s, nullptr, result));
  }
}

}  // namespace phos::inline splat
