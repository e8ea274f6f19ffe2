#include "scene/luminaire/photometry.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/sampling.h"
#include "file/hash.h"

namespace phos::inline scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Wider steps of the polar angle are divided (the interpolant stays the same), so that the series below hold
/// to the last digits.
constexpr double kWidestStep_rad = 0.25;

/// For |x| <= kWidestStep_rad. Unlike the C library's the same bits on every machine: samples decide paths.
struct SmallAngle {
  double sine, versine;  // sin x, 1 - cos x
  double sine_moment;    // integral of t cos t from 0 to x: cos x + x sin x - 1
  double cosine_moment;  // integral of t sin t from 0 to x: sin x - x cos x
};
SmallAngle small_angle(double x) {
  const double y = x * x;
  return {x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110))))),
          y / 2 * (1 - y / 12 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90)))),
          y / 2 * (1 - y / 4 * (1 - y / 18 * (1 - y / 40 * (1 - y / 70)))),
          x * y / 3 * (1 - y / 10 * (1 - y / 28 * (1 - y / 54 * (1 - y / 88))))};
}

/// Integral of (first + slope t) sin(start + t) dt from 0 to x.
double cell_integral(double first, double slope, double sin_start, double cos_start, double x) {
  const SmallAngle s = small_angle(x);
  return first * (sin_start * s.sine + cos_start * s.versine) +
         slope * (sin_start * s.sine_moment + cos_start * s.cosine_moment);
}

/// x in [0, width] up to which that integral is `target`, by Newton's steps kept in a bracket.
double invert_cell(double first, double slope, double sin_start, double cos_start, double width,
                   double target) {
  double low = 0, high = width, x = 0.5 * width;
  for (int step = 0; step < 60; ++step) {
    const double error = cell_integral(first, slope, sin_start, cos_start, x) - target;
    (error > 0 ? high : low) = x;
    const SmallAngle s = small_angle(x);
    const double rate = (first + slope * x) * (sin_start * (1 - s.versine) + cos_start * s.sine);
    double next = rate > 0 ? x - error / rate : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::fabs(next - x) <= 1e-12 * width) return next;
    x = next;
  }
  return x;
}

void set_axes(PhotometricGrid::Poles poles, Vec3& a0, Vec3& a1, Vec3& pole) {
  switch (poles) {
    case PhotometricGrid::Poles::c:
      a0 = {1, 0, 0}, a1 = {0, 1, 0}, pole = {0, 0, -1};
      return;
    case PhotometricGrid::Poles::b:
      a0 = {0, 0, -1}, a1 = {1, 0, 0}, pole = {0, 1, 0};
      return;
    case PhotometricGrid::Poles::a:
      a0 = {0, 0, -1}, a1 = {0, -1, 0}, pole = {-1, 0, 0};
      return;
  }
}

void check_nodes(const std::vector<double>& deg, const char* which) {
  PHOS_CHECK(deg.size() >= 2, deg.size(), " ", which, " angles");
  for (std::size_t i = 1; i < deg.size(); ++i)
    PHOS_CHECK(deg[i] >= deg[i - 1] + kLeastStep_deg, which, " angles ", deg[i - 1], " and ", deg[i]);
}

/// Nodes by which steps are at most kWidestStep_rad: each at a share between two of the grid's.
struct Node {
  double rad;
  std::size_t before;
  double share;
};
std::vector<Node> divided(const std::vector<double>& deg, bool horizontal) {
  std::vector<Node> nodes;
  for (std::size_t j = 0; j + 1 < deg.size(); ++j) {
    const double from = deg[j], step = deg[j + 1] - deg[j];
    std::vector<double> shares{0};
    const int parts = static_cast<int>(std::ceil(step * kDegree / kWidestStep_rad * (1 - 1e-9)));
    for (int k = 1; k < parts; ++k) shares.push_back(static_cast<double>(k) / parts);
    if (horizontal && from + 0.5 * kLeastStep_deg < 90 && from + step > 90 + 0.5 * kLeastStep_deg)
      shares.push_back((90 - from) / step);
    std::sort(shares.begin(), shares.end());
    const auto same = [&](double a, double b) { return (b - a) * step < 0.5 * kLeastStep_deg; };
    shares.erase(std::unique(shares.begin(), shares.end(), same), shares.end());
    for (const double share : shares) nodes.push_back({(from + share * step) * kDegree, j, share});
  }
  nodes.push_back({deg.back() * kDegree, deg.size() - 2, 1});
  return nodes;
}

}  // namespace

