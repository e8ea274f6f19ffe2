#include "scene/opening/lookers.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "scene/offset.h"
#include "scene/sky/access.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kPlaces = 8192;  // all over the scene
constexpr std::size_t kEnough = 4096;  // within: no more are looked for
constexpr std::uint32_t kRays = 64;    // of each place
constexpr double kWithin = 0.25;       // of them that see the sky, beyond which a place is out of doors
constexpr std::size_t kLeastSteps = 1, kMostSteps = 8;
constexpr std::size_t kStepsOfEach = 8;  // at most, from one place in one round

/// What a place sees; no normal where it is out of doors.
Looker look_from(const RayScene& rays, const Vec3& position, const Vec3& normal, RandomStream& random) {
  Looker looker{position, normal, {}};
  const Frame frame = make_frame(normal);
  for (std::uint32_t k = 0; k < kRays; ++k) {
    const Vec3 direction = frame.to_world(sample_uniform_cone(random.uniform2(), 0));
    if (sees_sky(rays, {position, direction})) looker.sky.push_back(direction);
  }
  if (static_cast<double>(looker.sky.size()) >= kWithin * kRays) looker.normal = Vec3(0);
  return looker;
}

void leave(std::vector<Looker>& lookers, bool seeing) {
  std::erase_if(lookers, [&](const Looker& looker) {
    return looker.normal == Vec3(0) || (seeing && looker.sky.empty());
  });
}

/// A place on a triangle, on the front or the back.
Looker look_from_triangle(const RayScene& rays, std::uint32_t t, bool front, RandomStream& random) {
  const Scene& scene = rays.scene();
  const Vec2 weight = sample_triangle(random.uniform2());
  const auto& v = scene.triangle[t].v;
  const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
  const Vec3 normal = (front ? 1.f : -1.f) * geometric_normal(scene, t);
  if (normal == Vec3(0)) return {};
  const Vec3 place = a + weight.x * (b - a) + weight.y * (c - a);
  return look_from(rays, place + offset_m(a, b, c) * normal, normal, random);
}

/// Those of places all over the scene that are within and see the sky.
std::vector<Looker> look_everywhere(const RayScene& rays) {
  const Scene& scene = rays.scene();
  std::vector<double> below;
  double sum = 0;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t)
    below.push_back(sum += static_cast<double>(area_m2(scene, t)));
  std::vector<Looker> lookers(sum > 0 ? kPlaces : 0);
  parallel_for(lookers.size(), 64, [&](std::size_t i) {
    RandomStream random(0, Stage::pilot, i);
    random.start_bounce(0);
    const std::size_t half = kPlaces / 2;
    const double x = (static_cast<double>(i % half) + random.uniform_double()) / static_cast<double>(half);
    const auto by_area =
        static_cast<std::size_t>(std::upper_bound(below.begin(), below.end() - 1, x * sum) - below.begin());
    const auto by_number = static_cast<std::size_t>(x * static_cast<double>(below.size()));
    const std::size_t t = i < half ? by_area : std::min(by_number, below.size() - 1);
    lookers[i] = look_from_triangle(rays, static_cast<std::uint32_t>(t), random.uniform() < 0.5f, random);
  });
  leave(lookers, true);
  return lookers;
}

/// What a looker sees in one direction.
Looker step_from(const RayScene& rays, const Looker& from, RandomStream& random) {
  const Vec3 direction = make_frame(from.normal).to_world(sample_cosine_hemisphere(random.uniform2()));
  SurfacePoint seen;
  if (!trace(rays, {from.position, direction}, seen)) return {};
  return look_from(rays, seen.position + seen.error_m * seen.geometric_normal, seen.geometric_normal, random);
}

}  // namespace

std::vector<Looker> look_about(const RayScene& rays) {
  std::vector<Looker> all = look_everywhere(rays);
  std::size_t begin = 0, item = kPlaces;
  for (std::size_t round = 0; round < kMostSteps; ++round) {
    std::vector<std::size_t> from;
    for (std::size_t i = begin; i < all.size(); ++i)
      if (!all[i].sky.empty()) from.push_back(i);
    if (from.empty() || (round >= kLeastSteps && all.size() >= kEnough)) break;
    const std::size_t missing = all.size() < kEnough ? kEnough - all.size() : 0;
    const std::size_t steps = std::clamp(missing / from.size(), std::size_t{1}, kStepsOfEach);
    std::vector<Looker> next(from.size() * steps);
    parallel_for(next.size(), 64, [&](std::size_t i) {
      RandomStream random(0, Stage::pilot, item + i);
      random.start_bounce(0);
      next[i] = step_from(rays, all[from[i / steps]], random);
    });
    item += next.size();
    leave(next, false);
    begin = all.size();
    all.insert(all.end(), next.begin(), next.end());
  }
  return all;
}

}  // namespace phos::inline scene
