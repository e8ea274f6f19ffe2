#include "photon/density.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace phos::inline photon {
namespace {

constexpr double kLeastHull = 1e-9;      // of R^2: below it the hull is degenerate
constexpr double kLeastCoverage = 0.25;  // of the hull by surface (docs/methods.md#c2)
constexpr int kNarrow = 8;               // a surface that fills less than 1/8 of its zone
constexpr int kSectors = 8;
constexpr int kCells = 2 * kSectors;  // two rings of equal area
constexpr double kPiD = std::numbers::pi;
using Cells = std::array<double, kCells>;

/// One of 16 cells of equal area.
int cell_of(const Vec2& p, float radius_m) {
  const int ring = glm::dot(p, p) * 2 > radius_m * radius_m ? 1 : 0;
  // Octant from signs and the larger coordinate: no arc tangent.
  const int sector = (p.x < 0 ? 1 : 0) + (p.y < 0 ? 2 : 0) + (std::fabs(p.x) < std::fabs(p.y) ? 4 : 0);
  return ring * kSectors + sector;
}

Cells count_cells(std::span<const Vec2> offsets_m, float radius_m) {
  Cells cells{};
  for (const Vec2& p : offsets_m) cells[static_cast<std::size_t>(cell_of(p, radius_m))] += 1;
  return cells;
}

/// Can surface be missing from the zone, as far as the counts tell? Always yes for fewer photons than can
/// tell.
bool in_doubt(const Cells& counts, std::size_t photons) {
  const double mean = static_cast<double>(photons) / kCells;
  if (mean <= 9) return true;
  return *std::min_element(counts.begin(), counts.end()) < mean - 3 * std::sqrt(mean);
}

/// Direction of the i-th probe: a sunflower.
glm::dvec2 sunflower(int i) {
  static const auto first = [] {
    std::array<glm::dvec2, 128> directions;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double t = static_cast<double>(k) * 2.399963229728653;
      directions[k] = {std::cos(t), std::sin(t)};
    }
    return directions;
  }();
  if (static_cast<std::size_t>(i) < first.size()) return first[static_cast<std::size_t>(i)];
  const double t = i * 2.399963229728653;
  return {std::cos(t), std::sin(t)};
}

/// The i-th of n probes, equal area each.
Vec2 probe_offset(int i, int n, float radius_m) {
  return Vec2(std::sqrt((i + 0.5) / n) * sunflower(i)) * radius_m;
}

/// A few probes, most near the rim, where a border that cuts the zone shows first.
bool whole(float radius_m, const OnSurface& on_surface) {
  if (!on_surface) return true;
  constexpr int kRim = 24, kInner = 8;
  for (int i = 0; i < kRim + kInner; ++i) {
    const float r = i < kRim ? 0.93f : 0.5f, t = 2 * kPi * static_cast<float>(i) / (i < kRim ? kRim : kInner);
    if (!on_surface(radius_m * r * Vec2(std::cos(t), std::sin(t)))) return false;
  }
  return true;
}

struct Edge {
  double h = 1;  ///< signed distance of the centre, in radii; positive inside
  Vec2 outward{1, 0};
};

bool inside_hull(const Hull& hull, std::span<const Vec2> points, const Vec2& q) {
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    const Vec2 a = points[hull.vertices[i]], b = points[hull.vertices[(i + 1) % hull.vertices.size()]];
    if ((b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x) < 0) return false;
  }
  return true;
}

Edge nearest_edge(const Hull& hull, std::span<const Vec2> points, float radius_m) {
  Edge nearest;
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    const glm::dvec2 a(points[hull.vertices[i]]), b(points[hull.vertices[(i + 1) % hull.vertices.size()]]);
    const glm::dvec2 along = b - a;
    const double length = glm::length(along);
    if (!(length > 0)) continue;
    const glm::dvec2 outward = glm::dvec2(along.y, -along.x) / length;
    const double h = glm::dot(outward, a) / static_cast<double>(radius_m);
    if (h < nearest.h) nearest = {h, Vec2(outward)};
  }
  return nearest;
}

