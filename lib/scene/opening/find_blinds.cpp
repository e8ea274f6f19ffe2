#include "scene/opening/find_blinds.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/connected_parts.h"
#include "scene/material/passage.h"
#include "scene/sky/access.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kFewestSlats = 3;
constexpr std::size_t kMostTriangles = 512;  // of a slat
constexpr std::size_t kMostSlats = 4096;     // of a scene; with more, none is looked for
constexpr double kLeastLength = 3;           // of a slat, of its width
constexpr double kFarthest = 3;              // from one slat to the next, of its width
constexpr double kAlike = 0.01;              // lengths and ends, of the length
constexpr double kParallel = 1 - 1e-4;       // cosine: 0.8 degrees
constexpr double kInLine = 0.25;             // middles off the line of the row, of the width
constexpr int kLooks = 256;                  // through a blind, to each side
constexpr int kFewestOpen = kLooks / 16;

/// A part that may be a slat.
struct Slat {
  std::vector<DVec3> corner;
  DVec3 middle{0}, along{0};  // m; unit
  double length_m = 0, width_m = 0;
};

/// The direction in which a surface is longest: the axis of least inertia, by repeated squaring.
DVec3 long_axis(const std::vector<DVec3>& triangles, const DVec3& middle) {
  glm::dmat3 spread(0);
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const DVec3 a = triangles[t] - middle, b = triangles[t + 1] - middle, c = triangles[t + 2] - middle;
    const double area = glm::length(glm::cross(b - a, c - a));
    const DVec3 sum = a + b + c;
    for (const DVec3& p : {a, b, c, sum}) spread += area * glm::outerProduct(p, p);
  }
  for (int k = 0; k < 16; ++k) {
    const double size = std::fabs(spread[0][0]) + std::fabs(spread[1][1]) + std::fabs(spread[2][2]);
    if (!(size > 0)) return DVec3(0);
    spread /= size;
    spread = spread * spread;
  }
  DVec3 axis(0);
  for (int c = 0; c < 3; ++c)
    if (glm::length(spread[c]) > glm::length(axis)) axis = spread[c];
  return glm::length(axis) > 0 ? glm::normalize(axis) : axis;
}

/// Length 0: it is none.
Slat slat_of(std::vector<DVec3> triangles) {
  Slat slat;
  for (const DVec3& p : triangles) slat.middle += p / static_cast<double>(triangles.size());
  slat.along = long_axis(triangles, slat.middle);
  if (slat.along == DVec3(0)) return slat;
  // One sense for all slats of a row.
  const DVec3 size = glm::abs(slat.along);
  const int largest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (slat.along[largest] < 0) slat.along = -slat.along;
  double lo = 0, hi = 0, across = 0;
  for (const DVec3& p : triangles) {
    const DVec3 way = p - slat.middle;
    const double x = glm::dot(way, slat.along);
    lo = std::min(lo, x), hi = std::max(hi, x);
    across = std::max(across, glm::length(way - x * slat.along));
  }
  slat.middle += 0.5 * (lo + hi) * slat.along;
  slat.width_m = 2 * across;
  if (hi - lo >= kLeastLength * slat.width_m) slat.length_m = hi - lo;
  slat.corner = std::move(triangles);
  return slat;
}

std::vector<Slat> find_slats(const Scene& scene) {
  std::vector<Vec3> corner;
  for (const Triangle& t : scene.triangle)
    for (const std::uint32_t v : t.v) corner.push_back(scene.position[v]);
  const ConnectedParts connected = find_connected_parts(corner);
  std::vector<std::vector<std::uint32_t>> part(connected.parts);
  for (std::uint32_t t = 0; t < connected.part.size(); ++t) part[connected.part[t]].push_back(t);
  std::vector<bool> straight;
  for (const Material& m : scene.material) straight.push_back(passes_straight(scene, m));
  std::vector<Slat> slats;
  for (const std::vector<std::uint32_t>& triangles : part) {
    if (triangles.size() > kMostTriangles) continue;
    if (straight[scene.instance[scene.triangle_instance[triangles.front()]].material]) continue;
    std::vector<DVec3> own;
    for (const std::uint32_t t : triangles)
      for (std::size_t k = 0; k < 3; ++k) own.emplace_back(corner[3 * t + k]);
    Slat slat = slat_of(std::move(own));
    if (slat.length_m > 0) slats.push_back(std::move(slat));
    if (slats.size() > kMostSlats) return {};
  }
  return slats;
}

bool alike(const Slat& a, const Slat& b) {
  const double tolerance_m = kAlike * a.length_m;
  return std::fabs(a.length_m - b.length_m) <= tolerance_m && glm::dot(a.along, b.along) >= kParallel &&
         std::fabs(glm::dot(b.middle - a.middle, a.along)) <= tolerance_m;
}

