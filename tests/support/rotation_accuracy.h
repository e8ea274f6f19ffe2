// What each way of rotating HSH is worth, by order and angle.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.h"
#include "hsh/basis.h"
#include "hsh/quadrature.h"
#include "hsh/turn/hsh_turn.h"

namespace phos::test {

/// Light of two kinds: lobes of cosines (exponent 5, at the normal and 45 degrees from it, and 20, at 30
/// degrees) that are 0 below their own horizon; and environments, which go on below the horizon: random SH of
/// orders 5 and 10, smooth and less so.
class ProbeLight {
 public:
  static constexpr std::size_t kLobes = 6, kSmooth = 12, kRough = 8, kCount = kLobes + kSmooth + kRough;
  ProbeLight() : sh_(10), y_(100) {
    for (std::size_t f = 0; f < kSmooth + kRough; ++f) {
      const bool smooth = f < kSmooth;
      RandomStream random(1, Stage::test, f);
      std::vector<double>& c = environment_.emplace_back();
      for (int l = 0; l < (smooth ? 5 : 10); ++l)
        for (int m = -l; m <= l; ++m)  // unit variance before it is scaled
          c.push_back(std::sqrt(12.) * (random.uniform() - 0.5) / std::pow(1 + l, smooth ? 1 : 1.5));
      c[0] = std::fabs(c[0]) + (smooth ? 3 : 2);
    }
  }
  std::array<double, kCount> at(double x, double y, double z) {
    std::array<double, kCount> value;
    const double tilt = std::numbers::sqrt2 / 2, less = std::sqrt(3.) / 2;
    std::size_t f = 0;
    const auto lobe = [&](int exponent, double ax, double ay, double az) {
      value[f++] = std::pow(std::max(0., ax * x + ay * y + az * z), exponent);
    };
    lobe(5, 0, 0, 1), lobe(5, tilt, 0, tilt), lobe(5, -tilt, 0, tilt), lobe(5, 0, tilt, tilt);
    lobe(20, 0.5, 0, less), lobe(20, 0, 0.5, less);
    sh_.evaluate(BasisKind::sh, x, y, z, y_.data());
    for (const std::vector<double>& c : environment_) {
      value[f] = 0;
      for (std::size_t i = 0; i < c.size(); ++i) value[f] += c[i] * y_[i];
      ++f;
    }
    return value;
  }

