#include "hsh/projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace phos::inline hsh {

namespace {

int order_of(std::size_t coefficients) {
  const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficients))));
  if (order < 1 || order > HarmonicBasis<double>::kMaxOrder ||
      coefficients != static_cast<std::size_t>(harmonic_count(order))) {
    throw Error(ExitCode::usage, "",
                text(coefficients, " coefficients are of no order; give a square number, at most ",
                     harmonic_count(HarmonicBasis<double>::kMaxOrder)));
  }
  return order;
}

}  // namespace

std::vector<double> project(const DirectionalFunction& f, BasisKind kind, int order,
                            const Quadrature& quadrature) {
  const HarmonicBasis<double> basis(order);
  const std::size_t count = static_cast<std::size_t>(basis.count());
  std::vector<double> sum(count), values(count);
  for (std::size_t k = 0; k < quadrature.size(); ++k) {
    const double x = quadrature.x[k], y = quadrature.y[k], z = quadrature.z[k];
    const double weighted = f(x, y, z) * quadrature.weight[k];
    if (!std::isfinite(weighted)) {
      throw Error(ExitCode::numerical, "",
                  text("the function to project is not finite in direction (", x, " ", y, " ", z, ")"));
    }
    if (weighted == 0) continue;
    basis.evaluate(kind, x, y, z, values.data());
    for (std::size_t i = 0; i < count; ++i) sum[i] += weighted * values[i];
  }
  return sum;
}

std::vector<double> project_samples(BasisKind kind, int order, std::span<const double> x,
                                    std::span<const double> y, std::span<const double> z,
                                    std::span<const double> value, std::span<const double> pdf,
                                    std::size_t* rejected) {
  const std::size_t n = value.size();
  PHOS_CHECK(x.size() == n && y.size() == n && z.size() == n && pdf.size() == n, "samples: ", n);
  const HarmonicBasis<double> basis(order);
  const std::size_t count = static_cast<std::size_t>(basis.count());
  std::vector<double> sum(count), values(count);
  std::size_t left_out = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double weighted = value[k] / pdf[k];
    if (!(pdf[k] > 0) || !std::isfinite(weighted) || !std::isfinite(x[k]) || !std::isfinite(y[k]) ||
        !std::isfinite(z[k])) {
      ++left_out;
      continue;
    }
    if (weighted == 0) continue;
    basis.evaluate(kind, x[k], y[k], z[k], values.data());
    for (std::size_t i = 0; i < count; ++i) sum[i] += weighted * values[i];
  }
  if (n > 0) {
    for (double& c : sum) c /= static_cast<double>(n);
  }
  if (rejected) *rejected = left_out;
  return sum;
}

double reconstruct(std::span<const double> coefficients, BasisKind kind, double x, double y, double z) {
  const HarmonicBasis<double> basis(order_of(coefficients.size()));
  std::vector<double> values(coefficients.size());
  basis.evaluate(kind, x, y, z, values.data());
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += coefficients[i] * values[i];
  return sum;
}

std::vector<double> energy_by_band(std::span<const double> coefficients) {
  std::vector<double> energy(static_cast<std::size_t>(order_of(coefficients.size())));
  for (std::size_t l = 0; l < energy.size(); ++l) {
    for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) energy[l] += coefficients[i] * coefficients[i];
  }
  return energy;
}

std::vector<double> error_by_order(std::span<const double> coefficients, double energy) {
  std::vector<double> error = energy_by_band(coefficients);
  double kept = 0;
  for (double& band : error) {
    kept += band;
    band = energy > 0 ? std::max(0., 1 - kept / energy) : 0;
  }
  return error;
}

void apply_window(Window window, std::span<double> coefficients) {
  const std::size_t order = static_cast<std::size_t>(order_of(coefficients.size()));
  if (window == Window::none) return;
  for (std::size_t l = 1; l < order; ++l) {
    const double angle = std::numbers::pi * static_cast<double>(l) / static_cast<double>(order);
    const double weight = window == Window::hann ? 0.5 * (1 + std::cos(angle)) : std::sin(angle) / angle;
    for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) coefficients[i] *= weight;
  }
}

}  // namespace phos::inline hsh
