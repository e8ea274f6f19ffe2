#include "scene/opening/rectified_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "core/sampling.h"

namespace phos::inline scene {
namespace {

constexpr int kCells = 512, kRow = kCells + 1;
constexpr double kHalfTurn = std::numbers::pi, kCell_rad = kHalfTurn / kCells;
/// No cell is taken for darker than this part of the map's mean.
constexpr double kLeastLuminance = 0.02;
/// Directions closer to the plane than this, as cosines, belong to its edge.
constexpr double kLeastCosine = 1e-9;
constexpr int kBisections = 9;  // of kCells

std::size_t at(int column, int row) {
  return static_cast<std::size_t>(row) * kRow + static_cast<std::size_t>(column);
}

/// A place in cells, from an angle.
double cells_of(double angle_rad) {
  return std::clamp((angle_rad + kHalfTurn / 2) / kCell_rad, 0.0, static_cast<double>(kCells));
}

double angle_of(double cells) { return cells * kCell_rad - kHalfTurn / 2; }

/// Solid angle over d alpha d beta.
double sr_of(double u, double v) {
  const double u2 = u * u, v2 = v * v, s = 1 + u2 + v2;
  return (1 + u2) * (1 + v2) / (s * std::sqrt(s));
}

/// Solid angle of directions with x / y and z / y between 0 and u, v.
double corner_sr(double u, double v) { return std::atan2(u * v, std::sqrt(1 + u * u + v * v)); }

double cell_sr(int column, int row) {
  const auto tangent = [](int k) {
    return std::tan(std::clamp(angle_of(k), -kHalfTurn / 2 + 1e-9, kHalfTurn / 2 - 1e-9));
  };
  const double u[2] = {tangent(column), tangent(column + 1)}, v[2] = {tangent(row), tangent(row + 1)};
  return std::max(
      corner_sr(u[1], v[1]) - corner_sr(u[0], v[1]) - corner_sr(u[1], v[0]) + corner_sr(u[0], v[0]), 0.0);
}

double luminous(const Rgb& c) { return static_cast<double>(luminance(c)); }

/// The cell [k, k + 1] in which a function that does not fall, over cells lo to hi, reaches a value.
template <class Function>
int cell_where(const Function& function, int lo, int hi, double value) {
  for (int k = 0; k < kBisections + 1 && hi - lo > 1; ++k) {
    const int middle = (lo + hi) / 2;
    (function(middle) > value ? hi : lo) = middle;
  }
  return lo;
}

/// Where between lo and hi, within one cell or over several, a function that is linear within cells reaches
/// `part` of the way from its value at lo to its value at hi.
template <class Function>
double place_where(const Function& function, double lo, double hi, double part) {
  const double from = function(lo), value = from + part * (function(hi) - from);
  const int first = static_cast<int>(std::floor(lo)), last = static_cast<int>(std::ceil(hi));
  const int cell = cell_where([&](int k) { return function(std::clamp(static_cast<double>(k), lo, hi)); },
                              first, last, value);
  const double a = std::max(static_cast<double>(cell), lo), b = std::min(static_cast<double>(cell + 1), hi);
  const double fa = function(a), fb = function(b);
  return fb > fa ? std::clamp(a + (value - fa) / (fb - fa) * (b - a), a, b) : 0.5 * (a + b);
}

}  // namespace

RectifiedMap::RectifiedMap(const Environment& light, const Axes& axes)
    : axes_(axes), sum_(static_cast<std::size_t>(kRow) * kRow, 0) {
  const double mean_cd_m2 = light.map_lx() / (4 * kHalfTurn);
  const double spot_cd_m2 = 4 * mean_cd_m2;
  std::vector<double> cell_lx(static_cast<std::size_t>(kCells) * kCells);
  parallel_for(kCells, 8, [&](std::size_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < kCells; ++i) {
      const double u = std::tan(angle_of(i + 0.5)), v = std::tan(angle_of(j + 0.5));
      const Vec3 direction(glm::normalize(u * axes_.x + axes_.y + v * axes_.z));
      const double cd_m2 =
          std::clamp(luminous(light.map_luminance(direction)), kLeastLuminance * mean_cd_m2, spot_cd_m2);
      cell_lx[row * kCells + static_cast<std::size_t>(i)] = cd_m2 * cell_sr(i, j);
    }
  });
  for (int j = 0; j < kCells; ++j) {
    double along = 0;
    for (int i = 0; i < kCells; ++i) {
      along += cell_lx[static_cast<std::size_t>(j) * kCells + static_cast<std::size_t>(i)];
      sum_[at(i + 1, j + 1)] = sum_[at(i + 1, j)] + along;
    }
  }
}

