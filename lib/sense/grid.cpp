#include "sense/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "direct/direct_light.h"
#include "scene/inside_solid.h"
#include "sense/limits.h"
#include "sense/sensor_points.h"

namespace phos::inline sense {
namespace {

constexpr auto kMostPoints = kMostGridPoints.as<double>();
constexpr float kLevel = 0.99f;       // cosine between a floor and the vertical
constexpr double kFloorShare = 0.01;  // of the plan that a floor covers at least
constexpr float kFlat = 0.9999f;      // cosine between the pieces of one plane

struct DVec2 {
  double x = 0, y = 0;
};

Vec3 axis_of(Axis up) { return {up == Axis::x ? 1 : 0, up == Axis::y ? 1 : 0, up == Axis::z ? 1 : 0}; }

/// Places on one line: the middles of cells of `spacing`, centred in [lo, hi] without a margin at its ends.
/// One in the middle if there is room for less than a cell; none if there is no room.
struct Ticks {
  double first = 0, spacing = 1;
  std::size_t count = 0;
  double operator[](std::size_t i) const { return first + spacing * static_cast<double>(i); }
};
Ticks ticks(double lo, double hi, double spacing, double margin) {
  const double room = hi - lo - 2 * margin;
  if (!(room >= 0)) return {};
  const double cells = std::max(std::floor(room / spacing + 1e-3), 1.0);
  if (cells > kMostPoints) {
    throw Error(ExitCode::usage, "--grid",
                text("a spacing of ", shortest(spacing), " m makes too many points; give a larger one"));
  }
  return {0.5 * (lo + hi) - 0.5 * (cells - 1) * spacing, spacing, static_cast<std::size_t>(cells)};
}

void require_few(std::size_t columns, std::size_t rows, double spacing) {
  if (static_cast<double>(columns) * static_cast<double>(rows) <= kMostPoints) return;
  throw Error(ExitCode::usage, "--grid",
              text("a spacing of ", shortest(spacing), " m makes ", columns, " x ", rows,
                   " points; give a larger one"));
}

// --- on a mesh

/// A flat piece: triangles of one plane.
struct Piece {
  Vec3 normal{0};
  double offset_m = 0;
  std::vector<std::uint32_t> triangles;
};

std::vector<Piece> flat_pieces(const Scene& scene, const Instance& instance, double size_m) {
  std::vector<Piece> pieces;
  for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
       ++t) {
    const Vec3 n = geometric_normal(scene, t);
    if (n == Vec3(0)) continue;
    const double offset = glm::dot(DVec3(n), DVec3(scene.position[scene.triangle[t].v[0]]));
    // Neighbours in a mesh follow each other: the last pieces are the likely ones.
    Piece* own = nullptr;
    for (std::size_t k = pieces.size(); k-- > 0 && pieces.size() - k <= 64 && !own;) {
      if (glm::dot(pieces[k].normal, n) > kFlat && std::fabs(pieces[k].offset_m - offset) < 1e-4 * size_m)
        own = &pieces[k];
    }
    if (!own) own = &pieces.emplace_back(Piece{n, offset, {}});
    own->triangles.push_back(t);
  }
  return pieces;
}

/// A piece in the coordinates of its plane.
struct Flat {
  DVec3 u{1, 0, 0}, v{0, 1, 0}, n{0, 0, 1};
  double offset_m = 0;
  std::vector<std::array<DVec2, 3>> triangles;
  DVec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  double area() const { return (hi.x - lo.x) * (hi.y - lo.y); }
};

Flat laid_flat(const Scene& scene, const Piece& piece, const DVec3& u) {
  Flat flat;
  flat.u = u, flat.n = DVec3(piece.normal), flat.v = glm::cross(flat.n, u), flat.offset_m = piece.offset_m;
  for (const std::uint32_t t : piece.triangles) {
    std::array<DVec2, 3>& corner = flat.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const DVec3 p(scene.position[scene.triangle[t].v[c]]);
      corner[c] = {glm::dot(p, flat.u), glm::dot(p, flat.v)};
      flat.lo = {std::min(flat.lo.x, corner[c].x), std::min(flat.lo.y, corner[c].y)};
      flat.hi = {std::max(flat.hi.x, corner[c].x), std::max(flat.hi.y, corner[c].y)};
    }
  }
  return flat;
}

