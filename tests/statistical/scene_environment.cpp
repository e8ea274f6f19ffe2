// Directions towards an environment follow its luminance.
#include <gtest/gtest.h>

#include "support/chi2.h"
#include "support/environment.h"

using namespace phos;
using namespace phos::test;

namespace {

const SphereGrid kGrid{24, 48, 20};
constexpr int kCount = 100000;
const double kLeastP = least_p(0.01, 8);

}  // namespace

TEST(EnvironmentSamples, FollowTheirDensity) {
  const std::vector<Environment> maps = {
      constant_map(12, Rgb(1)), gradient_map(24, 0.7), gradient_map(5),
      // A sun, and black parts.
      map_of(
          16, [](int x, int y) { return x == 9 && y == 4 ? Rgb(300)
                                        : x % 5 == 0     ? Rgb(0)
                                                         : Rgb(1); }, -2)};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Chi2 result = chi2_directions(
        kGrid, 7, kCount,
        [&](RandomStream& random, Vec3& d) {
          const Environment::Sample s = maps[i].sample(random.uniform2());
          d = s.direction;
          return s.density > 0;
        },
        [&](const Vec3& d) { return double(maps[i].density(d)); });
    EXPECT_GT(result.p, kLeastP) << "map " << i << ": " << result.statistic << " for " << result.degrees
                                 << " degrees of freedom";
    const double total = 0.2126 * maps[i].integral_lx().x + 0.7152 * maps[i].integral_lx().y +
                         0.0722 * maps[i].integral_lx().z;
    const Chi2 flux = chi2_directions(
        kGrid, 8, kCount,
        [&](RandomStream& random, Vec3& d) {
          const Environment::Sample s = maps[i].sample_flux(random.uniform2());
          d = s.direction;
          return s.density > 0;
        },
        [&](const Vec3& d) { return double(luminance(maps[i].luminance(d))) / total; });
    EXPECT_GT(flux.p, kLeastP) << "flux of map " << i << ": " << flux.statistic << " for " << flux.degrees
                               << " degrees of freedom";
  }
}