/// What the probes found, over the zone and over the hull.
struct Coverage {
  double zone = 1, hull = 1;  ///< fractions on the surface
  bool zone_partial = false, hull_partial = false;
  Vec2 zone_centroid{0}, hull_centroid{0};
  int probes = 1;
  bool hull_known = false;  ///< enough probes fell in the hull
  double cap_share = 1;     ///< of the cap, on the surface
  Cells hull_cells{};       ///< per cell, share of its probes in the hull and on the surface
};

Coverage probe(std::span<const Vec2> points, const Hull& hull, const Edge& edge, float radius_m,
               const OnSurface& on_surface, int n, std::vector<std::uint8_t>& covered) {
  Coverage c;
  Cells total{};
  int on = 0, in_hull = 0, on_hull = 0, in_cap = 0, on_cap = 0;
  covered.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const Vec2 q = probe_offset(i, n, radius_m);
    const bool hit = !on_surface || on_surface(q);
    covered[static_cast<std::size_t>(i)] = hit;
    const auto cell = static_cast<std::size_t>(cell_of(q, radius_m));
    const bool in = hull.vertices.size() >= 3 && inside_hull(hull, points, q);
    const bool beyond = glm::dot(q, edge.outward) > static_cast<float>(edge.h) * radius_m;
    total[cell] += 1, in_hull += in, in_cap += beyond;
    if (!hit) continue;
    ++on, c.zone_centroid += q;
    if (in) ++on_hull, c.hull_centroid += q, c.hull_cells[cell] += 1;
    if (beyond) ++on_cap;
  }
  for (std::size_t i = 0; i < kCells; ++i) c.hull_cells[i] /= std::max(total[i], 1.0);
  c.zone = std::max(on, 1) / static_cast<double>(n);
  c.zone_partial = on < n;
  if (on > 0) c.zone_centroid /= static_cast<float>(on);
  c.hull_known = in_hull >= 16 && on_hull > 0;
  if (c.hull_known)
    c.hull = on_hull / static_cast<double>(in_hull), c.hull_centroid /= static_cast<float>(on_hull);
  c.hull_partial = c.hull_known && on_hull < in_hull;
  c.cap_share = in_cap > 0 ? on_cap / static_cast<double>(in_cap) : 0;
  return c;
}

/// Surface in the strip of the zone between an edge that leaves the centre out (h < 0) and the centre, as a
/// fraction of the zone: the strip that all photons must have missed if the centre is lit. Probed in the
/// strip itself: it is often too thin for probes of the whole zone. `least`: a smaller strip is not looked
/// at.
double strip_fraction(const Edge& edge, double least, float radius_m, const OnSurface& on_surface) {
  constexpr int kProbes = 64;
  const double strip = cap_fraction(edge.h) - 0.5;
  if (strip < least || !on_surface) return strip;
  const Vec2 across(-edge.outward.y, edge.outward.x);
  double on = 0, all = 0;
  for (int i = 0; i < kProbes; ++i) {
    const double depth = edge.h * (i + 0.5) / kProbes, half = std::sqrt(1 - depth * depth);
    const double side = half * (2 * std::fmod(i * 0.6180339887498949, 1.0) - 1);
    const bool hit =
        on_surface(radius_m * (static_cast<float>(depth) * edge.outward + static_cast<float>(side) * across));
    all += half, on += hit ? half : 0;
  }
  return strip * on / all;
}

/// docs/methods.md#c3: variance over mean of the counts, where the zone is lit and surface, far above Poisson
/// and large in itself.
bool is_clustered(const Cells& counts, const Cells& share) {
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < kCells; ++i) {
    if (share[i] < 0.5) continue;
    const double density = counts[i] / share[i];
    n += 1, sum += density, squares += density * density;
  }
  if (n < 4 || sum <= 0) return false;
  const double mean = sum / n, variance = (squares - sum * mean) / (n - 1);
  return variance >= 3 * mean && variance - mean >= 0.25 * mean * mean;
}