/// Along the side of the smallest rectangle about the piece: one of its sides is a side of the piece.
Flat smallest_rectangle(const Scene& scene, const Piece& piece) {
  constexpr std::size_t kMostTried = 64;
  Flat best;
  bool found = false;
  for (std::size_t k = 0; k < std::min(piece.triangles.size(), kMostTried); ++k) {
    const auto& v = scene.triangle[piece.triangles[k]].v;
    for (unsigned c = 0; c < 3; ++c) {
      const DVec3 n(piece.normal), edge = DVec3(scene.position[v[(c + 1) % 3]]) - DVec3(scene.position[v[c]]);
      const DVec3 across = edge - n * glm::dot(n, edge);
      if (!(glm::dot(across, across) > 0)) continue;
      Flat flat = laid_flat(scene, piece, glm::normalize(across));
      if (found && !(flat.area() < best.area() * (1 - 1e-6))) continue;
      best = std::move(flat);
      found = true;
    }
  }
  return best;
}

/// Twice the signed area of a, b, p: the same number, but for its sign, in whichever order a and b come.
double side_of(DVec2 a, DVec2 b, const DVec2& p) {
  const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
  if (swapped) std::swap(a, b);
  const double area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  return swapped ? -area : area;
}

/// Of two triangles with a common edge, a point on it is in one.
bool holds(const std::array<DVec2, 3>& t, const DVec2& p) {
  for (std::size_t c = 0; c < 3; ++c) {
    const DVec2 &a = t[c], &b = t[(c + 1) % 3];
    const double area = side_of(a, b, p);
    const bool owns_edge = b.x < a.x || (b.x == a.x && b.y < a.y);
    if (area < 0 || (area == 0 && !owns_edge)) return false;
  }
  return true;
}

/// Places `spacing` apart, wherever the first of them falls: as many on average as there is room for.
Ticks shifted_ticks(double lo, double hi, double spacing, float shift) {
  Ticks t = ticks(lo, hi, spacing, 0);
  t.first = lo + static_cast<double>(shift) * spacing;
  t.count = t.first < hi ? static_cast<std::size_t>(std::floor((hi - t.first) / spacing)) + 1 : 0;
  return t;
}

/// Is it large and full enough to carry a grid of its own, and no piece of something curved?
bool stands_alone(const Flat& flat, double spacing) {
  double area = 0;
  for (const auto& [a, b, c] : flat.triangles) area += 0.5 * std::fabs(side_of(a, b, c));
  return std::min(flat.hi.x - flat.lo.x, flat.hi.y - flat.lo.y) >= spacing * (1 - 1e-3) &&
         area >= 4 * spacing * spacing && area >= 0.6 * flat.area();
}

void add_grid(const Flat& flat, const Ticks& xs, const Ticks& ys, Sensors& sensors) {
  require_few(xs.count, ys.count, xs.spacing);
  for (std::size_t iy = 0; iy < ys.count; ++iy) {
    for (std::size_t ix = 0; ix < xs.count; ++ix) {
      const DVec2 p{xs[ix], ys[iy]};
      const bool inside = std::any_of(flat.triangles.begin(), flat.triangles.end(),
                                      [&](const auto& t) { return holds(t, p); });
      if (!inside) continue;
      sensors.points.push_back({Vec3(p.x * flat.u + p.y * flat.v + flat.offset_m * flat.n), Vec3(flat.n)});
    }
  }
}

// --- workplane

/// Is any surface nearer than `margin` beside the point, in one of 16 directions?
bool near_walls(const RayScene& rays, const Vec3& p, const Vec3& up, float margin) {
  constexpr int kDirections = 16;
  const Frame frame = make_frame(up);
  for (int k = 0; k < kDirections; ++k) {
    const Vec2 turned = cos_sin(static_cast<float>(k) / kDirections);
    if (rays.occluded({p, turned.x * frame.x + turned.y * frame.y, 0, margin})) return true;
  }
  return false;
}

/// Can a sensor be here? Something is below it, and it is neither in a solid nor behind the walls.
bool usable(const RayScene& rays, const Vec3& p, const Vec3& up, float margin) {
  const SurfacePoint at = receiver(rays.scene(), p, up);
  if (!rays.occluded({p, -up}) || inside_solid(rays, at) || glass_about(rays, at)) return false;
  return !(margin > 0) || !near_walls(rays, p, up, margin);
}

}  // namespace

