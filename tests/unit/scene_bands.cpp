// Colour matching, bands, and the spectra of RGB colours.
#include "scene/spectral/bands.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "image/primaries.h"
#include "scene/spectral/reflectance.h"
#include "support/run.h"

namespace phos::test {
namespace {

glm::dvec2 chromaticity(const CieTable& power) {
  DVec3 xyz(0);
  for (std::size_t i = 0; i < power.size(); ++i) xyz += power[i] * DVec3(kCieX[i], kCieY[i], kCieZ[i]);
  return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

DVec3 sum_of_white(const Bands& bands) {
  DVec3 sum(0);
  for (int b = 0; b < bands.size(); ++b) sum += bands.white_xyz(b);
  return sum;
}

/// The colour that a picture of all triplets has where every triplet's light is `light`.
template <class Light>
DVec3 merged(const Bands& bands, const Light& light) {
  DVec3 rgb(0);
  for (int k = 1; k <= bands.triplets(); ++k) {
    const Rgb of_triplet = light(BandColours(bands, k));
    for (int c = 0; c < 3; ++c) rgb += static_cast<double>(of_triplet[c]) * bands.rgb_of(k, c);
  }
  return rgb;
}

constexpr int kNumbers[] = {3, 4, 5, 12, 24, 39, 40, 81, 400};

}  // namespace

TEST(ColourMatching, WhitesAreWhereTheStandardsPutThem) {
  CieTable equal;
  equal.fill(1);
  const glm::dvec2 e = chromaticity(equal), d65 = chromaticity(kCieD65);
  EXPECT_NEAR(e.x, 1.0 / 3, 5e-6);
  EXPECT_NEAR(e.y, 1.0 / 3, 5e-6);
  EXPECT_NEAR(d65.x, 0.31272, 1e-5);  // CIE 15:2004, table T.3
  EXPECT_NEAR(d65.y, 0.32903, 1e-5);
}

TEST(ColourMatching, IntegralsAndTheFamiliarPlaces) {
  double x = 0, y = 0, z = 0;
  for (std::size_t i = 0; i < kCieX.size(); ++i) x += kCieX[i], y += kCieY[i], z += kCieZ[i];
  // The observer is defined so that the three integrals are equal (of y 106.857 nm, CIE 15).
  EXPECT_NEAR(5 * y, 106.857, 1e-3);
  EXPECT_NEAR(x / y, 1, 2e-5);
  EXPECT_NEAR(z / y, 1, 2e-5);
  EXPECT_EQ(kCieY[35], 1) << "V(lambda) is 1 at 555 nm";
  // The spectral locus at 520 nm (Wyszecki and Stiles): 0.0743, 0.8338.
  const double sum = kCieX[28] + kCieY[28] + kCieZ[28];
  EXPECT_NEAR(kCieX[28] / sum, 0.0743, 5e-5);
  EXPECT_NEAR(kCieY[28] / sum, 0.8338, 5e-5);
}

TEST(Bands, ShareTheSpectrumOutWithoutGaps) {
  for (const int n : kNumbers) {
    const Bands bands(n);
    EXPECT_EQ(bands.size(), n);
    EXPECT_EQ(bands.lo_nm(0), 380);
    EXPECT_EQ(bands.hi_nm(n - 1), 780);
    EXPECT_EQ(bands.triplets(), (n + 2) / 3);
    std::vector<int> seen(static_cast<std::size_t>(n), 0);
    for (int k = 1; k <= bands.triplets(); ++k)
      for (int c = 0; c < 3; ++c)
        if (const int b = bands.band_of(k, c); b >= 0) ++seen.at(static_cast<std::size_t>(b));
    EXPECT_EQ(seen, std::vector<int>(static_cast<std::size_t>(n), 1)) << n;
  }
}

/// White is white for every number of bands, and black is what fills the last triplet.
TEST(Bands, WhiteLightIsWhite) {
  for (const int n : kNumbers) {
    const Bands bands(n);
    const DVec3 rgb = rgb_of_xyz(sum_of_white(bands));
    const DVec3 runs = merged(bands, [](const BandColours& c) { return c.white_light(); });
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(rgb[c], 1, 1e-12) << n;
      EXPECT_NEAR(runs[c], 1, 1e-6) << n;
    }
  }
  const Bands bands(40);
  EXPECT_EQ(BandColours(bands, 14).white_light().y, 0);
  EXPECT_EQ(BandColours(bands, 14).reflectance(Rgb(0.5f)).z, 0);
  EXPECT_EQ(BandColours(bands, 14).reflectance(Rgb(0.5f)).x, 0.5f);
}

/// luminance() of the triplets adds up to that of the picture: lux stay lux.
TEST(Bands, LuminancesAddUp) {
  for (const int n : kNumbers) {
    const Bands bands(n);
    double sum = 0;
    for (int k = 1; k <= bands.triplets(); ++k)
      sum += static_cast<double>(luminance(BandColours(bands, k).light({0.9f, 0.4f, 0.1f})));
    const DVec3 rgb = merged(bands, [](const BandColours& c) { return c.light({0.9f, 0.4f, 0.1f}); });
    EXPECT_NEAR(sum, 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z, 1e-6) << n;
    for (int k = 1; k <= bands.triplets(); ++k)
      for (int c = 0; c < 3; ++c) {
        const DVec3 one = bands.rgb_of(k, c);
        const double y = 0.2126 * one.x + 0.7152 * one.y + 0.0722 * one.z;
        EXPECT_NEAR(y, bands.band_of(k, c) < 0 ? 0 : kLuminanceWeight[c], 1e-12 * glm::length(one)) << n;
      }
  }
}

/// Whatever the spectrum of a lamp, its shares are all of its lumens.
TEST(Bands, SharesOfALampAreAllOfIt) {
  const Spectrum sodium({588, 589, 590}, {0, 1, 0}, Spectrum::Beyond::zero);
  for (const int n : kNumbers) {
    const Bands bands(n);
    for (const Spectrum& lamp : {sodium, Spectrum(kCieD65), Spectrum(kCieS0)}) {
      double sum = 0;
      for (const double share : bands.luminous_shares(lamp)) sum += share;
      EXPECT_NEAR(sum, 1, 1e-12) << n;
    }
    // White light has the shares of white.
    const std::vector<double> white = bands.luminous_shares(Spectrum(kCieD65));
    for (int b = 0; b < n; ++b)
      EXPECT_NEAR(white[static_cast<std::size_t>(b)], bands.white_xyz(b).y, 1e-12) << n;
  }
}

/// Over the Rec.709 cube, 17^3 colours: the greatest difference of a component. Few bands cannot make
/// saturated colours; 12 make all to a hundredth and a half, 24 and more exactly, and greys are exact always.
TEST(ReflectanceFit, GivesTheColourBack) {
  constexpr int kSide = 17;
  for (const auto& [n, most] : {std::pair{12, 0.015}, {24, 1e-5}, {39, 1e-5}, {81, 1e-5}}) {
    const Bands bands(n);
    const ReflectanceFit fit(bands);
    double worst = 0, worst_inside = 0;
    Rgb where(0);
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const Rgb c(static_cast<float>(i % kSide) / (kSide - 1),
                  static_cast<float>(i / kSide % kSide) / (kSide - 1),
                  static_cast<float>(i / kSide / kSide) / (kSide - 1));
      const std::vector<double> reflectance = fit.fit(c);
      for (const double r : reflectance) ASSERT_TRUE(r >= 0 && r <= 1);
      const DVec3 off = glm::abs(fit.rgb_of(reflectance) - DVec3(c));
      const double error = std::max({off.x, off.y, off.z});
      if (error > worst) worst = error, where = c;
      if (glm::all(glm::greaterThan(c, Rgb(0.05f))) && max_component(c) < 0.95f)
        worst_inside = std::max(worst_inside, error);
      if (c.x == c.y && c.y == c.z) {
        EXPECT_LT(error, 1e-7);
      }
    }
    std::printf(
        "[ FIGURES  ] %d bands: greatest error %.5f at %.3f %.3f %.3f; %.6f where all of 0.05 to 0.95\n", n,
        worst, static_cast<double>(where.x), static_cast<double>(where.y), static_cast<double>(where.z),
        worst_inside);
    EXPECT_LT(worst, most) << n;
  }
}