/// Sum of the used photons over the area. Compound Poisson: the variance of a sum of marks is the sum of
/// their squares.
void add_up(std::span<const Rgb> flux_lm, std::span<const std::uint8_t> used, ZoneEstimate& e) {
  DVec3 sum(0), squares(0);
  for (std::size_t i = 0; i < flux_lm.size(); ++i) {
    if (!used[i]) continue;
    const DVec3 f(flux_lm[i]);
    sum += f, squares += f * f;
  }
  const DVec3 mean = sum / e.area_m2, geometric = mean * e.area_error;
  e.irradiance = Rgb(mean);
  e.stderr_lx = Rgb(glm::sqrt(squares / (e.area_m2 * e.area_m2) + geometric * geometric));
}

/// Error of an area counted by n low-discrepancy probes, relative: only their number along the border is
/// uncertain.
double probe_error(bool partial, double fraction, int n) {
  return partial ? 0.5 * std::pow(n, -0.75) / std::max(fraction, 1.0 / n) : 0;
}

}  // namespace

double cap_fraction(double h) {
  h = std::clamp(h, -1.0, 1.0);
  return (std::acos(h) - h * std::sqrt(1 - h * h)) / kPiD;
}

ZoneEstimate zone_irradiance(std::span<const Vec2> offsets_m, std::span<const Rgb> flux_lm, float radius_m,
                             const OnSurface& on_surface, const DensityOptions& options,
                             DensityScratch& scratch) {
  PHOS_CHECK(offsets_m.size() == flux_lm.size() && radius_m > 0, offsets_m.size(), " radius ", radius_m);
  const std::size_t m = offsets_m.size();
  const double radius = static_cast<double>(radius_m), disc = kPiD * radius * radius;
  ZoneEstimate e;
  scratch.used.assign(m, 1);
  const bool few = m < static_cast<std::size_t>(options.few);
  if (few) {
    scratch.hull.vertices.clear(), scratch.hull.area = 0;
  } else {
    convex_hull(offsets_m, scratch.hull);
  }
  const Hull& hull = scratch.hull;
  e.degenerate = !few && hull.area < kLeastHull * radius * radius;
  const Edge edge = nearest_edge(hull, offsets_m, radius_m);
  const double count = static_cast<double>(m);
  const bool lit =
      !few && !e.degenerate && cap_fraction(edge.h) <= std::min(0.5, (std::log(count) + 3) / count);
  const Cells counts = count_cells(offsets_m, radius_m);

  // Where the photons leave no gap, a few probes still look for a border, and many if one finds it.
  Coverage c;
  const bool doubt = in_doubt(counts, m);
  e.probed = lit;
  if (!lit || !whole(radius_m, on_surface)) {
    int probes = options.probes;
    c = probe(offsets_m, hull, edge, radius_m, on_surface, probes, scratch.covered);
    if (c.zone * kNarrow < 1) {  // a ledge: the few probes that found it do not tell its area
      probes *= kNarrow;
      c = probe(offsets_m, hull, edge, radius_m, on_surface, probes, scratch.covered);
    }
    c.probes = probes;
    e.probed = true;
  } else {
    c.hull_cells.fill(1);
  }
  e.clustered = !few && !e.degenerate && (doubt || !lit) && is_clustered(counts, c.hull_cells);

  const auto over_surface = [&](ZoneKind kind) {
    e.kind = kind;
    e.area_m2 = disc * c.zone;
    e.area_error = probe_error(c.zone_partial, c.zone, c.probes);
    e.partial = c.zone_partial;
    e.centroid_m = c.zone_centroid;
    add_up(flux_lm, scratch.used, e);
    return e;
  };
  if (few || e.degenerate || lit) return over_surface(lit ? ZoneKind::full : ZoneKind::few);
  const double coverage = c.hull_known ? std::max(c.hull, kLeastCoverage) : 1;
  const double inside = count - static_cast<double>(hull.vertices.size());
  e.area_m2 = hull.area * coverage;
  e.area_error = probe_error(c.hull_partial, c.hull, c.probes);
  const double strip_holding_one = e.area_m2 / (disc * std::max(inside, 1.0));
  const double dark_strip = options.dark_photons * strip_holding_one;
  const double strip = edge.h < 0 ? strip_fraction(edge, dark_strip, radius_m, on_surface) : 0;
  if (strip > 0 && strip >= dark_strip) {
    if (options.centre_lit) return over_surface(ZoneKind::few);  // the hull is a part of the lit surface
    e = ZoneEstimate{.kind = ZoneKind::dark,
                     .area_m2 = disc * strip,
                     .edge_m = static_cast<float>(-edge.h) * radius_m,
                     .probed = true};
    scratch.used.assign(m, 0);
    return e;
  }
  e.kind = ZoneKind::hull;
  e.centred = edge.h > 0;
  e.partial = c.hull_partial;
  for (const std::uint32_t v : hull.vertices) scratch.used[v] = 0;
  e.centroid_m = c.hull_partial ? c.hull_centroid : Vec2(hull.centroid);
  if (edge.h > 0 && c.cap_share >= 0.5) e.edge_m = static_cast<float>(edge.h) * radius_m;
  add_up(flux_lm, scratch.used, e);
  return e;
}

