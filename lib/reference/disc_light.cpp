#include "reference/disc_light.h"

#include <algorithm>
#include <cmath>

namespace phos::inline reference {
namespace {

/// Differences between radii up to so many standard deviations are noise: one of some twenty comparisons may
/// well be two apart, and would leave the light to a few paths.
constexpr double kNoise = 2.5;
/// Radii with fewer expected paths tell nothing.
constexpr double kLeastPaths = 8;
/// The part of the square of such a difference that is taken as noise: so many variances. Of light that is
/// even, straight, curved, a peak, a strip, and beside edges, 92 to 100 % lay within two errors.
constexpr double kTaken = 0.5;
/// So many smaller radii tell the bias.
constexpr std::size_t kDoubting = 4;

double grey(const DVec3& c) { return static_cast<double>(luminance(Rgb(c))); }

}  // namespace

DiscLight::DiscLight(const std::array<double, kDiscRadii>& area_m2) {
  for (const double area : area_m2) {
    if (!(area > 0)) break;
    rows_.emplace_back().area_m2 = area;
  }
  if (rows_.empty()) rows_.emplace_back();
}

void DiscLight::add(const DVec3& rest, const DiscPass& disc) {
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    Row& row = rows_[j];
    for (int c = 0; c < 3; ++c) row.disc[c].add(disc.lux[j][c]), row.all[c].add(rest[c] + disc.lux[j][c]);
    row.disc[kLuminance].add(grey(disc.lux[j]));
    row.all[kLuminance].add(grey(rest + disc.lux[j]));
    row.paths += disc.paths[j];
  }
}

/// Of the disc's light within a radius, where so many paths are expected, each with the mean flux of all: no
/// less than of one path. What passes scatter is the noise where it is more.
double DiscLight::noise_lx(std::size_t j, double paths) const {
  const Row &all = rows_[0], &row = rows_[j];
  const double one = all.disc[kLuminance].mean() * all.area_m2 / static_cast<double>(all.paths);
  return std::max(row.disc[kLuminance].standard_error(), one * std::sqrt(std::max(1.0, paths)) / row.area_m2);
}

/// Within one radius, if the light is the light within another radius.
double DiscLight::expected_paths(std::size_t of, std::size_t within) const {
  return static_cast<double>(rows_[of].paths) * rows_[within].area_m2 / rows_[of].area_m2;
}

std::size_t DiscLight::chosen() const {
  const std::size_t last = rows_.size() - 1;
  for (std::size_t j = 0; j < last; ++j) {
    const double lux = rows_[j].disc[kLuminance].mean();
    bool alike = true;
    for (std::size_t k = j + 1; k <= last && alike && expected_paths(j, k) >= kLeastPaths; ++k)
      alike = std::fabs(lux - rows_[k].disc[kLuminance].mean()) <= kNoise * noise_lx(k, expected_paths(j, k));
    if (alike) return j;
  }
  return last;
}

DiscLight::Estimate DiscLight::estimate() const {
  std::size_t j = 0;
  double doubt2 = 0;  // of luminance, lx^2
  if (rows_[0].paths > 0) {
    j = chosen();
    const double lux = rows_[j].disc[kLuminance].mean();
    if (rows_[j].paths == 0) doubt2 = noise_lx(j, 0) * noise_lx(j, 0);
    const std::size_t end = std::min(j + 1 + kDoubting, rows_.size());
    for (std::size_t k = j + 1; k < end && expected_paths(j, k) >= kLeastPaths; ++k) {
      // A bias in proportion to the area is seen less by as much as the smaller area has of the larger.
      const double seen = 1 - rows_[k].area_m2 / rows_[j].area_m2;
      const double off = lux - rows_[k].disc[kLuminance].mean(), noise = noise_lx(k, expected_paths(j, k));
      doubt2 = std::max(doubt2, (off * off - kTaken * noise * noise) / (seen * seen));
    }
  }
  const Row& row = rows_[j];
  const double disc_lx = row.disc[kLuminance].mean();
  Estimate e;
  for (int c = 0; c < 3; ++c) {
    const double share = disc_lx > 0 ? row.disc[c].mean() / disc_lx : 1;
    e.lux[c] = row.all[c].mean();
    e.error[c] = std::hypot(row.all[c].standard_error(), share * std::sqrt(doubt2));
  }
  e.illuminance_lx = row.all[kLuminance].mean();
  e.stderr_lx = std::hypot(row.all[kLuminance].standard_error(), std::sqrt(doubt2));
  return e;
}

}  // namespace phos::inline reference
