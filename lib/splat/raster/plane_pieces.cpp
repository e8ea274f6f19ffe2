#include "splat/raster/plane_pieces.h"

#include <cmath>

#include "core/error.h"
#include "hsh/quadrature.h"

namespace phos::inline splat {
namespace {

/// Pieces across the plane for each band of the harmonics. At its middle, where pixels are widest, a piece is
/// then 0.6 of 1 / order wide: the mean over it of the last band is told to 2 %.
constexpr double kPiecesPerBand = 6.4;

/// Solid angle of the rectangle [0,x] x [0,y] at height 1. Odd in x and in y.
double corner_solid_sr(double x, double y) { return std::atan(x * y / std::sqrt(1 + x * x + y * y)); }

/// Solid angle below the edge (h, 0) to (h, y), down to the horizon, h = kPlaneHalfSide. At azimuth phi the
/// edge is seen at the height z = cos(phi) / sqrt(cos^2(phi) + h^2), and z dphi lies below.
double below_edge_solid_sr(double y) {
  constexpr double h = kPlaneHalfSide;
  return std::asin(y / std::sqrt((h * h + y * y) * (1 + h * h)));
}

Vec3 towards(double x, double y) { return Vec3(glm::normalize(DVec3(x, y, 1))); }

/// Axes at a direction: itself, down towards the horizon, along the horizon.
glm::dmat3 axes_at(const DVec3& w) {
  const double flat = std::hypot(w.x, w.y);
  const DVec3 along = flat > 0 ? DVec3(-w.y, w.x, 0) / flat : DVec3(0, 1, 0);
  return {w, glm::cross(along, w), along};
}

/// Collects the pieces of one plane.
struct Cutter {
  PlanePieces out;
  int side, cuts;
  double share = 1;                              // of coverage
  std::vector<double> height{}, height_share{};  // Gauss-Legendre on [0, 1]

  std::uint32_t pixel(int row, int column) const { return static_cast<std::uint32_t>(row * side + column); }
  double at(int k, int part) const { return plane_border(k + static_cast<double>(part) / cuts, side); }

  void add(std::uint32_t pixel, const Vec3& direction, double sr, const Mat3& turn) {
    out.pixel.push_back(pixel), out.direction.push_back(direction);
    out.solid_sr.push_back(static_cast<float>(sr)), out.turn.push_back(turn);
  }

  void on_plane(int row, int column) {
    for (int j = 0; j < cuts; ++j) {
      const double y0 = at(row, j), y1 = at(row, j + 1);
      for (int k = 0; k < cuts; ++k) {
        const double x0 = at(column, k), x1 = at(column, k + 1);
        const double sr = corner_solid_sr(x1, y1) - corner_solid_sr(x0, y1) - corner_solid_sr(x1, y0) +
                          corner_solid_sr(x0, y0);
        add(pixel(row, column), towards(0.5 * (x0 + x1), 0.5 * (y0 + y1)), sr / share, Mat3(1));
      }
    }
  }

  /// Side `edge` of the plane, counter-clockwise from x = h: pixel k along it, and a place on it as seen from
  /// above.
  std::uint32_t edge_pixel(int edge, int k) const {
    const int last = side - 1;
    return edge == 0   ? pixel(k, last)
           : edge == 1 ? pixel(last, last - k)
           : edge == 2 ? pixel(last - k, 0)
                       : pixel(0, k);
  }
  static Vec2 turned(int edge, double x, double y) {
    const glm::dvec2 v = edge == 0   ? glm::dvec2(x, y)
                         : edge == 1 ? glm::dvec2(-y, x)
                         : edge == 2 ? glm::dvec2(-x, -y)
                                     : glm::dvec2(y, -x);
    return Vec2(v);
  }

