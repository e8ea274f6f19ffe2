#include "splat/interleaved.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace phos {
namespace {

constexpr int kBlock = 4;  // pixels each way
// Of the row or column at this distance: the outer two together count like one, so that the mean about a
// pixel holds each part of the set once.
constexpr float kShare[kBlock / 2 + 1] = {1, 1, 0.5f};
constexpr float kSameDirection = 0.9945f;  // cos 6 degrees
constexpr float kSamePlane = 0.1f;         // sine of the slope at which a neighbour leaves the tangent plane

bool one_surface(const GBuffer& g, std::size_t i, std::size_t j) {
  if (!g.covered(j) || g.albedo[i].w != g.albedo[j].w) return false;
  const Vec3 a(g.normal[i]), b(g.normal[j]);
  if (glm::dot(a, b) < kSameDirection) return false;
  const Vec3 way = Vec3(g.position[j]) - Vec3(g.position[i]);
  return std::fabs(glm::dot(a, way)) <= kSamePlane * glm::length(way);
}

SharedLight mean_about(const GBuffer& g, const std::vector<Rgb>& own, int x, int y) {
  const auto width = static_cast<std::size_t>(g.width);
  const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
  Rgb sum(0), squares(0);
  float weight = 0, weight2 = 0;
  for (int v = std::max(0, y - kBlock / 2); v <= std::min(g.height - 1, y + kBlock / 2); ++v) {
    for (int u = std::max(0, x - kBlock / 2); u <= std::min(g.width - 1, x + kBlock / 2); ++u) {
      const std::size_t j = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      if (j != i && !one_surface(g, i, j)) continue;
      const float w = kShare[std::abs(u - x)] * kShare[std::abs(v - y)];
      sum += w * own[j], squares += w * own[j] * own[j], weight += w, weight2 += w * w;
    }
  }
  SharedLight light{sum / weight, Rgb(0)};
  const float independent = weight * weight / weight2;
  if (independent > 1)
    light.variance =
        glm::max(squares / weight - light.illuminance * light.illuminance, Rgb(0)) / (independent - 1);
  return light;
}

}  // namespace

std::vector<SharedLight> interleaved_light(const RayScene& rays, const Shading& shading, const GBuffer& g,
                                           const PixelRays& pixel_rays, const Vec2& subpixel, int lamp_rays,
                                           int pass, int passes, std::uint64_t seed) {
  const std::size_t n = g.hit.size(), width = static_cast<std::size_t>(g.width);
  std::vector<Rgb> own(n, Rgb(0));
  parallel_for(n, 1024, [&](std::size_t i) {
    if (!g.covered(i)) return;
    const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
    const Ray ray = pixel_rays(x, y, subpixel);
    const SurfacePoint point = rays.surface(ray, g.hit[i]);
    const int part = (y % kBlock) * kBlock + x % kBlock + pass * kBlock * kBlock;
    // Each block has its own set, so that a set's error does not show everywhere alike.
    const std::size_t block = i / width / kBlock * width + i % width / kBlock;
    RandomStream sequence(seed, Stage::direct_light, block);
    own[i] = shading
                 .direct(point, Bsdf(rays.scene(), point), -ray.direction,
                         {part * lamp_rays, lamp_rays, passes * kBlock * kBlock * lamp_rays}, 0, sequence)
                 .illuminance;
  });
  std::vector<SharedLight> shared(n);
  parallel_for(n, 1024, [&](std::size_t i) {
    if (g.covered(i))
      shared[i] = mean_about(g, own, static_cast<int>(i % width), static_cast<int>(i / width));
  });
  return shared;
}

}  // namespace phos
