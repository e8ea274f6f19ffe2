// Directions towards an environment follow its luminance.
#include <gtest/gtest.h>

#include "support/chi2.h"
#include "support/environment.h"

using namespace phos;
using namespace phos::test;

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
        SphereGrid{24, 48, 40}, 7, 200000,
        [&](RandomStream& random, Vec3& d) {
          const Environment::Sample s = maps[i].sample(random.uniform2());
          d = s.direction;
          return s.density > 0;
        },
        [&](const Vec3& d) { return double(maps[i].density(d)); });
    EXPECT_GT(result.p, least_p(0.01, static_cast<int>(maps.size())))
        << "map " << i << ": " << result.statistic << " for " << result.degrees << " degrees of freedom";
  }
}
