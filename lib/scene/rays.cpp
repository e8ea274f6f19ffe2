#include "scene/rays.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/options.h"
#include "scene/material/passage.h"
#include "scene/ray_query.h"
#include "scene/ray_tree.h"
#include "scene/shading_frame.h"

namespace phos::inline scene {

namespace {

/// Of a ray that nothing else is in the way of.
Rgb straight_share(const RayScene& rays, const Ray& ray, std::span<PaneHit> hits) {
  if (hits.empty()) return Rgb(1);
  thread_local std::vector<Crossing> crossings;
  if (find_crossings(rays, ray, hits, crossings)) return Rgb(0);
  StraightLight light;
  for (const Crossing& c : crossings) light.add(c, ray.direction);
  return light.transmittance() * light.nearer(ray.t_max_m);
}

}  // namespace

struct RayScene::Impl {
  RayTree tree;
  std::vector<Reads> reads;  // per material
};

RayScene::RayScene(const Scene& scene, const RayOptions& options)
    : impl_(new Impl{.tree = {scene, options.isa}, .reads = {}}) {
  for (const Material& material : scene.material) impl_->reads.push_back(reads_of(scene, material));
}

RayScene::~RayScene() = default;

const Scene& RayScene::scene() const { return impl_->tree.scene(); }

void* RayScene::native() const { return impl_->tree.native(); }

bool RayScene::intersect(const Ray& ray, Hit& hit) const {
  RayContext context;
  alignas(16) RTCRayHit query = embree_ray(ray, impl_->tree.units_per_m());
  const NoFloatTraps traps;  // Embree divides by zero components of directions
  rtcIntersect1(impl_->tree.native(), &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.distance_m = impl_->tree.m_per_unit() * query.ray.tfar;
  hit.triangle = impl_->tree.triangle(query.hit.geomID, query.hit.primID);
  hit.u = query.hit.u, hit.v = query.hit.v;
  return true;
}

void RayScene::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  PHOS_CHECK(rays.size() == hits.size(), rays.size(), " rays, ", hits.size(), " hits");
  RayContext context(true);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    alignas(64) int valid[kPacket] = {};
    alignas(64) RTCRayHit16 packet;
    pack(rays.subspan(first, count), impl_->tree.units_per_m(), valid, packet.ray);
    for (std::size_t i = 0; i < count; ++i)
      packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcIntersect16(valid, impl_->tree.native(), &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i) {
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + i] = {impl_->tree.m_per_unit() * packet.ray.tfar[i],
                         impl_->tree.triangle(packet.hit.geomID[i], packet.hit.primID[i]), packet.hit.u[i],
                         packet.hit.v[i]};
    }
  }
}

void RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  PHOS_CHECK(rays.size() == blocked.size(), rays.size(), " rays, ", blocked.size(), " answers");
  RayContext context(true);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    if (count == 1) {
      blocked[first] = occluded(rays[first]);
      break;
    }
    alignas(64) int valid[kPacket] = {};
    alignas(64) RTCRay16 packet;
    pack(rays.subspan(first, count), impl_->tree.units_per_m(), valid, packet);
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcOccluded16(valid, impl_->tree.native(), &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i)
      blocked[first + i] = packet.tfar[i] == -std::numeric_limits<float>::infinity();
  }
}

bool RayScene::occluded(const Ray& ray) const {
  RayContext context;
  RTCRayHit query = embree_ray(ray, impl_->tree.units_per_m());
  const NoFloatTraps traps;  // Embree divides by zero components of directions
  rtcOccluded1(impl_->tree.native(), &context.embree, &query.ray);
  return query.ray.tfar < 0;
}

bool RayScene::has_panes() const { return impl_->tree.has_panes(); }

bool RayScene::through(const Ray& ray, Hit& hit, std::vector<Crossing>& crossings) const {
  crossings.clear();
  if (!impl_->tree.has_panes()) return intersect(ray, hit);
  PaneLog& log = fresh_log();
  RayContext context(false, &log);
  alignas(16) RTCRayHit query = embree_ray(ray, impl_->tree.units_per_m());
  {
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcIntersect1(impl_->tree.native(), &context.embree, &query);
  }
  const bool found = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  if (found)
    hit = {impl_->tree.m_per_unit() * query.ray.tfar,
           impl_->tree.triangle(query.hit.geomID, query.hit.primID), query.hit.u, query.hit.v};
  const PaneHit* end = find_crossings(*this, ray, log.of(0, found ? hit.distance_m : kInfinity), crossings);
  if (end) hit = {end->distance_m, end->triangle, end->u, end->v};
  return found || end;
}

Rgb RayScene::transmittance(const Ray& ray) const {
  if (!impl_->tree.has_panes()) return Rgb(occluded(ray) ? 0.f : 1.f);
  PaneLog& log = fresh_log();
  RayContext context(false, &log);
  RTCRayHit query = embree_ray(ray, impl_->tree.units_per_m());
  {
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcOccluded1(impl_->tree.native(), &context.embree, &query.ray);
  }
  if (query.ray.tfar < 0) return Rgb(0);
  return straight_share(*this, ray, log.of(0, kInfinity));
}

