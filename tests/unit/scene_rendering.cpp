// Colour rendering against published indices.
#include <gtest/gtest.h>

#include "scene/spectral/colour_rendering.h"
#include "support/run.h"

namespace phos::test {
namespace {

ColourRendering of(const Spectrum& light) {
  const WavelengthSteps steps;
  return colour_rendering(steps, steps.power_of(light)).value();
}

Spectrum lamp(const std::string& name) { return read_spectrum(data("spectra/" + name), SpectrumKind::power); }

}  // namespace

/// CIE 15:2004, tables T.1 and T.7: correlated colour temperatures and Ra of illuminants.
TEST(ColourRendering, OfPublishedIlluminants) {
  const ColourRendering a = of(planck_spectrum(2855.5)), d65 = of(Spectrum(kCieD65)),
                        f2 = of(lamp("fluorescent-fl2.csv")), f11 = of(lamp("fluorescent-fl11.csv"));
  EXPECT_NEAR(a.ra, 100, 0.01);
  EXPECT_NEAR(a.cct_K, 2855.5, 1);
  EXPECT_NEAR(a.duv, 0, 1e-6);
  EXPECT_NEAR(d65.ra, 100, 0.05);
  EXPECT_NEAR(d65.cct_K, 6504, 3);
  EXPECT_NEAR(d65.duv, 0.0032, 1e-4);
  EXPECT_EQ(std::lround(f2.ra), 64);
  EXPECT_NEAR(f2.cct_K, 4230, 10);
  EXPECT_EQ(std::lround(f11.ra), 83);
  EXPECT_NEAR(f11.cct_K, 4000, 10);
  // CIE 13.3-1995's special indices of FL2 and FL11.
  const int special_f2[] = {56, 77, 90, 57, 59, 67, 74, 33}, special_f11[] = {98, 93, 50, 88, 87, 77, 89, 79};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(f2.special[i], special_f2[i], 1) << i + 1;
    EXPECT_NEAR(f11.special[i], special_f11[i], 1.1) << i + 1;
  }
}

TEST(ColourRendering, OfDaylightOfEachTemperatureIsFull) {
  for (const double t : {5100.0, 5500.0, 7500.0, 12000.0, 20000.0}) {
    const ColourRendering d = of(daylight_spectrum(t));
    EXPECT_GT(d.ra, 99.9) << t;
    EXPECT_NEAR(d.cct_K / t, 1, 0.003);
  }
  for (const double t : {1500.0, 2700.0, 4900.0}) EXPECT_GT(of(planck_spectrum(t)).ra, 99.99) << t;
}

TEST(ColourRendering, IsOfNoLightThatHasNoTemperature) {
  const WavelengthSteps steps;
  std::vector<double> power(steps.size(), 0.0);
  EXPECT_FALSE(colour_rendering(steps, power));
  power[30] = 1;  // green, 530 nm
  EXPECT_FALSE(colour_rendering(steps, power));
}

/// In bands the index comes near to that of the standard's steps as they become narrow.
TEST(ColourRendering, InBandsConverges) {
  for (const std::string name : {"fluorescent-fl2.csv", "fluorescent-fl11.csv", "led.csv"}) {
    const Spectrum light = lamp(name);
    const double exact = of(light).ra;
    for (const int n : {12, 24, 39, 81}) {
      const WavelengthSteps steps{Bands(n)};
      const ColourRendering r = colour_rendering(steps, steps.power_of(light)).value();
      std::printf("[ FIGURES  ] %s in %d bands: Ra %.2f, exact %.2f; %.0f K, %.0f K\n", name.c_str(), n, r.ra,
                  exact, r.cct_K, of(light).cct_K);
      EXPECT_NEAR(r.ra, exact, n >= 39 ? 4 : 40) << name << " " << n;
    }
  }
}

}  // namespace phos::test
