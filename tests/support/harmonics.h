// Harmonics in tests: golden tables of values and gradients, the Gram matrix.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "hsh/basis.h"
#include "hsh/quadrature.h"
#include "support/golden_table.h"

namespace phos::test {

/// A direction of directions.csv, normalised.
struct GoldenDirection {
  double x = 0, y = 0, z = 1;
};
inline std::map<std::string, GoldenDirection> golden_directions(const std::string& folder) {
  std::map<std::string, GoldenDirection> directions;
  for (const auto& row : read_table(folder + "/directions.csv")) {
    GoldenDirection d{std::stod(row.at("x")), std::stod(row.at("y")), std::stod(row.at("z"))};
    const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    directions[row.at("dir")] = {d.x / length, d.y / length, d.z / length};
  }
  return directions;
}

inline std::string golden_column(int l, int m) { return text("l", l, "m", m); }

/// By band: the largest deviation from the golden values of order 20 in `folder`, and of the surface
/// gradients of order 10, each relative to max(1, |golden|). Entries that are infinite there are left out.
/// Empty where the folder has no tables.
template <class Real>
std::vector<double> golden_value_deviation(const std::string& folder, BasisKind kind) {
  const auto directions = golden_directions(folder);
  const HarmonicBasis<Real> basis(20);
  std::vector<Real> v(static_cast<std::size_t>(basis.count()));
  std::vector<double> worst;
  for (const auto& row :
       read_table(folder + (kind == BasisKind::sh ? "/sh" : "/hsh") + "_values_order20.csv")) {
    worst.resize(20);
    const GoldenDirection d = directions.at(row.at("dir"));
    basis.evaluate(kind, static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z), v.data());
    for (int l = 0; l < 20; ++l) {
      for (int m = -l; m <= l; ++m) {
        const double expected = std::stod(row.at(golden_column(l, m)));
        const double got = static_cast<double>(v[static_cast<std::size_t>(harmonic_index(l, m))]);
        double& w = worst[static_cast<std::size_t>(l)];
        w = std::max(w, std::fabs(got - expected) / std::max(1., std::fabs(expected)));
      }
    }
  }
  return worst;
}

template <class Real>
std::vector<double> golden_gradient_deviation(const std::string& folder, BasisKind kind) {
  const auto directions = golden_directions(folder);
  const HarmonicBasis<Real> basis(10);
  const std::size_t n = static_cast<std::size_t>(basis.count());
  std::vector<Real> v(n), g[3] = {v, v, v};
  std::vector<double> worst;
  for (const auto& row :
       read_table(folder + (kind == BasisKind::sh ? "/sh" : "/hsh") + "_gradient_order10.csv")) {
    worst.resize(10);
    const GoldenDirection d = directions.at(row.at("dir"));
    basis.evaluate(kind, static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z), v.data(),
                   g[0].data(), g[1].data(), g[2].data());
    const std::vector<Real>& component = g[row.at("comp")[0] - 'x'];
    for (int l = 0; l < 10; ++l) {
      for (int m = -l; m <= l; ++m) {
        const double expected = std::stod(row.at(golden_column(l, m)));
        if (std::isnan(expected)) continue;
        const double got = static_cast<double>(component[static_cast<std::size_t>(harmonic_index(l, m))]);
        double& w = worst[static_cast<std::size_t>(l)];
        w = std::max(w, std::fabs(got - expected) / std::max(1., std::fabs(expected)));
      }
    }
  }
  return worst;
}

/// By order 1 .. `order`: the largest entry of |B^T W B - I|, how far the basis is from orthonormal.
/// Functions of unlike azimuth (another m) are orthogonal by the uniform azimuths of the quadrature to
/// within the same rounding; they are left out, which makes this O(order^3) per direction.
template <class Real>
std::vector<double> gram_residual(BasisKind kind, int order, const Quadrature& q) {
  const HarmonicBasis<Real> basis(order);
  const std::size_t n = static_cast<std::size_t>(basis.count()), bands = static_cast<std::size_t>(order);
  std::vector<double> gram(n * bands);  // (l, m) with (l', m), l' <= l
  std::vector<Real> out(n);
  for (std::size_t k = 0; k < q.size(); ++k) {
    basis.evaluate(kind, static_cast<Real>(q.x[k]), static_cast<Real>(q.y[k]), static_cast<Real>(q.z[k]),
                   out.data());
    for (int l = 0; l < order; ++l) {
      for (int m = -l; m <= l; ++m) {
        const std::size_t i = static_cast<std::size_t>(harmonic_index(l, m));
        const double weighted = q.weight[k] * static_cast<double>(out[i]);
        for (int lower = std::abs(m); lower <= l; ++lower) {
          gram[i * bands + static_cast<std::size_t>(lower)] +=
              weighted * static_cast<double>(out[static_cast<std::size_t>(harmonic_index(lower, m))]);
        }
      }
    }
  }
  std::vector<double> worst(bands);
  for (int l = 0; l < order; ++l) {
    double& w = worst[static_cast<std::size_t>(l)];
    if (l > 0) w = worst[static_cast<std::size_t>(l - 1)];
    for (int m = -l; m <= l; ++m) {
      const std::size_t row = static_cast<std::size_t>(harmonic_index(l, m)) * bands;
      for (int lower = std::abs(m); lower <= l; ++lower) {
        w = std::max(w, std::fabs(gram[row + static_cast<std::size_t>(lower)] - (lower == l)));
      }
    }
  }
  return worst;
}

}  // namespace phos::test