/// The table that textures use makes the same colours under D65, over all triplets. (Its spectra between
/// nodes are other ones.)
TEST(BandColourTable, GivesTheColourBack) {
  constexpr std::size_t kColours = 2000;
  const Bands bands(39);
  RandomStream random(1, Stage::test, 0);
  std::vector<Rgb> colours;
  for (std::size_t i = 0; i < kColours; ++i) {
    const float size = random.uniform();
    colours.push_back(size * size * Rgb(random.uniform(), random.uniform(), random.uniform()));
  }
  std::vector<DVec3> off(kColours, DVec3(0)), light_off(kColours, DVec3(0));
  for (int k = 1; k <= bands.triplets(); ++k) {
    const BandColours exact(bands, k);
    const BandColourTable table(exact);
    for (std::size_t i = 0; i < kColours; ++i) {
      const Rgb &c = colours[i], white = exact.white_light();
      const Rgb reflected = white * (table.reflectance(c) - exact.reflectance(c)),
                light = table.light(c) - exact.light(c);
      for (int j = 0; j < 3; ++j) {
        off[i] += static_cast<double>(reflected[j]) * bands.rgb_of(k, j);
        light_off[i] += static_cast<double>(light[j]) * bands.rgb_of(k, j);
      }
      EXPECT_LT(max_component(glm::abs(table.reflectance(Rgb(c.x)) - Rgb(c.x))), 1e-6f);
      const Rgb grey_off = glm::abs(table.light(Rgb(c.x)) - c.x * white);
      EXPECT_LE(max_component(grey_off), 1e-6f * max_component(white));
    }
    // Beyond 1, and black.
    EXPECT_LT(glm::length(table.reflectance({4, 2, 1}) - 4.f * table.reflectance({1, 0.5f, 0.25f})), 1e-5f);
    EXPECT_EQ(table.reflectance(Rgb(0)), Rgb(0));
    EXPECT_EQ(table.light(Rgb(0)), Rgb(0));
  }
  double worst = 0, worst_light = 0;
  for (std::size_t i = 0; i < kColours; ++i) {
    const DVec3 a = glm::abs(off[i]), b = glm::abs(light_off[i]);
    worst = std::max({worst, a.x, a.y, a.z}), worst_light = std::max({worst_light, b.x, b.y, b.z});
  }
  std::printf("[ FIGURES  ] table off by %.5f, of light by %.5f\n", worst, worst_light);
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT(worst_light, 1e-5);
}

