#include "scene/spectral/bands.h"

#include <algorithm>

#include "core/error.h"
#include "image/primaries.h"

namespace phos::inline scene {
namespace {

/// rgb_to_xyz() with the rounded weights that luminance() has.
glm::dmat3 rec709() {
  glm::dmat3 m(rgb_to_xyz(kRec709));
  for (int c = 0; c < 3; ++c) m[c].y = kLuminanceWeight[c];
  return m;
}

/// Integral of D65 times a colour matching function over an interval; between the tables' points both are
/// linear, so that Simpson's rule is exact.
double matched(const Spectrum& matching, const Spectrum& power, double lo_nm, double hi_nm) {
  double sum = 0;
  for (double cell = kCieFirst_nm; cell < kCieLast_nm; cell += kCieStep_nm) {
    const double from = std::max(lo_nm, cell), to = std::min(hi_nm, cell + kCieStep_nm);
    if (!(from < to)) continue;
    const double middle = 0.5 * (from + to);
    sum += (to - from) / 6 *
           (matching.at(from) * power.at(from) + 4 * matching.at(middle) * power.at(middle) +
            matching.at(to) * power.at(to));
  }
  return sum;
}

}  // namespace

Bands::Bands(int n) {
  PHOS_CHECK(n >= kLeast && n <= kMost, n, " bands");
  white_xyz_.resize(static_cast<std::size_t>(n));
  const Spectrum x(kCieX), y(kCieY), z(kCieZ), white(kCieD65);
  DVec3 sum(0);
  for (int b = 0; b < n; ++b) {
    const double lo = lo_nm(b), hi = hi_nm(b);
    const DVec3 xyz(matched(x, white, lo, hi), matched(y, white, lo, hi), matched(z, white, lo, hi));
    matching_.push_back(xyz / white.integral(lo, hi));
    white_xyz_[static_cast<std::size_t>(b)] = xyz;
    sum += xyz;
  }
  // The table's D65 is within 0.03 % of the white that Rec.709 rounds to four digits.
  const DVec3 scale = xyz_of_rgb(DVec3(1)) / sum;
  for (DVec3& xyz : white_xyz_) xyz *= scale;
}

double Bands::lo_nm(int band) const {
  return kCieFirst_nm + (kCieLast_nm - kCieFirst_nm) * band / static_cast<double>(white_xyz_.size());
}

std::vector<double> Bands::means(const Spectrum& spectrum) const {
  std::vector<double> out;
  for (int b = 0; b < size(); ++b) out.push_back(spectrum.mean(lo_nm(b), hi_nm(b)));
  return out;
}

std::vector<double> Bands::luminous_shares(const Spectrum& power) const {
  std::vector<double> shares = means(power);
  double sum = 0;
  for (int b = 0; b < size(); ++b) sum += shares[static_cast<std::size_t>(b)] *= matching(b).y;
  for (double& share : shares) share = sum > 0 ? share / sum : 0;
  return shares;
}

DVec3 Bands::rgb_of(int triplet, int c) const {
  const int band = band_of(triplet, c);
  if (band < 0) return DVec3(0);
  const DVec3& white = white_xyz(band);
  return rgb_of_xyz(white * (kLuminanceWeight[c] / white.y));
}

DVec3 Bands::triplet_of(const std::vector<double>& of_bands, int triplet) const {
  DVec3 out(0);
  for (int c = 0; c < 3; ++c)
    if (const int band = band_of(triplet, c); band >= 0) out[c] = of_bands[static_cast<std::size_t>(band)];
  return out;
}

DVec3 xyz_of_rgb(const DVec3& rgb) {
  static const glm::dmat3 m = rec709();
  return m * rgb;
}

DVec3 rgb_of_xyz(const DVec3& xyz) {
  static const glm::dmat3 m = glm::inverse(rec709());
  return m * xyz;
}

}  // namespace phos::inline scene
