#include "reference/passes.h"

#include <cmath>
#include <numbers>

namespace phos::inline reference {

double shrunk_area(std::uint64_t pass) {
  // The product of (k + 2/3) / (k + 1), k = 1 .. pass, in closed form.
  const auto i = static_cast<double>(pass);
  return std::exp(std::lgamma(i + 5.0 / 3) - std::lgamma(5.0 / 3) - std::lgamma(i + 2));
}

float first_merge_radius_m(const Scene& scene) {
  constexpr float kPart = 0.01f;
  return kPart * bounding_radius_m(scene);
}

LightPass make_pass(const LightTracer& tracer, std::uint64_t seed, std::uint64_t pass, std::size_t paths,
                    float radius_m) {
  LightPass made;
  const double area = std::numbers::pi * static_cast<double>(radius_m) * static_cast<double>(radius_m);
  made.merge_eta = 0.5 * area * static_cast<double>(paths);
  made.paths = trace_light(tracer, seed, kLightItem | pass << 24, paths, made.merge_eta);
  if (radius_m > 0) made.grid = VertexGrid(made.paths.vertex, radius_m);
  return made;
}

}  // namespace phos::inline reference