RectifiedMap::Box RectifiedMap::box(const DVec3& to_corner, const DVec3& to_opposite) const {
  const double y = glm::dot(to_corner, axes_.y);
  Box box;
  if (!(y > 0)) return box;
  const auto ends = [&](const DVec3& axis, double(&angle)[2]) {
    const double a = std::atan2(glm::dot(to_corner, axis), y), b = std::atan2(glm::dot(to_opposite, axis), y);
    angle[0] = std::min(a, b), angle[1] = std::max(a, b);
  };
  ends(axes_.x, box.alpha), ends(axes_.z, box.beta);
  return box;
}

bool RectifiedMap::holds(const Box& box, const Vec3& direction) const {
  const DVec3 d(direction);
  const double y = glm::dot(d, axes_.y);
  if (!(y > kLeastCosine)) return false;
  const double alpha = std::atan2(glm::dot(d, axes_.x), y), beta = std::atan2(glm::dot(d, axes_.z), y);
  return alpha >= box.alpha[0] && alpha <= box.alpha[1] && beta >= box.beta[0] && beta <= box.beta[1];
}

/// Of all that lies below, in cells: the table, linear between its entries.
double RectifiedMap::sum(double alpha, double beta) const {
  const int i = std::min(static_cast<int>(alpha), kCells - 1),
            j = std::min(static_cast<int>(beta), kCells - 1);
  const double s = alpha - i, t = beta - j;
  return (1 - t) * ((1 - s) * sum_[at(i, j)] + s * sum_[at(i + 1, j)]) +
         t * ((1 - s) * sum_[at(i, j + 1)] + s * sum_[at(i + 1, j + 1)]);
}

double RectifiedMap::light_lx(const Box& box) const {
  const double a0 = cells_of(box.alpha[0]), a1 = cells_of(box.alpha[1]), b0 = cells_of(box.beta[0]),
               b1 = cells_of(box.beta[1]);
  return std::max(sum(a1, b1) - sum(a0, b1) - sum(a1, b0) + sum(a0, b0), 0.0);
}

Vec3 RectifiedMap::sample(const Box& box, const Vec2& u) const {
  const double a0 = cells_of(box.alpha[0]), a1 = cells_of(box.alpha[1]), b0 = cells_of(box.beta[0]),
               b1 = cells_of(box.beta[1]);
  const double alpha =
      place_where([&](double a) { return sum(a, b1) - sum(a, b0); }, a0, a1, static_cast<double>(u.x));
  // Within a column of cells all is constant along alpha.
  const double left = std::min(std::floor(alpha), kCells - 1.0);
  const double beta = place_where([&](double b) { return sum(left + 1, b) - sum(left, b); }, b0, b1,
                                  static_cast<double>(u.y));
  const auto tangent = [](double cells, const double(&within)[2]) {
    return std::tan(std::clamp(angle_of(cells), within[0], within[1]));
  };
  return Vec3(
      glm::normalize(tangent(alpha, box.alpha) * axes_.x + axes_.y + tangent(beta, box.beta) * axes_.z));
}

double RectifiedMap::density(double light_lx, const Vec3& direction) const {
  const DVec3 d(direction);
  const double y = std::max(glm::dot(d, axes_.y), kLeastCosine), x = glm::dot(d, axes_.x),
               z = glm::dot(d, axes_.z);
  const int i = std::min(static_cast<int>(cells_of(std::atan2(x, y))), kCells - 1),
            j = std::min(static_cast<int>(cells_of(std::atan2(z, y))), kCells - 1);
  const double cell_lx = sum_[at(i + 1, j + 1)] - sum_[at(i, j + 1)] - sum_[at(i + 1, j)] + sum_[at(i, j)];
  return cell_lx / (kCell_rad * kCell_rad * sr_of(x / y, z / y) * light_lx);
}

}  // namespace phos::inline scene
