// A room whose walls are cut into a million triangles (PHOS_LARGE_TRIANGLES: into as many as that says), with
// the time and memory that each step takes.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <chrono>
#include <cstdlib>

#include "photon/events.h"
#include "photon/trace.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

/// A wall of n x n cells in place of one.
void add_cells(Scene& s, const Vec3& corner, const Vec3& u, const Vec3& v, std::uint32_t n) {
  const auto first = static_cast<std::uint32_t>(s.position.size());
  const auto own = static_cast<std::uint32_t>(s.instance.size() - 1);
  const Vec3 normal = normalized_or_zero(glm::cross(u, v));
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float a = static_cast<float>(i) / static_cast<float>(n),
                  b = static_cast<float>(j) / static_cast<float>(n);
      s.position.push_back(corner + a * u + b * v), s.normal.push_back(normal);
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = first + j * (n + 1) + i;
      s.triangle.push_back({{p, p + 1, p + n + 2}}), s.triangle.push_back({{p, p + n + 2, p + n + 1}});
      s.triangle_instance.insert(s.triangle_instance.end(), 2, own);
    }
  s.instance.back().triangle_count += 2 * n * n;
}

class Steps {
 public:
  void tell(const char* step) {
    const auto now = std::chrono::steady_clock::now();
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::printf("%s: %.2f s, %.0f MiB at most so far\n", step,
                std::chrono::duration<double>(now - last_).count(),
                static_cast<double>(used.ru_maxrss) / 1024);
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

TEST(LargeMesh, WatertightAndRight) {
  const char* asked = std::getenv("PHOS_LARGE_TRIANGLES");
  const double triangles = asked ? std::atof(asked) : 1e6;
  const auto n = static_cast<std::uint32_t>(std::ceil(std::sqrt(triangles / 12)));
  Steps steps;
  Scene s;
  begin_instance(s, "walls", add_lambert(s, "grey", 0.5f));
  const Vec3 lo(0), d(2, 1, 1.5f), x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  add_cells(s, lo, z, x, n), add_cells(s, lo + y, x, z, n), add_cells(s, lo, y, z, n);
  add_cells(s, lo + x, z, y, n), add_cells(s, lo, x, y, n), add_cells(s, lo + z, y, x, n);
  add_point_light(s, {0.7f, 0.6f, 0.5f}, 100 / (4 * kPi));
  std::printf("%zu triangles\n", s.triangle.size());
  steps.tell("made");
  finalize(s);
  steps.tell("finalized");
  const RayScene rays(s);
  steps.tell("ray tracing structure");
  PhotonTotals totals;
  Counters counters;
  PhotonOptions options;
  options.paths = 200000;
  Photons photons = trace_photons(rays, options, 1, totals, counters);
  steps.tell("200000 photon paths");
  EXPECT_EQ(counters[kEscapedEvent], 0u) << "through an edge or a vertex";
  const double law = 100 / (1 - 0.5);
  // Each path stores 1 + Geometric: variance of the stored flux as in analytic/photon_density.
  EXPECT_NEAR(static_cast<double>(totals.stored_flux_lm.y), law, 4.8 * 100 * std::sqrt(2.0 / 200000));
  const PhotonMap map = PhotonMap::build(std::move(photons), totals);
  steps.tell("photon map");
  EXPECT_EQ(map.size(), totals.stored);
}

}  // namespace
}  // namespace phos::test
