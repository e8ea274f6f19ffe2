#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "scene/find_portals.h"
#include "scene/sky_access.h"

namespace phos {
namespace {

constexpr std::size_t kPoints = 8192, kRays = 64;
constexpr double kWithin = 0.25;
constexpr int kCells = 64;  // along each side of the box
constexpr double kLeastSaved = 0.1;
struct Looker {
  Vec3 position{0};
  std::vector<Vec3> sky;  ///< directions in which it is seen
};

/// Points evenly over all surfaces, alternately on their front and back.
std::vector<Looker> look_about(const RayScene& rays) {
  const Scene& scene = rays.scene();
  std::vector<double> below;
  double sum = 0;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t)
    below.push_back(sum += static_cast<double>(area_m2(scene, t)));
  std::vector<Looker> lookers(sum > 0 ? kPoints : 0);
  parallel_for(lookers.size(), 64, [&](std::size_t i) {
    RandomStream random(0, Stage::pilot, i);
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

  struct Cells {
    int u, v, wide, high;
    int count() const { return wide * high; }
  };

  /// Rectangles that hold all open cells, few of them.
  std::vector<Portal> rectangles(const Bounds& box) const {
    std::vector<Portal> out;
    for (std::size_t f = 0; f < 6; ++f)
      for (const Cells& c : split(f, trimmed(f, {0, 0, kCells, kCells})))
        out.push_back(rectangle(box, f, c.u, c.v, c.wide, c.high));
    return out;
  }

  /// Without the rows and columns at the sides that are closed all along.
  Cells trimmed(std::size_t face, const Cells& c) const {
    Cells out{kCells, kCells, 0, 0};
    int end_u = 0, end_v = 0;
    for (int v = c.v; v < c.v + c.high; ++v)
      for (int u = c.u; u < c.u + c.wide; ++u) {
        if (!open[face][static_cast<std::size_t>(v * kCells + u)]) continue;
        out.u = std::min(out.u, u), out.v = std::min(out.v, v);
        end_u = std::max(end_u, u + 1), end_v = std::max(end_v, v + 1);
      }
    out.wide = std::max(end_u - out.u, 0), out.high = std::max(end_v - out.v, 0);
    return out;
  }

  /// Cut in two where most closed cells fall away, as long as that is kLeastSaved of them.
  std::vector<Cells> split(std::size_t face, const Cells& all) const {
    if (all.count() == 0) return {};
    std::array<Cells, 2> best{};
    int left = all.count();
    const auto consider = [&](const Cells& one, const Cells& other) {
      const std::array<Cells, 2> parts{trimmed(face, one), trimmed(face, other)};
      if (parts[0].count() + parts[1].count() < left)
        best = parts, left = parts[0].count() + parts[1].count();
    };
    for (int k = 1; k < all.wide; ++k)
      consider({all.u, all.v, k, all.high}, {all.u + k, all.v, all.wide - k, all.high});
    for (int k = 1; k < all.high; ++k)
      consider({all.u, all.v, all.wide, k}, {all.u, all.v + k, all.wide, all.high - k});
    if (left > (1 - kLeastSaved) * all.count()) return {all};
    std::vector<Cells> out = split(face, best[0]);
    for (const Cells& c : split(face, best[1])) out.push_back(c);
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

std::vector<Portal> portals_about_rooms(const RayScene& rays) {
  const std::vector<Looker> within = look_about(rays);
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
