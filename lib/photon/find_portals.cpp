#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "photon/portals.h"
#include "scene/luminaires.h"

namespace phos {
namespace {

constexpr std::size_t kPoints = 8192, kRays = 64;
constexpr double kWithin = 0.25;
constexpr int kCells = 32;  // along each side of the box
constexpr int kPanes = 8;   // that are seen through

bool is_pane(const Material& m) {
  return m.model == Model::dielectric || m.model == Model::thin_dielectric || m.transmission > 0;
}

/// Does a ray leave the scene, straight through glass, to where there is light?
bool sees_sky(const RayScene& rays, Ray ray) {
  const Scene& scene = rays.scene();
  for (int panes = 0; panes <= kPanes; ++panes) {
    SurfacePoint point;
    if (!trace(rays, ray, point)) return max_component(background_luminance(scene, ray.direction)) > 0;
    if (!is_pane(scene.material[point.material])) return false;
    ray.origin = point.leave(ray.direction);
  }
  return false;
}

struct Looker {
  Vec3 position{0};
  std::vector<Vec3> sky;  ///< directions in which it is seen
};

/// Points evenly over all surfaces, alternately on their front and back.
std::vector<Looker> look_about(const RayScene& rays, std::uint64_t seed) {
  const Scene& scene = rays.scene();
  std::vector<double> below;
  double sum = 0;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t)
    below.push_back(sum += static_cast<double>(area_m2(scene, t)));
  std::vector<Looker> lookers(sum > 0 ? kPoints : 0);
  parallel_for(lookers.size(), 64, [&](std::size_t i) {
    RandomStream random(seed, Stage::pilot, i);
    random.start_bounce(0);
    const double x = (static_cast<double>(i) + random.uniform_double()) / static_cast<double>(kPoints) * sum;
    const auto above = std::upper_bound(below.begin(), below.end() - 1, x);
    const auto t = static_cast<std::uint32_t>(above - below.begin());
    const Vec2 weight = sample_triangle(random.uniform2());
    const auto& v = scene.triangle[t].v;
    const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
    const Vec3 normal = (i % 2 == 0 ? 1.f : -1.f) * geometric_normal(scene, t);
    if (normal == Vec3(0)) return;
    lookers[i].position = a + weight.x * (b - a) + weight.y * (c - a);
    const float lift_m = 1e-5f * scene.bounds.diagonal_m();
    const Frame frame = make_frame(normal);
    const Ray start{lookers[i].position + lift_m * normal, normal};
    for (std::size_t k = 0; k < kRays; ++k) {
      Ray ray = start;
      ray.direction = frame.to_world(sample_uniform_cone(random.uniform2(), 0));
      if (sees_sky(rays, ray)) lookers[i].sky.push_back(ray.direction);
    }
  });
  std::erase_if(lookers, [](const Looker& looker) {
    return looker.sky.empty() || static_cast<double>(looker.sky.size()) >= kWithin * kRays;
  });
  return lookers;
}

/// Cells of the six faces of a box, face 2 * axis + (1 for the upper).
struct Faces {
  std::array<std::array<bool, kCells * kCells>, 6> open{};

  bool& at(std::size_t face, int u, int v) { return open[face][static_cast<std::size_t>(v * kCells + u)]; }

  /// The cell through which a ray from within leaves the box.
  void mark(const Bounds& box, const Vec3& from, const Vec3& direction) {
    float nearest = kInfinity;
    int axis = -1;
    for (int c = 0; c < 3; ++c) {
      if (direction[c] == 0) continue;
      const float t = ((direction[c] > 0 ? box.hi[c] : box.lo[c]) - from[c]) / direction[c];
      if (t < nearest) nearest = t, axis = c;
    }
    if (axis < 0) return;
    const Vec3 share = (from + nearest * direction - box.lo) / box.size();
    const auto cell = [&](int c) {
      return static_cast<int>(std::clamp(share[c % 3] * kCells, 0.f, kCells - 1.f));
    };
    at(static_cast<std::size_t>(2 * axis + (direction[axis] > 0)), cell(axis + 1), cell(axis + 2)) = true;
  }

  void widen() {
    const Faces before = *this;
    for (std::size_t f = 0; f < 6; ++f)
      for (int v = 0; v < kCells; ++v)
        for (int u = 0; u < kCells; ++u) {
          if (!before.open[f][static_cast<std::size_t>(v * kCells + u)]) continue;
          for (int y = std::max(v - 1, 0); y <= std::min(v + 1, kCells - 1); ++y)
            for (int x = std::max(u - 1, 0); x <= std::min(u + 1, kCells - 1); ++x) at(f, x, y) = true;
        }
  }

  /// As rectangles: runs of cells, joined with equal runs above them.
  std::vector<Portal> rectangles(const Bounds& box) const {
    std::vector<Portal> out;
    Faces rest = *this;
    for (std::size_t f = 0; f < 6; ++f)
      for (int v = 0; v < kCells; ++v)
        for (int u = 0; u < kCells; ++u) {
          int wide = 0, high = 0;
          while (u + wide < kCells && rest.at(f, u + wide, v)) ++wide;
          if (wide == 0) continue;
          const auto whole = [&](int row) {
            for (int x = u; x < u + wide; ++x)
              if (!rest.at(f, x, row)) return false;
            return true;
          };
          while (v + high < kCells && whole(v + high)) ++high;
          for (int y = v; y < v + high; ++y)
            for (int x = u; x < u + wide; ++x) rest.at(f, x, y) = false;
          out.push_back(rectangle(box, f, u, v, wide, high));
        }
    return out;
  }

  static Portal rectangle(const Bounds& box, std::size_t face, int u, int v, int wide, int high) {
    const int axis = static_cast<int>(face / 2), first = (axis + 1) % 3, second = (axis + 2) % 3;
    const bool upper = face % 2 == 1;
    const Vec3 cell = box.size() / static_cast<float>(kCells);
    Portal p;
    p.corner = box.lo;
    if (upper) p.corner[axis] = box.hi[axis];
    p.corner[first] += static_cast<float>(u) * cell[first],
        p.corner[second] += static_cast<float>(v) * cell[second];
    p.edge[0][first] = static_cast<float>(wide) * cell[first];
    p.edge[1][second] = static_cast<float>(high) * cell[second];
    p.inwards[axis] = upper ? -1.f : 1.f;
    return p;
  }
};

}  // namespace

std::vector<Portal> find_portals(const RayScene& rays, std::uint64_t seed) {
  const std::vector<Looker> within = look_about(rays, seed);
  Bounds box;
  for (const Looker& looker : within) box.include(looker.position);
  if (within.empty()) return {};
  // What is flat still has sides.
  const Vec3 room(1e-3f * rays.scene().bounds.diagonal_m());
  box.include(box.lo - room), box.include(box.hi + room);
  Faces faces;
  for (const Looker& looker : within)
    for (const Vec3& direction : looker.sky) faces.mark(box, looker.position, direction);
  faces.widen();
  return faces.rectangles(box);
}

}  // namespace phos
