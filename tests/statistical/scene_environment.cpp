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
    const Environment& map = maps[i];
    const auto expect_fits = [&](std::uint64_t seed, const char* what, const auto& draw,
                                 const auto& density) {
      const Chi2 result = chi2_directions(
          kGrid, seed, kCount,
          [&](RandomStream& random, Vec3& d) {
            const Environment::Sample s = draw(random.uniform2());
            d = s.direction;
            return s.density > 0;
          },
          density);
      EXPECT_GT(result.p, kLeastP) << what << " of map " << i << ": " << result.statistic << " for "
                                   << result.degrees << " degrees of freedom";
    };
    expect_fits(
        7, "samples", [&](const Vec2& u) { return map.sample(u); },
        [&](const Vec3& d) { return double(map.density(d)); });
    const double total =
        0.2126 * map.integral_lx().x + 0.7152 * map.integral_lx().y + 0.0722 * map.integral_lx().z;
    expect_fits(
        8, "flux samples", [&](const Vec2& u) { return map.sample_flux(u); },
        [&](const Vec3& d) { return double(luminance(map.luminance(d))) / total; });
  }
}