  void below(int edge, int k) {
    constexpr double h = kPlaneHalfSide;
    const std::uint32_t own = edge_pixel(edge, k);
    const double middle_x = plane_border(static_cast<int>(own) % side + 0.5, side),
                 middle_y = plane_border(static_cast<int>(own) / side + 0.5, side);
    const glm::dmat3 from = axes_at(glm::normalize(DVec3(middle_x, middle_y, 1)));
    for (int part = 0; part < cuts; ++part) {
      const double y0 = at(k, part), y1 = at(k, part + 1);
      const double phi0 = std::atan(y0 / h), phi1 = std::atan(y1 / h), phi = 0.5 * (phi0 + phi1);
      const double sr = below_edge_solid_sr(y1) - below_edge_solid_sr(y0), top = sr / (phi1 - phi0);
      const glm::dvec2 azimuth(turned(edge, std::cos(phi), std::sin(phi)));
      for (std::size_t n = 0; n < height.size(); ++n) {
        const double z = top * height[n], flat = std::sqrt(1 - z * z);
        const DVec3 w(flat * azimuth, z);
        add(own, Vec3(w), sr * height_share[n], Mat3(axes_at(w) * glm::transpose(from)));
      }
    }
    if (k == 0) return;
    // The meridian to the pixel before, from the horizon up.
    const double y = at(k, 0), azimuth_angle = std::atan(y / h), rise = std::atan(1 / std::hypot(h, y));
    const Vec2 out_of = turned(edge, std::cos(azimuth_angle), std::sin(azimuth_angle));
    const Vec2 along = turned(edge, -std::sin(azimuth_angle), std::cos(azimuth_angle));
    for (std::size_t n = 0; n < height.size(); ++n) {
      const double e = rise * height[n];
      const auto flat = static_cast<float>(std::cos(e)), z = static_cast<float>(std::sin(e));
      border(edge_pixel(edge, k - 1), own, Vec3(flat * out_of, z),
             static_cast<float>(rise * height_share[n]) * along);
    }
  }

  /// Of pixels, by their first pieces.
  void border(std::uint32_t before, std::uint32_t after, const Vec3& direction, const Vec2& across) {
    const auto pieces = static_cast<std::uint32_t>(cuts * cuts);
    out.borders.push_back({before * pieces, after * pieces, direction, across});
  }

  /// Between a pixel and the pixels before it in its row and in its column. The line x on the plane lies on
  /// the circle of normal (1, 0, -x) / sqrt(1 + x^2).
  void borders_before(int row, int column) {
    for (int part = 0; part < cuts; ++part) {
      const auto line = [&](double x, int k) {
        const double y0 = at(k, part), y1 = at(k, part + 1), r = std::sqrt(1 + x * x);
        return std::pair(0.5 * (y0 + y1), (std::atan(y1 / r) - std::atan(y0 / r)) / r);
      };
      if (column > 0) {
        const double x = at(column, 0);
        const auto [y, across] = line(x, row);
        border(pixel(row, column - 1), pixel(row, column), towards(x, y), Vec2(across, 0));
      }
      if (row > 0) {
        const double y = at(row, 0);
        const auto [x, across] = line(y, column);
        border(pixel(row - 1, column), pixel(row, column), towards(x, y), Vec2(0, across));
      }
    }
  }
};

}  // namespace

void PlanePieces::spread(const Hemisphere& seen, Hemisphere& whole) const {
  whole.frame = seen.frame, whole.measure = Measure::solid;
  whole.rings = whole.slices = 0;
  whole.source = seen.source, whole.lamps = seen.lamps;
  whole.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const std::size_t p = pixel[i];
    whole.direction[i] = seen.frame.to_world(direction[i]);
    whole.radiance[i] = seen.radiance[p], whole.distance_m[i] = seen.distance_m[p];
    whole.hit_normal[i] = seen.frame.to_world(turn[i] * seen.frame.to_local(seen.hit_normal[p]));
    whole.projected_sr[i] = solid_sr[i] * glm::dot(whole.direction[i], seen.frame.z);
  }
}

PlanePieces plane_pieces(int side, RasterBorder border, int order) {
  PHOS_CHECK(side > 0 && order > 0, "side ", side, ", order ", order);
  Cutter cutter{.out = {},
                .side = side,
                .cuts = std::max(1, static_cast<int>(std::ceil(kPiecesPerBand * order / side)))};
  PlanePieces& out = cutter.out;
  out.covered = 4 * corner_solid_sr(kPlaneHalfSide, kPlaneHalfSide) / (2 * std::numbers::pi);
  if (border == RasterBorder::coverage) cutter.share = out.covered;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      cutter.on_plane(row, column);
      cutter.borders_before(row, column);
    }
  if (border == RasterBorder::stretch) {
    gauss_legendre(order / 2 + 2, cutter.height, cutter.height_share);
    for (std::size_t n = 0; n < cutter.height.size(); ++n)
      cutter.height[n] = 0.5 * (1 + cutter.height[n]), cutter.height_share[n] *= 0.5;
    for (int edge = 0; edge < 4; ++edge)
      for (int k = 0; k < side; ++k) cutter.below(edge, k);
  }
  return std::move(cutter.out);
}

}  // namespace phos::inline splat