Photometry::Photometry(const PhotometricGrid& grid) {
  check_nodes(grid.azimuth_deg, "azimuth"), check_nodes(grid.polar_deg, "polar");
  const std::size_t planes = grid.azimuth_deg.size(), rows = grid.polar_deg.size();
  PHOS_CHECK(grid.candela.size() == planes * rows, grid.candela.size(), " values, ", planes, " x ", rows);
  PHOS_CHECK(grid.polar_deg.front() >= 0 && grid.polar_deg.back() <= 180, "polar angles");
  const double span_deg = grid.azimuth_deg.back() - grid.azimuth_deg.front();
  PHOS_CHECK(span_deg <= 360, "azimuths over ", span_deg);
  closed_ = span_deg == 360;
  set_axes(grid.poles, a0_, a1_, pole_);
  for (const double deg : grid.azimuth_deg) azimuth_rad_.push_back(static_cast<float>(deg * kDegree));
  const std::vector<Node> nodes = divided(grid.polar_deg, grid.poles == PhotometricGrid::Poles::c);
  for (const Node& node : nodes) polar_rad_.push_back(static_cast<float>(node.rad));
  rotational_ = closed_ && grid.poles == PhotometricGrid::Poles::c;
  for (std::size_t i = 0; i < planes; ++i) {
    const float* row = grid.candela.data() + i * rows;
    for (std::size_t j = 0; j < rows; ++j) {
      PHOS_CHECK(row[j] >= 0 && std::isfinite(row[j]), "intensity ", row[j]);
      rotational_ = rotational_ && row[j] == grid.candela[j];
    }
    for (const Node& node : nodes) {
      const double a = row[node.before], b = row[node.before + 1];
      candela_.push_back(static_cast<float>(node.share < 1 ? a + node.share * (b - a) : b));
    }
  }
  integrate();
  find_peak();
  Hasher hasher;
  hasher.add(grid.poles);
  hasher.add_span(std::span<const float>(azimuth_rad_));
  hasher.add_span(std::span<const float>(polar_rad_));
  hasher.add_span(std::span<const float>(candela_));
  hash_ = hasher.finish().hex();
}

void Photometry::integrate() {
  const std::size_t rows = polar_rad_.size();
  below_.assign(candela_.size(), 0);
  double down_lm = 0;
  std::vector<double> per_rad(azimuth_rad_.size(), 0), down_per_rad(azimuth_rad_.size(), 0);
  for (std::size_t i = 0; i < azimuth_rad_.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j + 1 < rows; ++j) {
      const double from = polar_rad_[j], width = static_cast<double>(polar_rad_[j + 1]) - from;
      const double first = at(i, j), slope = (static_cast<double>(at(i, j + 1)) - first) / width;
      const double part = cell_integral(first, slope, std::sin(from), std::cos(from), width);
      // With the pole straight down the horizontal is at half a turn of the polar angle, and a node.
      const bool down = pole_.z == 0 || from + 0.5 * width < 0.5 * std::numbers::pi;
      sum += part;
      if (down) down_per_rad[i] += part;
      below_[i * rows + j + 1] = sum;
    }
    per_rad[i] = sum;
  }
  azimuth_cdf_.assign(1, 0);
  for (std::size_t i = 0; i + 1 < azimuth_rad_.size(); ++i) {
    const double from = azimuth_rad_[i], to = azimuth_rad_[i + 1];
    flux_lm_ += 0.5 * (to - from) * (per_rad[i] + per_rad[i + 1]);
    azimuth_cdf_.push_back(flux_lm_);
    // With a horizontal pole azimuths are counted from straight down.
    if (pole_.z != 0 || std::cos(0.5 * (from + to)) > 0)
      down_lm += 0.5 * (to - from) * (down_per_rad[i] + down_per_rad[i + 1]);
  }
  downward_share_ = flux_lm_ > 0 ? std::min(1.0, down_lm / flux_lm_) : 0;
}