void declare_options(Options& options, GridOptions& g) {
  options.section("Grid of sensors");
  options.number("grid", g.spacing_m, "METRES", "distance between the points of a grid of sensors",
                 kPositive);
  options.text("mesh", g.mesh, "NODE", "node whose surfaces carry the grid, on their front");
  options.number("height", g.height_m, "METRES",
                 "height of a workplane that carries the grid, above the floor (the lowest level surface "
                 "that faces up)");
  options.number("margin", g.margin_m, "METRES",
                 "least distance of the points to walls beside the workplane, or to the edges of the mesh",
                 kNotNegative);
  options.choice<Axis>("up", g.up, {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}},
                       "axis that points up; y in glTF");
}

void check(const GridOptions& grid, const std::string& points_path) {
  if (points_path.empty() == !grid.spacing_m)
    throw Error(ExitCode::usage, "",
                "sensors are missing, or stated twice; give either --points FILE or --grid METRES");
  if (!grid.spacing_m && (!grid.mesh.empty() || grid.height_m || grid.margin_m > 0))
    throw Error(ExitCode::usage, "--points",
                "--mesh, --height and --margin belong to --grid; leave them out");
  if (grid.spacing_m && grid.mesh.empty() == !grid.height_m)
    throw Error(ExitCode::usage, "--grid",
                "needs either --mesh NODE or --height METRES; give one of the two");
}

Sensors find_sensors(const std::string& points_path, const GridOptions& grid, const RayScene& rays) {
  const DVec3& origin_m = rays.scene().origin_m;
  if (!points_path.empty()) {
    Sensors sensors = read_sensors(points_path, origin_m);
    for (const SurfaceSample& s : sensors.points)
      require_in_air(rays, s.position, s.normal, points_path == "-" ? "stdin" : points_path);
    return sensors;
  }
  Sensors sensors = grid.mesh.empty() ? workplane(rays, grid) : mesh_grid(rays.scene(), grid);
  if (!grid.mesh.empty())
    sensors.left_out += std::erase_if(sensors.points, [&](const SurfaceSample& s) {
      return glass_about(rays, receiver(rays.scene(), s.position, s.normal)) != nullptr;
    });
  sensors.origin_m = origin_m;
  return sensors;
}

namespace {

/// Level surfaces at one level.
struct Level {
  double area_m2 = 0;
  float height_m = 0;
  std::vector<std::uint32_t> triangles;
};

/// Is there room for people over most of these, and no inside of a slab?
bool free_above(const RayScene& rays, const Level& level, const Vec3& axis) {
  constexpr std::size_t kEnough = 32;  // triangles: the largest
  const Scene& scene = rays.scene();
  std::vector<std::uint32_t> largest = level.triangles;
  std::sort(largest.begin(), largest.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float m2_a = area_m2(scene, a), m2_b = area_m2(scene, b);
    return m2_a != m2_b ? m2_a > m2_b : a < b;
  });
  largest.resize(std::min(largest.size(), kEnough));
  double free_m2 = 0, all_m2 = 0;
  for (const std::uint32_t t : largest) {
    const auto& v = scene.triangle[t].v;
    const Vec3 middle = (scene.position[v[0]] + scene.position[v[1]] + scene.position[v[2]]) / 3.f;
    const auto m2 = static_cast<double>(area_m2(scene, t));
    all_m2 += m2;
    if (!inside_solid(rays, receiver(scene, middle, axis))) free_m2 += m2;
  }
  return 2 * free_m2 > all_m2;
}

}  // namespace