void RayScene::transmittance(std::span<const Ray> rays, std::span<Rgb> shares) const {
  PHOS_CHECK(rays.size() == shares.size(), rays.size(), " rays, ", shares.size(), " answers");
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    if (count == 1) {
      shares[first] = transmittance(rays[first]);
      break;
    }
    PaneLog& log = fresh_log();
    RayContext context(true, &log);
    alignas(64) int valid[kPacket] = {};
    alignas(64) RTCRay16 packet;
    pack(rays.subspan(first, count), impl_->tree.units_per_m(), valid, packet);
    {
      const NoFloatTraps traps;  // Embree divides by zero components of directions
      rtcOccluded16(valid, impl_->tree.native(), &context.embree, &packet);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const bool blocked = packet.tfar[i] == -std::numeric_limits<float>::infinity();
      shares[first + i] =
          blocked ? Rgb(0)
                  : straight_share(*this, rays[first + i], log.of(static_cast<std::uint32_t>(i), kInfinity));
    }
  }
}

namespace {

bool clear_between(const RayScene& rays, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const Vec3 direction = normalized_or_zero(way);
  if (direction == Vec3(0)) return true;
  return !rays.occluded({from, direction, 0, glm::dot(way, direction)});
}

}  // namespace

bool RayScene::visible(const SurfacePoint& a, const SurfacePoint& b) const {
  const Vec3 way = b.position - a.position;
  // The nearer the origin of coordinates, the smaller a point's own bound; the ray carries the larger of the
  // two.
  SurfacePoint from = a, to = b;
  from.error_m = to.error_m = std::max(a.error_m, b.error_m);
  return clear_between(*this, from.leave(way), to.leave(-way));
}

bool RayScene::visible(const SurfacePoint& a, const Vec3& point, float error_m) const {
  const Ray ray = ray_between(a, point, error_m);
  return !(ray.t_max_m > 0) || !occluded(ray);
}

Ray ray_between(const SurfacePoint& from, const Vec3& to, float error_m) {
  const Vec3 origin = from.leave(to - from.position), way = to - origin;
  const Vec3 direction = normalized_or_zero(way);
  return {origin, direction, 0, glm::dot(way, direction) - std::max(error_m, from.error_m)};
}

void RayScene::ask_ahead(std::span<const Hit> hits, std::size_t turn) const {
  constexpr std::size_t kAhead = 8, kLarge = 4096;  // hits; triangles
  const Scene& scene = impl_->tree.scene();
  if (scene.triangle.size() < kLarge) return;
  if (turn + 2 * kAhead < hits.size()) {
    if (const Hit& later = hits[turn + 2 * kAhead]; std::isfinite(later.distance_m)) {
      __builtin_prefetch(&impl_->tree.facet(later.triangle));
      __builtin_prefetch(&scene.triangle[later.triangle]);
    }
  }
  if (turn + kAhead >= hits.size()) return;
  const Hit& soon = hits[turn + kAhead];
  if (!std::isfinite(soon.distance_m)) return;
  const Facet& facet = impl_->tree.facet(soon.triangle);
  const bool mapped = impl_->reads[facet.material].uv0;
  for (const std::uint32_t v : scene.triangle[soon.triangle].v) {
    if (!facet.flat) __builtin_prefetch(&scene.normal[v]);
    if (mapped) __builtin_prefetch(&scene.uv0[v]);
  }
}

SurfacePoint RayScene::surface(const Ray& ray, const Hit& hit) const {
  const Facet& facet = impl_->tree.facet(hit.triangle);
  const float weight[3] = {1 - hit.u - hit.v, hit.u, hit.v};

  SurfacePoint point;
  point.triangle = hit.triangle;
  point.instance = facet.instance;
  point.material = facet.material;
  point.distance_m = hit.distance_m;
  point.error_m = facet.offset_m;
  // In double: the point then lies on the plane to within the rounding of its coordinates.
  const double u = hit.u, v = hit.v, w = 1 - u - v;
  const auto& [a, b, c] = facet.corner;
  point.position =
      Vec3(static_cast<float>(w * a.x + u * b.x + v * c.x), static_cast<float>(w * a.y + u * b.y + v * c.y),
           static_cast<float>(w * a.z + u * b.z + v * c.z));
  point.front = glm::dot(ray.direction, facet.normal) <= 0;
  point.geometric_normal = point.front ? facet.normal : -facet.normal;
  shade(impl_->tree.scene(), impl_->reads[point.material], weight, -ray.direction, point, facet.flat);
  return point;
}

bool trace(const RayScene& rays, const Ray& ray, SurfacePoint& point) {
  Hit hit;
  if (!rays.intersect(ray, hit)) return false;
  point = rays.surface(ray, hit);
  return true;
}

void declare_isa(Options& options, std::string& isa) {
  options.choice<std::string>(
      "isa", isa,
      {{"best", ""},
       {"sse2", "sse2"},
       {"sse4.2", "sse4.2"},
       {"avx", "avx"},
       {"avx2", "avx2"},
       {"avx512", "avx512"}},
      "instruction set of the ray tracer; best: the widest of this machine; sse2: the same bytes on all x86 "
      "processors of one maker (each maker rounds reciprocals in its own way)");
}

}  // namespace phos::inline scene