/// Two pigments of one colour under D65 are two colours under other lamps, in bands as in the standard's
/// steps.
TEST(Bands, MetamersPart) {
  const auto colour = [](const Bands& bands, const std::string& pigment, const std::vector<double>& shares) {
    const std::vector<double> reflectance =
        bands.means(read_spectrum(data("spectra/" + pigment), SpectrumKind::reflectance));
    DVec3 rgb(0);
    for (int k = 1; k <= bands.triplets(); ++k)
      for (int c = 0; c < 3; ++c)
        if (const int b = bands.band_of(k, c); b >= 0) {
          const auto i = static_cast<std::size_t>(b);
          rgb += reflectance[i] * shares[i] / kLuminanceWeight[c] * bands.rgb_of(k, c);
        }
    return rgb;
  };
  for (const int n : {24, 39, 81}) {
    const Bands bands(n);
    const auto apart = [&](const Spectrum& lamp) {
      const std::vector<double> shares = bands.luminous_shares(lamp);
      return glm::length(colour(bands, "pigment-a.csv", shares) - colour(bands, "pigment-b.csv", shares));
    };
    const double d65 = apart(Spectrum(kCieD65)),
                 fl11 = apart(read_spectrum(data("spectra/fluorescent-fl11.csv"), SpectrumKind::power)),
                 sodium = apart(read_spectrum(data("spectra/sodium.csv"), SpectrumKind::power));
    std::printf(
        "[ FIGURES  ] %d bands: pigments apart by %.4f under D65, %.4f under FL11, %.4f under sodium\n", n,
        d65, fl11, sodium);
    EXPECT_LT(d65, n < 39 ? 0.02 : 0.005);
    EXPECT_GT(fl11, 0.05);
    EXPECT_GT(sodium, 0.05);
  }
}

}  // namespace phos::test
