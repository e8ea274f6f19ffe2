#include "hsh/conversion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "hsh/basis.h"
#include "hsh/quadrature.h"

namespace phos::inline hsh {
namespace {

/// |m| of an index, and its band.
struct BandAndM {
  int l, m;
};
BandAndM band_and_m(int index) {
  auto l = static_cast<int>(std::sqrt(static_cast<double>(index)));
  l += (l + 1) * (l + 1) <= index;
  l -= l * l > index;
  return {l, std::abs(index - l * l - l)};
}

}  // namespace

HarmonicConversion::HarmonicConversion(int hsh_order, int sh_order)
    : hsh_order_(hsh_order), sh_order_(sh_order) {
  const HarmonicBasis<double> hsh(hsh_order), sh(sh_order);
  const int bands = std::min(hsh_order, sh_order);
  for (int m = 0; m < bands; ++m)
    block_.emplace_back(static_cast<std::size_t>((hsh_order - m) * (sh_order - m)));

  // In t = sqrt(z) the integrand is a polynomial of degree 2 (l + l') + 1, or for odd m such a polynomial
  // times sqrt(1 + t^2), which needs some points more.
  std::vector<double> t, weight;
  gauss_legendre(hsh_order + sh_order + 24, t, weight);
  std::vector<double> h(static_cast<std::size_t>(hsh.count())), y(static_cast<std::size_t>(sh.count()));
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double root = 0.5 * (t[k] + 1), z = root * root, x = std::sqrt((1 - z) * (1 + z));
    hsh.evaluate(BasisKind::hsh, x, 0, z, h.data());
    sh.evaluate(BasisKind::sh, x, 0, z, y.data());
    for (int m = 0; m < bands; ++m) {
      // 1/2 dt, dz = 2 t dt, and the integral of cos^2(m phi).
      const double w = weight[k] * root * (m == 0 ? 2 : 1) * std::numbers::pi;
      double* c = block_[static_cast<std::size_t>(m)].data();
      for (int l = m; l < hsh_order; ++l)
        for (int s = m; s < sh_order; ++s)
          *c++ += w * h[static_cast<std::size_t>(harmonic_index(l, m))] *
                  y[static_cast<std::size_t>(harmonic_index(s, m))];
    }
  }
}

double HarmonicConversion::at(int hsh_index, int sh_index) const {
  PHOS_CHECK(hsh_index >= 0 && hsh_index < harmonic_count(hsh_order_), "index ", hsh_index);
  PHOS_CHECK(sh_index >= 0 && sh_index < harmonic_count(sh_order_), "index ", sh_index);
  const auto [l, m] = band_and_m(hsh_index);
  const auto [s, n] = band_and_m(sh_index);
  const bool same_m = hsh_index - l * l - l == sh_index - s * s - s;
  return same_m ? row(m, l)[s - m] : 0;
}

namespace {

/// Bands l = |m| .. order - 1 of one m and channel, gathered and scattered.
void gather(std::span<const float> from, int order, int m, int channel, int channels, double* to) {
  for (int l = std::abs(m); l < order; ++l)
    *to++ = from[static_cast<std::size_t>(harmonic_index(l, m) * channels + channel)];
}
void scatter(const double* from, int order, int m, int channel, int channels, std::span<float> to) {
  for (int l = std::abs(m); l < order; ++l)
    to[static_cast<std::size_t>(harmonic_index(l, m) * channels + channel)] = static_cast<float>(*from++);
}

/// to = C from, or C^T from where `to_sh`, for each m and channel.
void convert(const HarmonicConversion& c, bool to_sh, std::span<const float> from, std::span<float> to,
             int channels) {
  const int hsh_order = c.hsh_order(), sh_order = c.sh_order();
  const int from_order = to_sh ? hsh_order : sh_order, to_order = to_sh ? sh_order : hsh_order;
  PHOS_CHECK(channels > 0, "channels ", channels);
  PHOS_CHECK(from.size() == static_cast<std::size_t>(channels * harmonic_count(from_order)), from.size());
  PHOS_CHECK(to.size() == static_cast<std::size_t>(channels * harmonic_count(to_order)), to.size());
  std::fill(to.begin(), to.end(), 0.f);
  const int bands = std::min(hsh_order, sh_order);
  double in[HarmonicBasis<double>::kMaxOrder], out[HarmonicBasis<double>::kMaxOrder];
  for (int m = 1 - bands; m < bands; ++m) {
    const int least = std::abs(m), columns = sh_order - least;
    for (int channel = 0; channel < channels; ++channel) {
      gather(from, from_order, m, channel, channels, in);
      std::fill(out, out + to_order - least, 0.);
      for (int l = least; l < hsh_order; ++l) {
        const double* row = c.row(least, l);
        if (to_sh) {
          for (int s = 0; s < columns; ++s) out[s] += row[s] * in[l - least];
        } else {
          for (int s = 0; s < columns; ++s) out[l - least] += row[s] * in[s];
        }
      }
      scatter(out, to_order, m, channel, channels, to);
    }
  }
}

}  // namespace

void HarmonicConversion::sh_to_hsh(std::span<const float> sh, std::span<float> hsh, int channels) const {
  convert(*this, false, sh, hsh, channels);
}

void HarmonicConversion::hsh_to_sh(std::span<const float> hsh, std::span<float> sh, int channels) const {
  convert(*this, true, hsh, sh, channels);
}

}  // namespace phos::inline hsh
