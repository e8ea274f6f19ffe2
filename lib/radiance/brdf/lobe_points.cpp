#include "radiance/brdf/lobe_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "hsh/quadrature.h"

namespace phos::inline radiance {

namespace {

constexpr std::size_t kAcross = 6;  // points across a cell
constexpr std::size_t kPoints = kAcross * kAcross;
/// Energy in the highest coefficients of one cell that is left alone, relative to the whole lobe's.
constexpr double kTolerance = 1e-5;
/// What a scout sees is seen by a cell when one of its points has this share of the value.
constexpr float kSeen = 0.5f;
/// How far outside of a cell, in widths of the cell, a scout still concerns it.
constexpr double kMargin = 0.1;
constexpr std::size_t kMostCells = 4000;
/// Points whose share of the albedo is less than this add nothing that single precision would keep.
constexpr double kNegligible = 0x1p-30;

/// The Gauss-Legendre rule of a cell, and the factors that give the square roots of the energies of its two
/// highest Legendre coefficients from values at its points.
struct Rule {
  std::array<double, kAcross> point, weight;
  std::array<std::array<double, kAcross>, 2> highest;
};

const Rule& rule() {
  static const Rule made = [] {
    Rule r;
    std::vector<double> points, weights;
    gauss_legendre(static_cast<int>(kAcross), points, weights);
    for (std::size_t j = 0; j < kAcross; ++j) {
      r.point[j] = points[j], r.weight[j] = weights[j];
      double previous = 1, current = points[j];  // P_0, P_1
      for (std::size_t l = 1; l < kAcross; ++l) {
        const double degree = static_cast<double>(l);
        if (l + 2 >= kAcross) r.highest[l + 2 - kAcross][j] = std::sqrt(degree + 0.5) * weights[j] * current;
        const double next = ((2 * degree + 1) * points[j] * current - degree * previous) / (degree + 1);
        previous = current, current = next;
      }
    }
    return r;
  }();
  return made;
}

struct Cell {
  double b, phi, half_b, half_phi;  // centre and half widths
  std::size_t first = 0;            // of its points
  double energy = 0;
  double doubt_b = 0, doubt_phi = 0;  // energy of the highest coefficients along b and phi
  bool blind = false;                 // a scout sees more here
};

struct Scout {
  double b, phi;
  float value;  // f cos

  bool at(const Cell& c) const {
    if (std::fabs(b - c.b) > (1 + 2 * kMargin) * c.half_b) return false;
    if (c.b - c.half_b <= 0 && b <= 2 * kMargin * c.half_b) return true;  // the pole has every azimuth
    return std::fabs(std::remainder(phi - c.phi, 2 * std::numbers::pi)) <= (1 + 2 * kMargin) * c.half_phi;
  }
};

/// All points made so far, also the points of halved cells.
class Builder {
 public:
  Builder(const std::function<Rgb(const Vec3&)>& f, std::span<const Vec3> scouts) : f_(f) {
    for (const Vec3& w : scouts) {
      scouts_.push_back({std::acos(std::sqrt(std::clamp(static_cast<double>(w.z), 0.0, 1.0))),
                         std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)),
                         max_magnitude(w.z * f(w))});
    }
  }

  LobePoints build(int order) {
    std::vector<Cell> cells = base(order), next;
    bool resolved = true;
    for (;;) {
      double energy = 0;
      for (const Cell& c : cells) energy += c.energy;
      const double tolerable = kTolerance * energy;
      next.clear();
      bool halved = false;
      for (const Cell& c : cells) {
        const bool doubtful = c.doubt_b + c.doubt_phi > tolerable;
        if ((!doubtful && !c.blind) || !resolved) {
          next.push_back(c);
          continue;
        }
        halve(c, next), halved = true;
      }
      cells.swap(next);
      if (!halved) return collect(cells, resolved);
      if (first_ / kPoints > kMostCells) resolved = false;
    }
  }

 private:
  static float max_magnitude(const Rgb& v) { return max_component(glm::abs(v)); }

  /// Fine enough for the harmonics themselves, one column of cells centred on the first scout.
  std::vector<Cell> base(int order) {
    const int columns = 4 * std::max(2, (order + 4) / 5), rows = columns / 2;
    const double half_b = std::numbers::pi / 4 / rows, half_phi = std::numbers::pi / columns;
    std::vector<Cell> cells;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        cells.push_back(
            fill({(2 * row + 1) * half_b, scouts_.front().phi + 2 * column * half_phi, half_b, half_phi}));
    return cells;
  }

  void halve(const Cell& c, std::vector<Cell>& out) {
    bool split_b = 4 * c.doubt_b >= c.doubt_phi, split_phi = 4 * c.doubt_phi >= c.doubt_b;
    if (c.blind) {
      // The measure of the sphere decides: next to the pole there is nothing to gain from azimuth.
      split_b = true;
      split_phi = std::sin(c.b) * c.half_phi > 0.5 * c.half_b;
    }
    const double half_b = split_b ? c.half_b / 2 : c.half_b;
    const double half_phi = split_phi ? c.half_phi / 2 : c.half_phi;
    for (int i = split_b ? -1 : 0; i <= 1; i += 2) {
      for (int j = split_phi ? -1 : 0; j <= 1; j += 2) {
        out.push_back(fill(
            {c.b + (split_b ? i * half_b : 0), c.phi + (split_phi ? j * half_phi : 0), half_b, half_phi}));
      }
    }
  }