double kernel_weight(Kernel kernel, double r) {
  if (kernel == Kernel::epanechnikov) return 2 * (1 - r * r);
  if (kernel == Kernel::cone) return 3 * (1 - r);
  return 1;
}

ZoneEstimate kernel_irradiance(std::span<const Vec2> offsets_m, std::span<const Rgb> flux_lm, float radius_m,
                               Kernel kernel, DensityScratch& scratch) {
  PHOS_CHECK(offsets_m.size() == flux_lm.size() && radius_m > 0, offsets_m.size(), " radius ", radius_m);
  const double radius = static_cast<double>(radius_m);
  ZoneEstimate e{.kind = ZoneKind::kernel, .area_m2 = kPiD * radius * radius};
  scratch.used.assign(offsets_m.size(), 1);
  DVec3 sum(0), squares(0);
  for (std::size_t i = 0; i < offsets_m.size(); ++i) {
    const double r = std::min(1.0, glm::length(glm::dvec2(offsets_m[i])) / radius);
    const DVec3 f = DVec3(flux_lm[i]) * kernel_weight(kernel, r);
    sum += f, squares += f * f;
  }
  e.irradiance = Rgb(sum / e.area_m2);
  e.stderr_lx = Rgb(glm::sqrt(squares) / e.area_m2);
  return e;
}

float mean_distance_m(std::span<const Vec3> directions, std::span<const float> weights,
                      std::span<const float> distances_m) {
  constexpr int kRings = 4, kSlices = 13;
  double flux = 0, flux_over_distance = 0;
  std::array<double, kRings * kSlices> count{}, inverse{};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3& w = directions[i];
    const double over = 1 / std::max(static_cast<double>(distances_m[i]), 1e-30);
    flux += static_cast<double>(weights[i]), flux_over_distance += static_cast<double>(weights[i]) * over;
    const double turn = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * kPiD);
    const int ring = std::clamp(static_cast<int>(kRings * (1 - w.z * w.z)), 0, kRings - 1);
    const int slice = std::clamp(static_cast<int>(kSlices * (turn < 0 ? turn + 1 : turn)), 0, kSlices - 1);
    const auto cell = static_cast<std::size_t>(ring * kSlices + slice);
    count[cell] += 1, inverse[cell] += over;
  }
  const double by_flux = flux_over_distance > 0 ? flux / flux_over_distance : HUGE_VAL;
  const auto bounded = [](double d) { return d < 1e38 ? static_cast<float>(d) : kInfinity; };
  if (directions.size() < 50) return bounded(by_flux);
  double solid_angle = 0, over = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double omega = std::sqrt(1 - ring / double{kRings}) - std::sqrt(1 - (ring + 1) / double{kRings});
    for (int slice = 0; slice < kSlices; ++slice) {
      const auto cell = static_cast<std::size_t>(ring * kSlices + slice);
      if (count[cell] == 0) continue;
      solid_angle += omega, over += omega * inverse[cell] / count[cell];
    }
  }
  const double by_angle = over > 0 ? solid_angle / over : HUGE_VAL;
  return bounded(std::min(by_flux, by_angle));
}

}  // namespace phos::inline photon
