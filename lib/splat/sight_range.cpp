#include "splat/sight_range.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace phos::inline splat {
namespace {

constexpr double kLeastNear = 1e-6;  // of the farthest distance

/// Squared distance from the origin to a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double square_distance(const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 ab = b - a, ac = c - a;
  const auto square = [](const DVec3& v) { return glm::dot(v, v); };
  const double d1 = glm::dot(ab, -a), d2 = glm::dot(ac, -a);
  if (d1 <= 0 && d2 <= 0) return square(a);
  const double d3 = glm::dot(ab, -b), d4 = glm::dot(ac, -b);
  if (d3 >= 0 && d4 <= d3) return square(b);
  const double d5 = glm::dot(ab, -c), d6 = glm::dot(ac, -c);
  if (d6 >= 0 && d5 <= d6) return square(c);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return square(a + ab * (d1 > d3 ? d1 / (d1 - d3) : 0.0));
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return square(a + ac * (d2 > d6 ? d2 / (d2 - d6) : 0.0));
  const double va = d3 * d6 - d5 * d4, along = d4 - d3, across = d5 - d6;
  if (va <= 0 && along >= 0 && across >= 0) {
    return square(b + (c - b) * (along + across > 0 ? along / (along + across) : 0.0));
  }
  const double sum = va + vb + vc;
  return sum > 0 ? square(a + ab * (vb / sum) + ac * (vc / sum)) : square(a);
}

}  // namespace

double farthest_m(const Scene& scene, const Vec3& eye) {
  const Vec3 reach = glm::max(glm::abs(scene.bounds.lo - eye), glm::abs(scene.bounds.hi - eye));
  const double distance = glm::length(DVec3(reach));
  return std::isfinite(distance) && distance > 0 ? distance : 1;
}

double nearest_m(const Scene& scene, const Vec3& eye, std::int64_t but_instance) {
  const double far = farthest_m(scene, eye);
  const double square = parallel_reduce(
      scene.triangle.size(), 4096, far * far,
      [&](std::size_t begin, std::size_t end) {
        double least = far * far;
        for (std::size_t i = begin; i < end; ++i) {
          if (static_cast<std::int64_t>(scene.triangle_instance[i]) == but_instance) continue;
          const auto& v = scene.triangle[i].v;
          least = std::min(least, square_distance(DVec3(scene.position[v[0]]) - DVec3(eye),
                                                  DVec3(scene.position[v[1]]) - DVec3(eye),
                                                  DVec3(scene.position[v[2]]) - DVec3(eye)));
        }
        return least;
      },
      [](double& total, double part) { total = std::min(total, part); });
  return std::clamp(std::sqrt(square), kLeastNear * far, far);
}

}  // namespace phos::inline splat
