#include "scene/sky/access.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "scene/lamp/luminaires.h"
#include "scene/material/bsdf.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kPaths = 4096;
constexpr std::uint32_t kBounces = 8;

/// A path through the materials, with no care for how much they reflect.
bool reaches_sky(const RayScene& rays, const Vec3& from, std::uint64_t path) {
  RandomStream random(0, Stage::pilot, path);
  random.start_bounce(0);
  Ray ray{from, sample_uniform_sphere(random.uniform2())};
  for (std::uint32_t bounce = 1; bounce <= kBounces; ++bounce) {
    SurfacePoint point;
    if (sees_sky(rays, ray)) return true;
    if (!trace(rays, ray, point)) return false;
    random.start_bounce(bounce);
    BsdfSample next;
    const float u_lobe = random.uniform();
    if (!Bsdf(rays.scene(), point).sample(-ray.direction, u_lobe, random.uniform2(), next)) return false;
    ray = {point.leave(next.direction), next.direction};
  }
  return false;
}

}  // namespace

bool sees_sky(const RayScene& rays, const Ray& ray) {
  return max_component(background_luminance(rays.scene(), ray.direction)) > 0 &&
         max_component(rays.transmittance(ray)) > 0;
}

std::optional<std::string> closed_to_the_sky(const RayScene& rays) {
  const Scene& scene = rays.scene();
  if (!scene.environment || scene.camera.empty()) return std::nullopt;
  for (const Camera& camera : scene.camera) {
    const Vec3 from(camera.to_world[3]);
    const auto any = parallel_reduce<int>(
        kPaths, 64, 0,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            if (reaches_sky(rays, from, i)) return 1;
          return 0;
        },
        [](int& sum, const int& part) { sum |= part; });
    if (any) return std::nullopt;
  }
  return text("no light of the sky reaches the view: of ", kPaths,
              " paths from each camera none finds the sky");
}

}  // namespace phos::inline scene
