#include "photon/local_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos::inline photon {
namespace {

/// Half width of a confidence interval, in standard errors. Measured over edges, folds, foci, waves and even
/// light with 512 photons at most: at 1.5 the rms error of even light is twice the error with half of them,
/// at 1.75 it is 1.2 times that error; more smears edges and folds. Stated errors then hold in 91 to 99 of
/// 100.
constexpr double kAgree = 1.6;
/// The bias of a disc may be so many times its difference from the disc of twice the area, or of half.
/// Measured over the same light. Where light bends evenly it is once and twice.
constexpr double kOfLarger = 1.5, kOfSmaller = 2;
constexpr int kMostDiscs = 40;
/// Discs go on to be halved until the photons of the largest would leave 1/8 in them.
constexpr int kSparse = 3;

/// One of the nested discs.
struct Disc {
  double area_m2 = 0, error = 0;  // measured; relative error of that
  std::size_t count = 0;
  DVec3 sum{0}, squares{0};
  double lum = 0, lum2 = 0;

  DVec3 irradiance() const { return sum / area_m2; }
  double mean_lx() const { return lum / area_m2; }
};

/// What is left of a difference, squared, beyond the noise in it.
DVec3 beyond_noise(const DVec3& difference, const DVec3& variance) {
  return glm::max(difference * difference - variance, DVec3(0));
}

}  // namespace

LocalDensity local_density(std::span<const float> distance2_m2, std::span<const Rgb> flux_lm, float radius_m,
                           const Rgb& one_photon_lm, const ShareOfDisc& share) {
  PHOS_CHECK(distance2_m2.size() == flux_lm.size() && radius_m > 0, distance2_m2.size(), " photons, radius ",
             radius_m);
  const std::size_t n = distance2_m2.size();
  std::array<Disc, kMostDiscs> disc;
  const auto most = static_cast<double>(radius_m);
  const int discs = std::min(
      kMostDiscs,
      2 + kSparse + static_cast<int>(std::ceil(std::log2(std::max<double>(1, static_cast<double>(n))))));
  const auto radius_of = [&](int j) { return most * std::pow(2, -0.5 * j); };
  // From the smallest outwards, each adds to the one before.
  std::size_t i = 0;
  Disc sum;
  for (int j = discs - 1; j >= 0; --j) {
    const double r2 = most * most * std::pow(2, -j);
    for (; i < n && static_cast<double>(distance2_m2[i]) < r2; ++i) {
      const DVec3 f(flux_lm[i]);
      const auto l = static_cast<double>(luminance(flux_lm[i]));
      sum.sum += f, sum.squares += f * f, sum.lum += l, sum.lum2 += l * l;
    }
    sum.count = i;
    const DiscShare measured = share ? share(radius_of(j)) : DiscShare();
    sum.area_m2 = std::numbers::pi * r2 * measured.share, sum.error = measured.error;
    disc[static_cast<std::size_t>(j)] = sum;
  }
  const Disc& all = disc[0];
  LocalDensity result;
  if (all.count == 0) {
    result.noise_lx = Rgb(DVec3(one_photon_lm) / all.area_m2);
    result.radius_m = radius_m;
    return result;
  }
  // A photon as they are here.
  const double photon_lm = all.lum > 0 ? all.lum2 / all.lum : 0;
  double least = -HUGE_VAL, greatest = HUGE_VAL;
  int best = discs - 1;
  for (int j = discs - 1; j >= 0; --j) {
    const Disc& d = disc[static_cast<std::size_t>(j)];
    // Upwards the score interval of a Poisson number: small discs that happen to hold no photons are not sure
    // of the dark. Downwards one photon more than were counted: nor are discs with one or two photons sure of
    // light.
    const double up = kAgree * kAgree / 2 * photon_lm +
                      kAgree * std::sqrt(d.lum2 + kAgree * kAgree / 4 * photon_lm * photon_lm);
    const double down = kAgree * std::sqrt(d.lum2 + photon_lm * photon_lm);
    greatest = std::min(greatest, (d.lum + up) / d.area_m2);
    least = std::max(least, (d.lum - down) / d.area_m2);
    if (least > greatest) break;
    best = j;
  }
  result.settled = best > 0;
  best = std::clamp(best, 1, discs - 2);
  const Disc& chosen = disc[static_cast<std::size_t>(best)];
  const DVec3 mean = chosen.irradiance(), geometric = mean * chosen.error;
  const DVec3 one = all.squares / glm::max(all.sum, DVec3(1e-300));
  const DVec3 squares = chosen.count > 0 ? chosen.squares : one * one;
  const auto bias2 = [&](const Disc& larger, const Disc& smaller, double factor) {
    // Nested discs of areas A and A/2: the variance of the difference is the variance of the larger one's
    // mean.
    const DVec3 variance = larger.squares / (larger.area_m2 * larger.area_m2);
    return factor * factor * beyond_noise(larger.irradiance() - smaller.irradiance(), variance);
  };
  const DVec3 bias = glm::max(bias2(disc[static_cast<std::size_t>(best - 1)], chosen, kOfLarger),
                              bias2(chosen, disc[static_cast<std::size_t>(best + 1)], kOfSmaller));
  result.irradiance = Rgb(mean);
  result.noise_lx = Rgb(glm::sqrt(squares / (chosen.area_m2 * chosen.area_m2) + geometric * geometric));
  result.bias_lx = Rgb(glm::sqrt(bias));
  result.area_m2 = chosen.area_m2;
  result.radius_m = static_cast<float>(radius_of(best)), result.photons = chosen.count;
  return result;
}

}  // namespace phos::inline photon