 private:
  HarmonicBasis<double> sh_;
  std::vector<double> y_;
  std::vector<std::vector<double>> environment_;
};

inline std::vector<double> apply(const Turn& turn, const std::vector<double>& c) {
  std::vector<double> out(c.size(), 0.);
  const auto at = [](int l, int m) { return static_cast<std::size_t>(harmonic_index(l, m)); };
  for (int l = 0; l < turn.order; ++l)
    for (int m = 0; m <= l; ++m)
      for (int k = 0; k < turn.order; ++k)
        for (int n = 0; n <= k; ++n) {
          out[at(l, m)] +=
              turn.cosine[Turn::cosine_index(l, m) * turn.cosines() + Turn::cosine_index(k, n)] * c[at(k, n)];
          if (m > 0 && n > 0)
            out[at(l, -m)] +=
                turn.sine[Turn::sine_index(l, m) * turn.sines() + Turn::sine_index(k, n)] * c[at(k, -n)];
        }
  return out;
}

struct RotationAccuracy {
  std::string method;
  /// Root mean square over the lobes of the difference, relative in L2, from the turned sum of HSH over the
  /// part of the hemisphere that both horizons leave.
  double lobes_where_both_see = 0;
  /// Root mean square over the environments of the difference from the projection of the turned light, with
  /// the light from below the old horizon.
  double environments = 0;
};

/// For a turn about y of `degrees`.
inline std::vector<RotationAccuracy> rotation_accuracy(int order, double degrees) {
  const double beta = degrees * std::numbers::pi / 180, cosine = std::cos(beta), sine = std::sin(beta);
  const auto count = static_cast<std::size_t>(harmonic_count(order));
  const HarmonicBasis<double> basis(order);
  ProbeLight light;
  std::vector<double> h(count), before(count);

  std::vector<std::vector<double>> input(ProbeLight::kCount, std::vector<double>(count, 0.)), wanted = input;
  const Quadrature q = hemisphere_quadrature(48, 96);
  for (std::size_t k = 0; k < q.size(); ++k) {
    basis.evaluate(BasisKind::hsh, q.x[k], q.y[k], q.z[k], h.data());
    const auto here = light.at(q.x[k], q.y[k], q.z[k]);
    const auto turned = light.at(cosine * q.x[k] - sine * q.z[k], q.y[k], sine * q.x[k] + cosine * q.z[k]);
    for (std::size_t f = 0; f < ProbeLight::kCount; ++f)
      for (std::size_t i = 0; i < count; ++i) {
        input[f][i] += q.weight[k] * here[f] * h[i];
        wanted[f][i] += q.weight[k] * turned[f] * h[i];
      }
  }

  std::vector<RotationAccuracy> rows{{"none"},      {"via_sh"},        {"digon"},
                                     {"zero_fill"}, {"constant_fill"}, {"even_fill"}};
  std::vector<std::vector<std::vector<double>>> output{input};
  for (int method = 0; method < 5; ++method) {
    const Turn turn = hsh_turn(order, static_cast<HshRotation>(method), beta);
    auto& rotated = output.emplace_back();
    for (const std::vector<double>& c : input) rotated.push_back(apply(turn, c));
  }

  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t f = ProbeLight::kLobes; f < ProbeLight::kCount; ++f) {
      double off = 0, size = 0;
      for (std::size_t i = 0; i < count; ++i) {
        off += std::pow(output[r][f][i] - wanted[f][i], 2);
        size += wanted[f][i] * wanted[f][i];
      }
      rows[r].environments += off / size / (ProbeLight::kCount - ProbeLight::kLobes);
    }
    rows[r].environments = std::sqrt(rows[r].environments);
  }

  // The lune that both horizons leave, about the y axis: psi from 0 to pi - beta, points dense at its rim.
  std::vector<double> u, weight;
  gauss_legendre(64, u, weight);
  const auto smooth = [](double v) { return v * v * v * (10 - 15 * v + 6 * v * v); };
  const auto slope = [](double v) { return 30 * v * v * (1 - v) * (1 - v); };
  std::vector<std::array<double, ProbeLight::kLobes>> off(rows.size());
  for (auto& o : off) o.fill(0);
  std::array<double, ProbeLight::kLobes> size{};
  for (std::size_t a = 0; a < u.size(); ++a)
    for (std::size_t b = 0; b < u.size(); ++b) {
      const double s = 0.5 * (u[a] + 1), t = 0.5 * (u[b] + 1);
      const double psi = (std::numbers::pi - beta) * smooth(s), theta = std::numbers::pi * smooth(t);
      const double rho = std::sin(theta), w = weight[a] * weight[b] * slope(s) * slope(t) * rho;
      basis.evaluate(BasisKind::hsh, rho * std::cos(psi), std::cos(theta), rho * std::sin(psi), h.data());
      basis.evaluate(BasisKind::hsh, rho * std::cos(psi + beta), std::cos(theta), rho * std::sin(psi + beta),
                     before.data());
      const auto sum = [&](const std::vector<double>& c, const std::vector<double>& y) {
        double value = 0;
        for (std::size_t i = 0; i < count; ++i) value += c[i] * y[i];
        return value;
      };
      for (std::size_t f = 0; f < ProbeLight::kLobes; ++f) {
        const double exact = sum(input[f], before);
        size[f] += w * exact * exact;
        for (std::size_t r = 0; r < rows.size(); ++r)
          off[r][f] += w * std::pow(sum(output[r][f], h) - exact, 2);
      }
    }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t f = 0; f < ProbeLight::kLobes; ++f)
      rows[r].lobes_where_both_see += off[r][f] / size[f] / ProbeLight::kLobes;
    rows[r].lobes_where_both_see = std::sqrt(rows[r].lobes_where_both_see);
  }
  return rows;
}

constexpr const char* kRotationHeader = "order,beta_deg,method,lobes_where_both_see,environments\n";
inline std::string rotation_rows(int order, double degrees) {
  std::string rows;
  for (const RotationAccuracy& r : rotation_accuracy(order, degrees)) {
    char line[120];
    std::snprintf(line, sizeof line, "%d,%g,%s,%.4g,%.4g\n", order, degrees, r.method.c_str(),
                  r.lobes_where_both_see, r.environments);
    rows += line;
  }
  return rows;
}

}  // namespace phos::test