float floor_level_m(const RayScene& rays, Axis up) {
  const Scene& scene = rays.scene();
  const Vec3 axis = axis_of(up);
  const int k = static_cast<int>(up);
  const Vec3 size = scene.bounds.size();
  const double plan = static_cast<double>(size[(k + 1) % 3]) * static_cast<double>(size[(k + 2) % 3]);
  const double step = std::max(1e-3 * static_cast<double>(size[k]), 1e-30);
  std::map<double, Level> tops, bottoms;  // by their level in thousandths of the height
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    const float facing = glm::dot(geometric_normal(scene, t), axis);
    if (!(std::fabs(facing) > kLevel) || (facing < 0 && !scene.material_of(t).double_sided)) continue;
    const float h = scene.position[scene.triangle[t].v[0]][k];
    Level& level =
        (facing > 0 ? tops : bottoms)[std::floor(static_cast<double>(h - scene.bounds.lo[k]) / step)];
    level.area_m2 += static_cast<double>(area_m2(scene, t));
    level.height_m = h;
    level.triangles.push_back(t);
  }
  const double enough_m2 = kFloorShare * plan;
  const auto top = std::find_if(tops.begin(), tops.end(),
                                [&](const auto& level) { return level.second.area_m2 >= enough_m2; });
  for (const auto& [bin, level] : bottoms) {
    if (top != tops.end() && bin >= top->first) break;
    if (level.area_m2 >= enough_m2 && free_above(rays, level, axis)) return level.height_m;
  }
  return top != tops.end() ? top->second.height_m : scene.bounds.lo[k];
}

Sensors mesh_grid(const Scene& scene, const GridOptions& grid) {
  Sensors sensors;
  const double size_m = static_cast<double>(scene.bounds.diagonal_m());
  bool found = false;
  for (const Instance& instance : scene.instance) {
    if (instance.node != grid.mesh) continue;
    found = true;
    const std::vector<Piece> pieces = flat_pieces(scene, instance, size_m);
    for (const Piece& piece : pieces) {
      const Flat flat = smallest_rectangle(scene, piece);
      const double spacing = *grid.spacing_m;
      if (pieces.size() == 1 || stands_alone(flat, spacing)) {
        add_grid(flat, ticks(flat.lo.x, flat.hi.x, spacing, grid.margin_m),
                 ticks(flat.lo.y, flat.hi.y, spacing, grid.margin_m), sensors);
      } else {
        const Vec2 shift = RandomStream(0, Stage::placement, piece.triangles[0]).uniform2();
        add_grid(flat, shifted_ticks(flat.lo.x, flat.hi.x, spacing, shift.x),
                 shifted_ticks(flat.lo.y, flat.hi.y, spacing, shift.y), sensors);
      }
    }
  }
  if (!found) {
    std::string names;
    for (std::size_t i = 0; i < scene.instance.size() && i < 8; ++i)
      names.append(i > 0 ? ", " : "").append(scene.instance[i].node);
    throw Error(ExitCode::usage, "--mesh",
                text("the scene has no surface of node \"", grid.mesh, "\"; it has ", names,
                     scene.instance.size() > 8 ? ", ..." : ""));
  }
  return sensors;
}

Sensors workplane(const RayScene& rays, const GridOptions& grid) {
  const Scene& scene = rays.scene();
  const int k = static_cast<int>(grid.up);
  const int a = (k + 1) % 3, b = (k + 2) % 3;
  const Vec3 up = axis_of(grid.up);
  const Bounds& bounds = scene.bounds;
  Sensors sensors;
  if (bounds.empty()) return sensors;
  const Ticks xs = ticks(static_cast<double>(bounds.lo[a]), static_cast<double>(bounds.hi[a]),
                         *grid.spacing_m, grid.margin_m);
  const Ticks ys = ticks(static_cast<double>(bounds.lo[b]), static_cast<double>(bounds.hi[b]),
                         *grid.spacing_m, grid.margin_m);
  require_few(xs.count, ys.count, *grid.spacing_m);
  const auto level = static_cast<float>(static_cast<double>(floor_level_m(rays, grid.up)) + *grid.height_m);
  sensors.level_m = world_number(scene.origin_m[k], level);
  const std::size_t n = xs.count * ys.count;
  const auto place = [&](std::size_t i) {
    Vec3 p;
    p[k] = level;
    p[a] = static_cast<float>(xs[i % xs.count]), p[b] = static_cast<float>(ys[i / xs.count]);
    return p;
  };
  std::vector<std::uint8_t> good(n);
  parallel_for(n, 256, [&](std::size_t i) {
    good[i] = usable(rays, place(i), up, static_cast<float>(grid.margin_m));
  });
  for (std::size_t i = 0; i < n; ++i) {
    if (good[i])
      sensors.points.push_back({place(i), up});
    else
      ++sensors.left_out;
  }
  return sensors;
}

}  // namespace phos::inline sense
