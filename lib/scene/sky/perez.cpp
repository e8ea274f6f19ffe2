#include "scene/sky/perez.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/json.h"

namespace phos::inline scene {
namespace {

constexpr double kSolarConstant_w_m2 = 1367;
constexpr int kBins = 8;
/// Where the bins of clearness begin.
constexpr double kClearness[kBins] = {1, 1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200};

/// Coefficients 1 to 4 of a, b, c, d and e in each bin.
constexpr double kShape[kBins][5][4] = {{{1.3525, -0.2576, -0.2690, -1.4366},
                                         {-0.7670, 0.0007, 1.2734, -0.1233},
                                         {2.8000, 0.6004, 1.2375, 1.0000},
                                         {1.8734, 0.6297, 0.9738, 0.2809},
                                         {0.0356, -0.1246, -0.5718, 0.9938}},
                                        {{-1.2219, -0.7730, 1.4148, 1.1016},
                                         {-0.2054, 0.0367, -3.9128, 0.9156},
                                         {6.9750, 0.1774, 6.4477, -0.1239},
                                         {-1.5798, -0.5081, -1.7812, 0.1080},
                                         {0.2624, 0.0672, -0.2190, -0.4285}},
                                        {{-1.1000, -0.2515, 0.8952, 0.0156},
                                         {0.2782, -0.1812, -4.5000, 1.1766},
                                         {24.7219, -13.0812, -37.7000, 34.8438},
                                         {-5.0000, 1.5218, 3.9229, -2.6204},
                                         {-0.0156, 0.1597, 0.4199, -0.5562}},
                                        {{-0.5484, -0.6654, -0.2672, 0.7117},
                                         {0.7234, -0.6219, -5.6812, 2.6297},
                                         {33.3389, -18.3000, -62.2500, 52.0781},
                                         {-3.5000, 0.0016, 1.1477, 0.1062},
                                         {0.4659, -0.3296, -0.0876, -0.0329}},
                                        {{-0.6000, -0.3566, -2.5000, 2.3250},
                                         {0.2937, 0.0496, -5.6812, 1.8415},
                                         {21.0000, -4.7656, -21.5906, 7.2492},
                                         {-3.5000, -0.1554, 1.4062, 0.3988},
                                         {0.0032, 0.0766, -0.0656, -0.1294}},
                                        {{-1.0156, -0.3670, 1.0078, 1.4051},
                                         {0.2875, -0.5328, -3.8500, 3.3750},
                                         {14.0000, -0.9999, -7.1406, 7.5469},
                                         {-3.4000, -0.1078, -1.0750, 1.5702},
                                         {-0.0672, 0.4016, 0.3017, -0.4844}},
                                        {{-1.0000, 0.0211, 0.5025, -0.5119},
                                         {-0.3000, 0.1922, 0.7023, -1.6317},
                                         {19.0000, -5.0000, 1.2438, -1.9094},
                                         {-4.0000, 0.0250, 0.3844, 0.2656},
                                         {1.0468, -0.3788, -2.4517, 1.4656}},
                                        {{-1.0500, 0.0289, 0.4260, 0.3590},
                                         {-0.3250, 0.1156, 0.7781, 0.0025},
                                         {31.0625, -14.5000, -46.1148, 55.3750},
                                         {-7.2312, 0.4050, 13.3500, 0.6234},
                                         {1.5000, -0.6426, 1.8564, 0.5636}}};

/// Luminous efficacy of the diffuse irradiance: a + b W + c cos Z + d ln(Delta), lm/W.
constexpr double kDiffuse[kBins][4] = {{97.24, -0.46, 12.00, -8.91},   {107.22, 1.15, 0.59, -3.95},
                                       {104.97, 2.96, -5.53, -8.77},   {102.39, 5.59, -13.95, -13.90},
                                       {100.71, 5.94, -22.75, -23.74}, {106.42, 3.83, -36.15, -28.83},
                                       {141.88, 1.90, -53.24, -14.03}, {152.23, 0.35, -45.27, -7.98}};
/// Of the direct one: a + b W + c exp(5.73 Z - 5) + d Delta, lm/W.
constexpr double kDirect[kBins][4] = {{57.20, -4.55, -2.98, 117.12}, {98.99, -3.46, -1.21, 12.38},
                                      {109.83, -4.90, -1.71, -8.81}, {110.34, -5.84, -1.99, -4.56},
                                      {106.36, -3.97, -1.75, -6.16}, {107.19, -1.25, -1.51, -26.73},
                                      {105.75, 0.77, -1.26, -34.44}, {101.18, 1.58, -1.10, -8.29}};

/// Kasten 1965.
double air_mass(double zenith_rad) {
  const double degrees = zenith_rad * 180 / std::numbers::pi;
  return 1 / (std::cos(zenith_rad) + 0.15 * std::pow(93.885 - degrees, -1.253));
}

SkyShape shape_of(int bin, double zenith_rad, double brightness) {
  const auto linear = [&](int k) {
    const double* x = kShape[bin][k];
    return x[0] + x[1] * zenith_rad + brightness * (x[2] + x[3] * zenith_rad);
  };
  SkyShape shape;
  shape.a = linear(0), shape.b = std::min(linear(1), 0.0);
  shape.c = linear(2), shape.d = linear(3), shape.e = linear(4);
  if (bin > 0) return shape;
  const double *c = kShape[0][2], *d = kShape[0][3];
  shape.c = std::exp(std::pow(brightness * (c[0] + c[1] * zenith_rad), c[2])) - c[3];
  shape.d = -std::exp(brightness * (d[0] + d[1] * zenith_rad)) + d[2] + brightness * d[3];
  return shape;
}

}  // namespace

PerezSky perez_sky(const Irradiances& measured) {
  const double zenith_rad = std::numbers::pi / 2 - measured.elevation_rad,
               cubed = 1.041 * std::pow(zenith_rad, 3);
  const double diffuse = measured.diffuse_horizontal_w_m2, direct = measured.direct_normal_w_m2;
  PerezSky sky;
  sky.clearness = ((diffuse + direct) / diffuse + cubed) / (1 + cubed);
  sky.brightness =
      diffuse * air_mass(zenith_rad) * measured.distance_au * measured.distance_au / kSolarConstant_w_m2;
  if (!(sky.brightness >= 0.01 && sky.brightness <= 0.6))
    throw Error(ExitCode::usage, "--diffuse-irradiance",
                text(shortest(static_cast<float>(diffuse)), " W/m2 with the sun ",
                     shortest(static_cast<float>(measured.elevation_rad * 180 / std::numbers::pi)),
                     " degrees high is a sky of brightness ", shortest(static_cast<float>(sky.brightness)),
                     "; the Perez model holds from 0.01 to 0.6: check irradiance, time and place"));
  int bin = 0;
  while (bin + 1 < kBins && sky.clearness >= kClearness[bin + 1]) ++bin;
  const bool between = bin > 0 && sky.clearness < kClearness[5];
  sky.shape = shape_of(bin, zenith_rad, between ? std::max(sky.brightness, 0.2) : sky.brightness);
  const double water_cm = std::exp(0.07 * measured.dew_point_c - 0.075);
  const double *s = kDiffuse[bin], *n = kDirect[bin];
  sky.sky_lx =
      diffuse *
      std::max(s[0] + s[1] * water_cm + s[2] * std::cos(zenith_rad) + s[3] * std::log(sky.brightness), 0.0);
  sky.sun_lx =
      direct *
      std::max(n[0] + n[1] * water_cm + n[2] * std::exp(5.73 * zenith_rad - 5) + n[3] * sky.brightness, 0.0);
  return sky;
}

}  // namespace phos::inline scene
