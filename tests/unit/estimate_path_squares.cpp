// The variance of sums over photons of which several are of one path.
#include <gtest/gtest.h>

#include "estimate/zone/path_squares.h"

namespace phos {
namespace {

TEST(PathSquares, AreOfWhatEachPathAdds) {
  ZonePaths paths;
  const std::uint32_t family[] = {7, 4000000000u, 7, 0, 4000000000u, 7};
  paths.set(family);
  EXPECT_TRUE(paths.known());
  EXPECT_EQ(paths.paths, 3u);
  PathSquares squares(paths);
  for (std::size_t i = 0; i < 6; ++i) squares.add(i, DVec3(1, 2, -1));
  // Paths of 3, 2 and 1 photons: 9 + 4 + 1.
  EXPECT_EQ(squares.squares(), DVec3(14, 56, 14));
  EXPECT_NEAR(squares.spread(), 14 / 6.0, 1e-6);
  EXPECT_NEAR(squares.grey_squares() / std::pow(static_cast<double>(luminance(Rgb(1, 2, -1))), 2), 14, 1e-5);
}

TEST(PathSquares, CountEachPhotonAloneWherePathsAreNotKnown) {
  ZonePaths paths;
  paths.set({});
  EXPECT_FALSE(paths.known());
  PathSquares squares(paths);
  EXPECT_EQ(squares.spread(), 1) << "nothing was added";
  for (std::size_t i = 0; i < 6; ++i) squares.add(i, DVec3(1, 2, -1));
  EXPECT_EQ(squares.squares(), DVec3(6, 24, 6));
  EXPECT_EQ(squares.spread(), 1);
}

TEST(PathSquares, OfANewZoneForgetTheLast) {
  ZonePaths paths;
  const std::uint32_t family[] = {1, 1, 2};
  paths.set(family);
  paths.set(std::span(family).first(1));
  EXPECT_EQ(paths.paths, 1u);
  EXPECT_EQ(paths.path.size(), 1u);
}

}  // namespace
}  // namespace phos
