// Light in bands against closed forms: in each band light is reflected again and again by that band's own
// reflectance, which three numbers for all wavelengths cannot follow.
#include <gtest/gtest.h>

#include "reference/point_irradiance.h"
#include "scene/spectral/bands.h"
#include "scene/spectral/colour_rendering.h"
#include "scene/spectral/to_bands.h"
#include "support/run.h"
#include "support/scenes.h"

namespace {

using namespace phos;

constexpr double kMostSigma = 4;

/// A sphere of one paint with a lamp of 100 lm in its middle.
struct Sphere {
  explicit Sphere(const std::string& paint, const std::string& lamp, int number)
      : bands(number),
        reflectance(bands.means(read_spectrum(test::data("spectra/" + paint), SpectrumKind::reflectance))),
        shares(bands.luminous_shares(read_spectrum(test::data("spectra/" + lamp), SpectrumKind::power))) {
    options.number = number;
    options.spectra = {"coating=" + test::data("spectra/" + paint), "lamp=" + test::data("spectra/" + lamp)};
    made.scene.light[0].name = "lamp";
  }

  Scene in_triplet(int k) const {
    Scene scene = made.scene;
    scene.material[0].name = "coating";
    BandOptions o = options;
    o.triplet = k;
    to_bands(scene, o);
    finalize(scene);
    return scene;
  }
  /// Mean illuminance by band b: absorbed = emitted, (1 - rho_b) A E_b = P_b.
  double exact_lx(int b) const {
    return test::closed_room_mean_lx(100 * shares[static_cast<std::size_t>(b)], made.area_m2,
                                     reflectance[static_cast<std::size_t>(b)]);
  }

  test::AnalyticScene made = test::integrating_sphere(0.5f, 1280);
  Bands bands;
  std::vector<double> reflectance, shares;
  BandOptions options;
};

DVec3 xyz_of(const Bands& bands, const std::vector<double>& lx) {
  DVec3 sum(0);
  for (int b = 0; b < bands.size(); ++b)
    sum += lx[static_cast<std::size_t>(b)] / bands.white_xyz(b).y * bands.white_xyz(b);
  return sum;
}

}  // namespace

/// Every band of every triplet, by path tracing. Facets of 1280 are so near to a sphere that a point of it is
/// as the mean to 3e-3.
TEST(BandsReference, EachBandIsReflectedByItsOwnReflectance) {
  const Sphere sphere("cornell-red.csv", "fluorescent-fl11.csv", 12);
  double total_lx = 0, exact_total_lx = 0;
  for (int k = 1; k <= sphere.bands.triplets(); ++k) {
    const Scene scene = sphere.in_triplet(k);
    const RayScene rays(scene);
    const Luminaires luminaires(scene);
    const Vec3 n = glm::normalize(Vec3(0.3f, 0.5f, 0.2f));
    const PointIrradiance e = estimate_irradiance(rays, luminaires, 0.9f * n, -n, 20000, -1, 1);
    total_lx += e.illuminance_lx;
    for (int c = 0; c < 3; ++c) {
      const int b = sphere.bands.band_of(k, c);
      const double weight = kLuminanceWeight[c], value = weight * static_cast<double>(e.irradiance_lx[c]),
                   error = weight * static_cast<double>(e.stderr_lx[c]),
                   direct = 100 * sphere.shares[static_cast<std::size_t>(b)] / (4 * std::numbers::pi * 0.81),
                   mean_direct = 100 * sphere.shares[static_cast<std::size_t>(b)] / sphere.made.area_m2;
      // The point stands nearer to the lamp than the wall; what is reflected is the same everywhere.
      const double exact = sphere.exact_lx(b) - mean_direct + direct;
      EXPECT_NEAR(value, exact, kMostSigma * error + 3e-3 * exact) << "band " << b;
      EXPECT_LT(error, 0.03 * exact) << "band " << b;
      exact_total_lx += exact;
    }
  }
  EXPECT_NEAR(total_lx / exact_total_lx, 1, 0.02);
}

/// What RGB makes of the same sphere: the paint's colour under D65, the lamp's colour.
TEST(BandsReference, RgbGetsDeepReflectionsWrong) {
  const Sphere sphere("cornell-red.csv", "fluorescent-fl11.csv", 81);
  std::vector<double> lx, emitted, seen;
  for (int b = 0; b < sphere.bands.size(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    lx.push_back(sphere.exact_lx(b)), emitted.push_back(100 * sphere.shares[i]);
    seen.push_back(sphere.reflectance[i] * sphere.bands.white_xyz(b).y);
  }
  const DVec3 exact = xyz_of(sphere.bands, lx), paint = rgb_of_xyz(xyz_of(sphere.bands, seen)),
              lamp = rgb_of_xyz(xyz_of(sphere.bands, emitted));
  DVec3 rgb(0);
  for (int c = 0; c < 3; ++c) rgb[c] = test::closed_room_mean_lx(lamp[c], sphere.made.area_m2, paint[c]);
  const double y = 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
  std::printf("[ FIGURES  ] red sphere under FL11: %.4f lx in bands, %.4f lx in RGB (%+.1f %%)\n", exact.y, y,
              100 * (y / exact.y - 1));
  EXPECT_GT(std::fabs(y / exact.y - 1), 0.02);
}

/// The sum of what is absorbed in all bands is the lamp's lumens.
TEST(BandsReference, NoLumenIsLost) {
  for (const int n : {12, 39}) {
    const Sphere sphere("cornell-green.csv", "led.csv", n);
    double absorbed = 0;
    for (int b = 0; b < n; ++b)
      absorbed +=
          (1 - sphere.reflectance[static_cast<std::size_t>(b)]) * sphere.made.area_m2 * sphere.exact_lx(b);
    EXPECT_NEAR(absorbed, 100, 1e-9);
    double flux = 0;
    for (int k = 1; k <= sphere.bands.triplets(); ++k)
      flux += static_cast<double>(luminance(sphere.in_triplet(k).light[0].flux_lm));
    EXPECT_NEAR(flux, 100, 1e-3);
  }
}
