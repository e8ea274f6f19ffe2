#include "scene/spectral/colour_rendering.h"

#include <cmath>

namespace phos::inline scene {
namespace {

constexpr double kFurthest_uv = 0.05;  // CIE 15: beyond, a correlated colour temperature means nothing
constexpr double kColdest_K = 1000, kHottest_K = 25000, kDaylight_K = 5000;

struct Uv {
  double u, v;
};

/// CIE 1960.
Uv uv_of(const DVec3& xyz) {
  const double sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
  return {4 * xyz.x / sum, 6 * xyz.y / sum};
}

double nm_of(std::size_t i) { return kCieFirst_nm + kCieStep_nm * static_cast<double>(i); }

double distance_to_planck(const WavelengthSteps& steps, const Uv& light, double log_K) {
  const Uv p = uv_of(steps.xyz_of(steps.power_of(planck_spectrum(std::exp(log_K)))));
  return std::hypot(light.u - p.u, light.v - p.v);
}

/// Nearest point of the locus: a scan, then golden sections about its best.
double nearest_K(const WavelengthSteps& steps, const Uv& light) {
  constexpr int kScan = 64;
  const double lo = std::log(kColdest_K / 1.2), hi = std::log(kHottest_K * 1.2), step = (hi - lo) / kScan;
  int best = 0;
  double least = 1e30;
  for (int i = 0; i <= kScan; ++i) {
    const double d = distance_to_planck(steps, light, lo + i * step);
    if (d < least) least = d, best = i;
  }
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = lo + (best - 1) * step, b = lo + (best + 1) * step;
  for (int i = 0; i < 40; ++i) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (distance_to_planck(steps, light, c) < distance_to_planck(steps, light, d))
      b = d;
    else
      a = c;
  }
  return std::exp(0.5 * (a + b));
}

/// CIE 1964 U* V* W*; white has u0, v0.
DVec3 uvw(const Uv& c, double y, const Uv& white) {
  const double w = 25 * std::cbrt(y) - 17;
  return {13 * w * (c.u - white.u), 13 * w * (c.v - white.v), w};
}

struct Adaptation {  // of von Kries, as CIE 13.3 writes it
  double c, d;
};
Adaptation adaptation(const Uv& uv) {
  return {(4 - uv.u - 10 * uv.v) / uv.v, (1.708 * uv.v + 0.404 - 1.481 * uv.u) / uv.v};
}

}  // namespace

WavelengthSteps::WavelengthSteps() {
  for (std::size_t i = 0; i < kCieX.size(); ++i) {
    matching_.emplace_back(kCieX[i], kCieY[i], kCieZ[i]);
    lo_nm_.push_back(nm_of(i)), hi_nm_.push_back(nm_of(i));
  }
  for (std::size_t k = 0; k < test_.size(); ++k) test_[k] = taken(kCieTestColours[k]);
}

WavelengthSteps::WavelengthSteps(const Bands& bands) {
  for (int b = 0; b < bands.size(); ++b) {
    matching_.push_back(bands.matching(b));
    lo_nm_.push_back(bands.lo_nm(b)), hi_nm_.push_back(bands.hi_nm(b));
  }
  for (std::size_t k = 0; k < test_.size(); ++k) test_[k] = taken(kCieTestColours[k]);
}

std::vector<double> WavelengthSteps::taken(const CieTable& table) const { return power_of(Spectrum(table)); }

std::vector<double> WavelengthSteps::power_of(const Spectrum& spectrum) const {
  std::vector<double> out;
  for (std::size_t i = 0; i < lo_nm_.size(); ++i)
    out.push_back(lo_nm_[i] < hi_nm_[i] ? spectrum.mean(lo_nm_[i], hi_nm_[i]) : spectrum.at(lo_nm_[i]));
  return out;
}

DVec3 WavelengthSteps::xyz_of(const std::vector<double>& power,
                              const std::vector<double>* reflectance) const {
  DVec3 sum(0);
  for (std::size_t i = 0; i < matching_.size(); ++i)
    sum += power[i] * (reflectance ? (*reflectance)[i] : 1.0) * matching_[i];
  return sum;
}

std::optional<ColourRendering> colour_rendering(const WavelengthSteps& steps,
                                                const std::vector<double>& power) {
  const DVec3 xyz = steps.xyz_of(power);
  if (!(xyz.y > 0)) return {};
  static const WavelengthSteps exactly;
  const Uv light = uv_of(xyz);
  ColourRendering out;
  out.cct_K = nearest_K(exactly, light);
  const Uv locus = uv_of(exactly.xyz_of(exactly.power_of(planck_spectrum(out.cct_K))));
  out.duv = std::copysign(std::hypot(light.u - locus.u, light.v - locus.v), light.v - locus.v);
  if (!(out.cct_K >= kColdest_K && out.cct_K <= kHottest_K) || std::fabs(out.duv) > kFurthest_uv) return {};

  // The reference is seen by the same steps, so that it is the nearest there.
  const double t = nearest_K(steps, light);
  const std::vector<double> reference =
      steps.power_of(out.cct_K < kDaylight_K ? planck_spectrum(t) : daylight_spectrum(std::max(t, 4000.0)));
  const DVec3 reference_xyz = steps.xyz_of(reference);
  const Uv white = uv_of(reference_xyz);
  const Adaptation of_light = adaptation(light), of_white = adaptation(white);
  for (std::size_t i = 0; i < out.special.size(); ++i) {
    const std::vector<double>& sample = steps.test_colour(i);
    const DVec3 seen = steps.xyz_of(power, &sample), meant = steps.xyz_of(reference, &sample);
    const Adaptation of_sample = adaptation(uv_of(seen));
    const double c = of_white.c / of_light.c * of_sample.c, d = of_white.d / of_light.d * of_sample.d;
    const double below = 16.518 + 1.481 * c - d;
    const Uv adapted{(10.872 + 0.404 * c - 4 * d) / below, 5.520 / below};
    const DVec3 difference =
        uvw(uv_of(meant), 100 * meant.y / reference_xyz.y, white) - uvw(adapted, 100 * seen.y / xyz.y, white);
    out.special[i] = 100 - 4.6 * glm::length(difference);
    out.ra += out.special[i] / static_cast<double>(out.special.size());
  }
  return out;
}

Spectrum planck_spectrum(double temperature_K) {
  constexpr double kC2_nmK = 1.438776877e7;  // second radiation constant
  CieTable power;
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double nm = nm_of(i), at_560 = std::expm1(kC2_nmK / (560 * temperature_K));
    power[i] = std::pow(560 / nm, 5) * at_560 / std::expm1(kC2_nmK / (nm * temperature_K));
  }
  return Spectrum(power);
}

Spectrum daylight_spectrum(double t) {
  const double x = t <= 7000 ? -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063
                             : -2.0064e9 / (t * t * t) + 1.9018e6 / (t * t) + 0.24748e3 / t + 0.237040;
  const double y = -3.000 * x * x + 2.870 * x - 0.275, m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m, m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
  CieTable power;
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = kCieS0[i] + m1 * kCieS1[i] + m2 * kCieS2[i];
  return Spectrum(power);
}

}  // namespace phos::inline scene