void Photometry::find_peak() {
  const auto peak =
      static_cast<std::size_t>(std::max_element(candela_.begin(), candela_.end()) - candela_.begin());
  const std::size_t i = peak / polar_rad_.size(), j = peak % polar_rad_.size();
  peak_cd_ = candela_[peak];
  const double polar = polar_rad_[j];
  peak_direction_ = direction(azimuth_rad_[i], std::cos(polar), std::sin(polar));
}

Vec3 Photometry::direction(double azimuth_rad, double cos_polar, double sin_polar) const {
  double turns = azimuth_rad / (2 * std::numbers::pi);
  turns -= std::floor(turns);
  const Vec2 c = cos_sin(static_cast<float>(turns));
  const auto s = static_cast<float>(sin_polar);
  return normalized_or_zero(s * c.x * a0_ + s * c.y * a1_ + static_cast<float>(cos_polar) * pole_);
}

std::size_t Photometry::interval(const std::vector<float>& nodes, float x) {
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  return static_cast<std::size_t>(above - nodes.begin()) - 1;
}

float Photometry::candela(const Vec3& d) const {
  const float x = glm::dot(d, a0_), y = glm::dot(d, a1_);
  const float polar = std::atan2(std::sqrt(x * x + y * y), glm::dot(d, pole_));
  if (!(polar >= polar_rad_.front() && polar <= polar_rad_.back())) return 0;
  const std::size_t j = interval(polar_rad_, polar);
  const float v = (polar - polar_rad_[j]) / (polar_rad_[j + 1] - polar_rad_[j]);
  const auto in_plane = [&](std::size_t i) { return at(i, j) + v * (at(i, j + 1) - at(i, j)); };
  if (rotational_) return in_plane(0);
  float azimuth = std::atan2(y, x);
  while (azimuth < azimuth_rad_.front()) azimuth += 2 * kPi;
  while (azimuth > azimuth_rad_.front() + 2 * kPi) azimuth -= 2 * kPi;
  if (azimuth > azimuth_rad_.back()) {
    if (!closed_) return 0;
    azimuth = azimuth_rad_.back();  // by rounding
  }
  const std::size_t i = interval(azimuth_rad_, azimuth);
  const float u = (azimuth - azimuth_rad_[i]) / (azimuth_rad_[i + 1] - azimuth_rad_[i]);
  const float a = in_plane(i);
  return std::max(0.f, a + u * (in_plane(i + 1) - a));
}

Vec3 Photometry::sample(const Vec2& u) const {
  const std::size_t rows = polar_rad_.size();
  const double x = static_cast<double>(u.x) * flux_lm_;
  const auto above = std::upper_bound(azimuth_cdf_.begin() + 1, azimuth_cdf_.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - azimuth_cdf_.begin()) - 1;
  // Flux per radian of azimuth is linear between planes.
  const double f0 = below_[(i + 1) * rows - 1], f1 = below_[(i + 2) * rows - 1];
  const double width = static_cast<double>(azimuth_rad_[i + 1]) - static_cast<double>(azimuth_rad_[i]);
  const double rest = std::max(0.0, x - azimuth_cdf_[i]) / width;
  const double root = f0 + std::sqrt(std::max(0.0, f0 * f0 + 2 * rest * (f1 - f0)));
  const double share = root > 0 ? std::min(1.0, 2 * rest / root) : 0.5;
  // So is, at any polar angle, the intensity; and the flux up to that angle.
  const auto mixed = [&](const auto& of, std::size_t j) {
    const double a = of[i * rows + j], b = of[(i + 1) * rows + j];
    return a + share * (b - a);
  };
  const double target = static_cast<double>(u.y) * mixed(below_, rows - 1);
  std::size_t low = 0, high = rows - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (mixed(below_, middle) <= target ? low : high) = middle;
  }
  const double from = polar_rad_[low], step = static_cast<double>(polar_rad_[low + 1]) - from;
  const double first = mixed(candela_, low), slope = (mixed(candela_, low + 1) - first) / step;
  const double sin_from = std::sin(from), cos_from = std::cos(from);
  const double part = target - mixed(below_, low);
  const SmallAngle s = small_angle(invert_cell(first, slope, sin_from, cos_from, step, part));
  return direction(static_cast<double>(azimuth_rad_[i]) + share * width,
                   cos_from * (1 - s.versine) - sin_from * s.sine,
                   std::max(0.0, sin_from * (1 - s.versine) + cos_from * s.sine));
}

