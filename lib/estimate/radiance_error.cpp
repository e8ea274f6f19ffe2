#include "estimate/radiance_error.h"

#include <algorithm>
#include <cmath>

#include "hsh/quadrature.h"

namespace phos::inline estimate {
namespace {

/// 1 - mean of P_l(cos) of the angle between two points of a cell of ring `ring`, for each band: the part of
/// a harmonic's square that varies within the cell, since the addition theorem makes P_l of the sum over a
/// band. The map from the hemisphere to the sphere leaves the cells equal in area.
std::vector<double> variation_in_cell(int ring, int rings, int slices, int order) {
  constexpr int kPoints = 6;
  std::vector<double> node, weight, variation(static_cast<std::size_t>(order));
  gauss_legendre(kPoints, node, weight);
  const auto each = [&](const auto& use) {
    for (std::size_t a = 0; a < kPoints; ++a) use(0.5 + 0.5 * node[a], 0.5 * weight[a]);
  };
  each([&](double u, double wu) {
    each([&](double v, double wv) {
      const double z = 1 - 2 * (ring + u) / rings, z2 = 1 - 2 * (ring + v) / rings;
      const double across = std::sqrt((1 - z * z) * (1 - z2 * z2));
      // The difference of two places in a slice is spread as a triangle.
      each([&](double t, double wt) {
        const double cosine = z * z2 + across * std::cos(2 * std::numbers::pi / slices * t);
        const double share = wu * wv * wt * 2 * (1 - t);
        double before = 0, p = 1;
        for (int l = 0; l < order; ++l) {
          variation[static_cast<std::size_t>(l)] += share * (1 - p);
          const double next = ((2 * l + 1) * cosine * p - l * before) / (l + 1);
          before = p, p = next;
        }
      });
    });
  });
  return variation;
}

/// Roots of the variances of the bands, with the noise of the source.
std::vector<float> with_source(const Hemisphere& hemisphere, const std::vector<DVec3>& variance) {
  // What all of the source has in common is as if even light were brighter: of the first band alone.
  const SourceNoise& source = hemisphere.source;
  const DVec3 common = 2 / std::numbers::pi * source.common * source.irradiance * source.irradiance;
  std::vector<float> error;
  for (std::size_t l = 0; l < variance.size(); ++l) {
    const DVec3 read = glm::max(source.per_coefficient + (l == 0 ? common : DVec3(0)), DVec3(0));
    for (int c = 0; c < 3; ++c) error.push_back(static_cast<float>(std::sqrt(variance[l][c] + read[c])));
  }
  return error;
}

}  // namespace

std::vector<float> RadianceError::of(const Hemisphere& hemisphere) {
  const auto order = static_cast<std::size_t>(order_);
  if (!hemisphere.stratified() || hemisphere.measure != Measure::solid)
    return with_source(hemisphere, std::vector<DVec3>(order, DVec3(0)));
  if (rings_ != hemisphere.rings || slices_ != hemisphere.slices) {
    rings_ = hemisphere.rings, slices_ = hemisphere.slices;
    variation_.clear();
    for (int ring = 0; ring < rings_; ++ring)
      variation_.push_back(variation_in_cell(ring, rings_, slices_, order_));
  }
  const double cell_sr = 2 * std::numbers::pi / static_cast<double>(hemisphere.size());
  const std::vector<float> one(hemisphere.size(), 1);
  const DVec3 strata = strata_variance(hemisphere, one);
  std::vector<DVec3> squares;
  for (std::size_t l = 0; l < order; ++l) {
    const double parts = 2 * static_cast<double>(l) + 1;
    squares.push_back(hemisphere.lamps.left_of(strata, 1, hemisphere.size(), parts));
  }
  for (int ring = 0; ring < rings_; ++ring) {
    // Squares of the mean light of cells, from neighbours so that their noise is not in it.
    DVec3 energy(0);
    for (int k = 0; k < slices_; ++k)
      energy += DVec3(hemisphere.radiance[hemisphere.at(ring, k)]) *
                DVec3(hemisphere.radiance[hemisphere.at(ring, k + 1)]);
    for (std::size_t l = 0; l < order; ++l)
      squares[l] += variation_[static_cast<std::size_t>(ring)][l] * energy;
  }
  for (DVec3& rays : squares) rays = cell_sr * cell_sr / (2 * std::numbers::pi) * glm::max(rays, DVec3(0));
  return with_source(hemisphere, squares);
}

}  // namespace phos::inline estimate