  Cell fill(Cell c) {
    const Rule& r = rule();
    c.first = first_;
    first_ += kPoints;
    std::array<std::array<float, kPoints>, 3> g;  // f cos
    float seen = 0;
    std::array<double, kAcross> cos_phi, sin_phi;
    for (std::size_t k = 0; k < kAcross; ++k) {
      const double phi = c.phi + c.half_phi * r.point[k];
      cos_phi[k] = std::cos(phi), sin_phi[k] = std::sin(phi);
    }
    double measure = 0;
    for (std::size_t j = 0; j < kAcross; ++j) {
      const double b = c.b + c.half_b * r.point[j], cos_b = std::cos(b), sin_b = std::sin(b);
      const double cosine = cos_b * cos_b, sine = sin_b * std::sqrt(1 + cosine);
      const double strip = c.half_b * c.half_phi * 2 * cos_b * sin_b * r.weight[j];
      measure += 2 * strip;
      for (std::size_t k = 0; k < kAcross; ++k) {
        const Vec3 wi(static_cast<float>(sine * cos_phi[k]), static_cast<float>(sine * sin_phi[k]),
                      static_cast<float>(cosine));
        Rgb v = wi.z * f_(wi);
        if (!is_finite(v)) v = Rgb(0), ++points_.rejected;
        const double solid_angle = strip * r.weight[k];
        points_.x.push_back(wi.x), points_.y.push_back(wi.y), points_.z.push_back(wi.z);
        for (std::size_t ch = 0; ch < 3; ++ch) {
          const auto at = static_cast<int>(ch);
          g[ch][kAcross * j + k] = v[at];
          points_.value[ch].push_back(static_cast<float>(static_cast<double>(v[at]) * solid_angle));
          c.energy += static_cast<double>(v[at]) * static_cast<double>(v[at]) * solid_angle;
        }
        seen = std::max(seen, max_magnitude(v));
      }
    }
    for (const auto& channel : g) doubt(c, channel, measure / 4);
    c.blind = std::any_of(scouts_.begin(), scouts_.end(),
                          [&](const Scout& s) { return seen < kSeen * s.value && s.at(c); });
    return c;
  }

  /// Adds one channel's energy in the highest coefficients; `scale` is the cell's solid angle over the area
  /// 4 of the rule.
  static void doubt(Cell& c, const std::array<float, kPoints>& g, double scale) {
    const Rule& r = rule();
    for (std::size_t j = 0; j < kAcross; ++j) {
      for (const auto& mode : r.highest) {
        double along_b = 0, along_phi = 0;
        for (std::size_t k = 0; k < kAcross; ++k) {
          along_b += mode[k] * static_cast<double>(g[kAcross * k + j]);
          along_phi += mode[k] * static_cast<double>(g[kAcross * j + k]);
        }
        c.doubt_b += scale * r.weight[j] * along_b * along_b;
        c.doubt_phi += scale * r.weight[j] * along_phi * along_phi;
      }
    }
  }

  LobePoints collect(const std::vector<Cell>& cells, bool resolved) const {
    LobePoints out;
    out.resolved = resolved, out.rejected = points_.rejected, out.evaluated = points_.size();
    std::array<double, 3> albedo{};
    for (const Cell& c : cells) {
      out.energy += c.energy;
      for (std::size_t i = c.first; i < c.first + kPoints; ++i) {
        for (std::size_t ch = 0; ch < 3; ++ch) {
          const auto v = static_cast<double>(points_.value[ch][i]);
          albedo[ch] += v, out.magnitude += std::fabs(v);
        }
      }
    }
    for (std::size_t ch = 0; ch < 3; ++ch) out.albedo[static_cast<int>(ch)] = static_cast<float>(albedo[ch]);
    const auto negligible = static_cast<float>(kNegligible * out.magnitude);
    for (const Cell& c : cells) {
      for (std::size_t i = c.first; i < c.first + kPoints; ++i) {
        const Rgb v(points_.value[0][i], points_.value[1][i], points_.value[2][i]);
        if (!(max_magnitude(v) > negligible)) continue;
        out.x.push_back(points_.x[i]), out.y.push_back(points_.y[i]), out.z.push_back(points_.z[i]);
        for (std::size_t ch = 0; ch < 3; ++ch) out.value[ch].push_back(points_.value[ch][i]);
      }
    }
    return out;
  }

  const std::function<Rgb(const Vec3&)>& f_;
  std::vector<Scout> scouts_;
  LobePoints points_;
  std::size_t first_ = 0;
};

}  // namespace

LobePoints lobe_points(const std::function<Rgb(const Vec3& wi)>& f, std::span<const Vec3> scouts, int order) {
  PHOS_CHECK(!scouts.empty(), "no scouts");
  return Builder(f, scouts).build(order);
}

}  // namespace phos::inline radiance
