#include "hsh/conversion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "hsh/basis.h"
#include "hsh/projection.h"
#include "support/golden_table.h"

namespace phos {
namespace {

double at(const HarmonicConversion& c, int hsh_l, int sh_l, int m) {
  return c.at(harmonic_index(hsh_l, m), harmonic_index(sh_l, m));
}

TEST(HarmonicConversion, IsThatOfTheGoldenTable) {
  const HarmonicConversion c(10, 20);
  const auto rows =
      test::read_table(std::string(PHOS_SOURCE) + "/data/golden/hsh/conversion_C_hsh10_sh20.csv");
  ASSERT_GT(rows.size(), 400u);
  for (const auto& row : rows) {
    const int m = std::stoi(row.at("m")), l = std::stoi(row.at("l_hsh")), s = std::stoi(row.at("l_sh"));
    EXPECT_NEAR(at(c, l, s, m), std::stod(row.at("C")), 2e-14) << m << " " << l << " " << s;
    EXPECT_EQ(at(c, l, s, m), at(c, l, s, -m));
  }
}

TEST(HarmonicConversion, IsZeroBetweenUnlikeM) {
  const HarmonicConversion c(4, 6);
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 36; ++j) {
      const auto m = [](int index) {
        const int l = static_cast<int>(std::sqrt(index));
        return index - l * l - l;
      };
      if (m(i) != m(j)) {
        EXPECT_EQ(c.at(i, j), 0) << i << " " << j;
      }
    }
}

/// A function of few SH, on the hemisphere: its HSH by C and by projection.
TEST(HarmonicConversion, GivesTheProjectionOfWhatShSay) {
  constexpr int kSh = 4, kHsh = 9, kChannels = 3;
  std::vector<float> sh(harmonic_count(kSh) * kChannels), hsh(harmonic_count(kHsh) * kChannels);
  for (std::size_t i = 0; i < sh.size(); ++i)
    sh[i] = std::sin(3.f * static_cast<float>(i) + 1) / (1 + static_cast<float>(i % 7));
  HarmonicConversion(kHsh, kSh).sh_to_hsh(sh, hsh, kChannels);
  for (int channel = 0; channel < kChannels; ++channel) {
    std::vector<double> one;
    for (int i = 0; i < harmonic_count(kSh); ++i)
      one.push_back(sh[static_cast<std::size_t>(i * kChannels + channel)]);
    const auto f = [&](double x, double y, double z) { return reconstruct(one, BasisKind::sh, x, y, z); };
    const std::vector<double> expected = project(f, BasisKind::hsh, kHsh, hemisphere_quadrature(40, 64));
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(hsh[i * kChannels + static_cast<std::size_t>(channel)], expected[i], 1e-6) << i;
  }
}

/// HSH, zero below the horizon: SH by C^T and by projection.
TEST(HarmonicConversion, GivesTheProjectionOfWhatHshSay) {
  constexpr int kSh = 12, kHsh = 5;
  std::vector<float> hsh(harmonic_count(kHsh)), sh(harmonic_count(kSh));
  for (std::size_t i = 0; i < hsh.size(); ++i) hsh[i] = std::cos(5.f * static_cast<float>(i));
  HarmonicConversion(kHsh, kSh).hsh_to_sh(hsh, sh);
  const std::vector<double> exact(hsh.begin(), hsh.end());
  const auto f = [&](double x, double y, double z) { return reconstruct(exact, BasisKind::hsh, x, y, z); };
  const std::vector<double> expected = project(f, BasisKind::sh, kSh, hemisphere_quadrature(60, 64));
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(sh[i], expected[i], 1e-6) << i;
}

/// C C^T tends to 1 from below: there and back loses less the more SH there are (a horizon is a jump).
TEST(HarmonicConversion, ThereAndBackLosesLessByOrder) {
  constexpr int kHsh = 6;
  std::vector<float> hsh(harmonic_count(kHsh));
  for (std::size_t i = 0; i < hsh.size(); ++i) hsh[i] = std::cos(2.f * static_cast<float>(i));
  double before = HUGE_VAL;
  for (const int order : {6, 9, 12, 24, 60}) {
    const HarmonicConversion c(kHsh, order);
    std::vector<float> sh(static_cast<std::size_t>(harmonic_count(order))), back(hsh.size());
    c.hsh_to_sh(hsh, sh);
    c.sh_to_hsh(sh, back);
    double lost = 0, energy = 0;
    for (std::size_t i = 0; i < hsh.size(); ++i) {
      lost += (hsh[i] - back[i]) * (hsh[i] - back[i]);
      energy += hsh[i] * hsh[i];
    }
    EXPECT_LT(std::sqrt(lost / energy), before) << order;
    before = std::sqrt(lost / energy);
  }
  EXPECT_LT(before, 0.05);
}

TEST(HarmonicConversion, RefusesOrdersOutOfRange) {
  for (const auto& [h, s] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {101, 5}, {5, 200}})
    EXPECT_THROW(HarmonicConversion(h, s), Error) << h << " " << s;
  EXPECT_NEAR(HarmonicConversion(1, 1).at(0, 0), std::sqrt(0.5), 1e-15);  // 2 pi / sqrt(2 pi 4 pi)
}

}  // namespace
}  // namespace phos