/// The slats of the row that `first` is in, in order along it; their direction in `along`.
std::vector<std::size_t> row_of(const std::vector<Slat>& slats, std::size_t first,
                                const std::vector<bool>& taken, DVec3& along) {
  const Slat& own = slats[first];
  std::vector<std::size_t> same;
  std::size_t nearest = first;
  double nearest_m = kFarthest * own.width_m;
  for (std::size_t i = 0; i < slats.size(); ++i) {
    if (taken[i] || i == first || !alike(own, slats[i])) continue;
    same.push_back(i);
    const double d = glm::length(slats[i].middle - own.middle);
    if (d > 0 && d < nearest_m) nearest_m = d, nearest = i;
  }
  if (nearest == first) return {};
  const DVec3 way = slats[nearest].middle - own.middle;
  along = glm::normalize(way - glm::dot(way, own.along) * own.along);
  struct Place {
    double at_m;
    std::size_t slat;
  };
  std::vector<Place> line{{0, first}};
  for (const std::size_t i : same) {
    const DVec3 to = slats[i].middle - own.middle;
    const double at_m = glm::dot(to, along);
    const DVec3 off = to - at_m * along - glm::dot(to, own.along) * own.along;
    if (glm::length(off) <= kInLine * own.width_m) line.push_back({at_m, i});
  }
  std::sort(line.begin(), line.end(), [](const Place& a, const Place& b) {
    return a.at_m != b.at_m ? a.at_m < b.at_m : a.slat < b.slat;
  });
  const auto self = std::find_if(line.begin(), line.end(), [&](const Place& p) { return p.slat == first; });
  auto begin = self, end = self + 1;
  const double farthest_m = kFarthest * own.width_m;
  while (begin != line.begin() && begin->at_m - std::prev(begin)->at_m <= farthest_m) --begin;
  while (end != line.end() && end->at_m - std::prev(end)->at_m <= farthest_m) ++end;
  std::vector<std::size_t> row;
  for (auto p = begin; p != end; ++p) row.push_back(p->slat);
  return row;
}

/// Corners of the convex hull of a slat across, counter-clockwise (Andrew 1979).
std::vector<DVec3> hull_across(std::vector<DVec3> points) {
  for (DVec3& p : points) p.x = 0;
  const auto less = [](const DVec3& a, const DVec3& b) { return a.y != b.y ? a.y < b.y : a.z < b.z; };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<DVec3> hull;
  for (int turn = 0; turn < 2; ++turn) {
    const std::size_t begin = hull.size();
    for (const DVec3& p : points) {
      while (hull.size() >= begin + 2 &&
             glm::cross(hull.back() - hull[hull.size() - 2], p - hull.back()).x <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

Blind::Slats slats_of(const std::vector<Slat>& slats, const std::vector<std::size_t>& row,
                      const DVec3& along) {
  const Slat& own = slats[row.front()];
  Blind::Slats made;
  made.origin = own.middle;
  made.frame.x = Vec3(own.along), made.frame.y = Vec3(along),
  made.frame.z = Vec3(glm::cross(own.along, along));
  const DVec3 axis[3] = {DVec3(made.frame.x), DVec3(made.frame.y), DVec3(made.frame.z)};
  made.from_m = -0.5 * own.length_m, made.to_m = 0.5 * own.length_m;
  for (const std::size_t i : row) {
    std::vector<DVec3> local;
    for (const DVec3& p : slats[i].corner) {
      const DVec3 way = p - made.origin;
      local.emplace_back(glm::dot(way, axis[0]), glm::dot(way, axis[1]), glm::dot(way, axis[2]));
    }
    for (const DVec3& p : hull_across(std::move(local))) made.corner.push_back(p);
    made.end.push_back(made.corner.size());
  }
  return made;
}

/// Is the sky seen through the gaps of a blind, by who looks along z of its frame, or against it?
bool sky_behind(const RayScene& rays, const Frame& frame, const std::vector<Slat>& slats,
                const std::vector<std::size_t>& row, bool towards_z) {
  Frame looking = frame;
  if (!towards_z) looking.z = -frame.z, looking.x = -frame.x;
  int open = 0;
  for (int k = 0; k < kLooks; ++k) {
    const auto gap = static_cast<std::size_t>(k) % (row.size() - 1);
    const Slat &a = slats[row[gap]], &b = slats[row[gap + 1]];
    const Vec2 u = r2_point(13 * k, Vec2(0.5f)), up = r2_point(k, Vec2(0.25f, 0.75f));
    const Vec3 from =
        Vec3(0.5 * (a.middle + b.middle) + (static_cast<double>(u.x) - 0.5) * a.length_m * a.along);
    open += sees_sky(rays, {from, looking.to_world(sample_cosine_hemisphere(up))});
  }
  return open >= kFewestOpen;
}

}  // namespace

std::vector<Blind> find_blinds(const RayScene& rays) {
  const std::vector<Slat> slats = find_slats(rays.scene());
  std::vector<bool> taken(slats.size());
  std::vector<Blind> found;
  for (std::size_t i = 0; i < slats.size(); ++i) {
    if (taken[i]) continue;
    taken[i] = true;
    DVec3 along(0);
    const std::vector<std::size_t> row = row_of(slats, i, taken, along);
    if (row.size() < kFewestSlats) continue;
    for (const std::size_t slat : row) taken[slat] = true;
    Blind::Slats made = slats_of(slats, row, along);
    made.sky_towards_z = sky_behind(rays, made.frame, slats, row, true);
    made.sky_against_z = sky_behind(rays, made.frame, slats, row, false);
    if (made.sky_towards_z || made.sky_against_z) found.emplace_back(std::move(made));
  }
  return found;
}

}  // namespace phos::inline scene