bool Photometry::shines_towards(const Vec3& axis) const {
  constexpr float kAbove = 1e-5f;  // more than the rounding of a direction in the plane
  const std::size_t rows = polar_rad_.size();
  const auto mean = [](float a, float b) { return 0.5 * (static_cast<double>(a) + static_cast<double>(b)); };
  for (std::size_t i = 0; i + 1 < azimuth_rad_.size(); ++i) {
    const double from = azimuth_rad_[i], to = azimuth_rad_[i + 1];
    const int parts = 2 * (1 + static_cast<int>((to - from) / kWidestStep_rad));
    for (std::size_t j = 0; j + 1 < rows; ++j) {
      if (!(at(i, j) > 0 || at(i, j + 1) > 0 || at(i + 1, j) > 0 || at(i + 1, j + 1) > 0)) continue;
      // Corners, middles of edges and of the cell; of a wide one, of its parts.
      for (const double polar : {static_cast<double>(polar_rad_[j]), mean(polar_rad_[j], polar_rad_[j + 1]),
                                 static_cast<double>(polar_rad_[j + 1])}) {
        for (int k = 0; k <= parts; ++k) {
          const Vec3 d = direction(from + (to - from) * k / parts, std::cos(polar), std::sin(polar));
          if (glm::dot(d, axis) > kAbove) return true;
        }
      }
    }
  }
  return false;
}

Vec3 c_gamma_direction(double c_deg, double gamma_deg) {
  const double c = c_deg * kDegree, gamma = gamma_deg * kDegree;
  return Vec3(DVec3(std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)));
}

BeamAngles beam_angles(const Photometry& photometry, double c_deg) {
  // Quarter degrees, linear between them: finer than any goniophotometer steps.
  constexpr int kSteps = 720;  // from -180 to 180
  std::vector<double> cd(2 * kSteps + 1);
  double most = 0, up = 0, down = 0;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double v = photometry.candela(c_gamma_direction(c_deg, 180.0 * k / kSteps));
    cd[static_cast<std::size_t>(k + kSteps)] = v;
    most = std::max(most, v);
    double& side = 2 * std::abs(k) > kSteps ? up : down;
    side = std::max(side, v);
  }
  if (!(most > 0)) return {};
  if (up > down) std::rotate(cd.begin(), cd.begin() + kSteps, cd.end() - 1), cd.back() = cd.front();
  const auto whole = [&](double level) {
    // Outermost within the half-space that it mostly shines into, and on from there as long as it is lit.
    std::size_t first = kSteps / 2, last = 3 * kSteps / 2;
    while (cd[first] < level) ++first;
    while (cd[last] < level) --last;
    while (first > 0 && cd[first - 1] >= level) --first;
    while (last + 1 < cd.size() && cd[last + 1] >= level) ++last;
    double from = static_cast<double>(first), to = static_cast<double>(last);
    if (first > 0) from -= (cd[first] - level) / (cd[first] - cd[first - 1]);
    if (last + 1 < cd.size()) to += (cd[last] - level) / (cd[last] - cd[last + 1]);
    return (to - from) * 180 / kSteps;
  };
  return {whole(0.5 * most), whole(0.1 * most)};
}

}  // namespace phos::inline scene
