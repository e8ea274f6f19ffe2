#include "scene/rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/interrupt.h"
#include "core/last_words.h"
#include "core/options.h"
#include "core/parallel.h"
#include "scene/material/filled_glass.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/offset.h"
#include "scene/shading_frame.h"
#include "scene/texture/visible_share.h"

namespace phos::inline scene {

namespace {

// Geometries: surfaces that are hit; surfaces that are hit but for holes; surfaces that light may pass
// straight.
constexpr unsigned kOpaque = 0, kMasked = 1, kPane = 2, kGeometries = 3;

/// The data of a triangle that every hit needs, in one cache line.
struct alignas(64) Facet {
  Vec3 corner[3];
  Vec3 normal;  // of the front side
  float offset_m;
  std::uint32_t instance, material;
  bool flat;  // the vertices have that normal too
};
static_assert(sizeof(Facet) == 64);

/// Vertex normals are rounded: one that differs by less than this from the triangle's own is the same.
bool is_flat(const Scene& scene, const Triangle& triangle, const Vec3& normal) {
  if (scene.normal.empty()) return true;
  return std::all_of(std::begin(triangle.v), std::end(triangle.v), [&](std::uint32_t v) {
    const Vec3 gap = glm::abs(scene.normal[v] - normal);
    return std::max({gap.x, gap.y, gap.z}) <= 0x1p-20f;
  });
}

/// A texel that rays pass through.
bool is_hole(const Scene& scene, std::uint32_t triangle, float u, float v) {
  return alpha_at(scene, triangle, u, v) < scene.material_of(triangle).alpha_cutoff;
}

/// Hits on panes, of rays that go on: of each ray of a packet, in any order.
struct PaneLog {
  struct Entry {
    std::uint32_t ray;
    PaneHit hit;
  };
  std::vector<Entry> entries;

  /// Of one ray, up to a distance; valid until the next call.
  std::span<PaneHit> of(std::uint32_t ray, float end_m) {
    own_.clear();
    for (const Entry& e : entries)
      if (e.ray == ray && e.hit.distance_m <= end_m) own_.push_back(e.hit);
    return own_;
  }

 private:
  std::vector<PaneHit> own_;
};

/// What is passed to Embree with a ray; `log`: where hits on panes are put down, while the ray goes on; null:
/// they are hits like others.
struct Context {
  RTCIntersectContext embree;  // first, as Embree hands on its address
  PaneLog* log = nullptr;

  explicit Context(bool side_by_side = false, PaneLog* pane_log = nullptr) : log(pane_log) {
    rtcInitIntersectContext(&embree);
    if (side_by_side) embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
};

PaneLog& fresh_log() {
  thread_local PaneLog log;
  log.entries.clear();
  return log;
}

/// Lengths of a scene in units of the tree, a power of two so that nothing is rounded. Embree takes triangles
/// of less than 1e-18 square units for points; scenes that metres suit are left in metres.
float tree_units_per_m(const Scene& scene) {
  Bounds bounds;
  for (const Vec3& p : scene.position) bounds.include(p);
  const float size_m = max_component(bounds.size());
  if (!(size_m > 0) || !std::isfinite(size_m) || (size_m >= 0x1p-8f && size_m <= 0x1p20f)) return 1;
  return std::ldexp(1.f, std::clamp(-std::ilogb(size_m), -126, 126));
}

constexpr std::size_t kPacket = 16;

/// At most that many rays.
void pack(std::span<const Ray> rays, float units_per_m, int (&valid)[kPacket], RTCRay16& packet) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    valid[i] = -1;
    const Vec3 origin = units_per_m * ray.origin;
    packet.org_x[i] = origin.x, packet.org_y[i] = origin.y, packet.org_z[i] = origin.z;
    packet.dir_x[i] = ray.direction.x, packet.dir_y[i] = ray.direction.y, packet.dir_z[i] = ray.direction.z;
    packet.tnear[i] = units_per_m * ray.t_min_m, packet.tfar[i] = units_per_m * ray.t_max_m;
    packet.time[i] = 0, packet.mask[i] = 0xffffffffu;
    packet.id[i] = static_cast<unsigned>(i), packet.flags[i] = 0;
  }
  // Where the machine's packets are narrower, Embree takes no notice of `valid` but of a ray's interval.
  std::fill(packet.tnear + rays.size(), packet.tnear + kPacket, 0.f);
  std::fill(packet.tfar + rays.size(), packet.tfar + kPacket, -1.f);
}

RTCRayHit embree_ray(const Ray& ray, float units_per_m) {
  RTCRayHit query;
  const Vec3 origin = units_per_m * ray.origin;
  query.ray.org_x = origin.x, query.ray.org_y = origin.y, query.ray.org_z = origin.z;
  query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
  query.ray.tnear = units_per_m * ray.t_min_m, query.ray.tfar = units_per_m * ray.t_max_m;
  query.ray.time = 0;
  query.ray.mask = 0xffffffffu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct RayScene::Impl {
  explicit Impl(const Scene& s) : scene(s) {}
  ~Impl() {
    if (tree) rtcReleaseScene(tree);
    if (device) rtcReleaseDevice(device);
  }

  const Scene& scene;
  float units_per_m = 1, m_per_unit = 1;
  RTCDevice device = nullptr;
  RTCScene tree = nullptr;
  std::vector<std::uint32_t>
      triangle_of[kGeometries];  // per Embree geometry; empty where primitive i is triangle i
  std::vector<Facet> facet;      // per triangle
  std::vector<Reads> reads;      // per material

  std::string trouble;  // the last message of Embree

  void make_device(const std::string& isa);
  void throw_if_failed() const;
  void make_facets();
  void attach(unsigned geometry, const std::vector<std::uint32_t>* triangles);
  void build();
  std::uint32_t triangle(unsigned geometry, unsigned primitive) const {
    return triangle_of[geometry].empty() ? primitive : triangle_of[geometry][primitive];
  }
  unsigned geometry_of(std::uint32_t triangle, const std::vector<std::uint8_t>& straight,
                       const std::vector<std::uint8_t>& filled) const;
  bool has_panes() const { return !triangle_of[kPane].empty(); }
  static void filter(const RTCFilterFunctionNArguments* args);
  static void pane_filter(const RTCFilterFunctionNArguments* args);
  Rgb transmittance(const RayScene& self, const Ray& ray, std::span<PaneHit> hits) const;
};

void RayScene::Impl::make_device(const std::string& isa) {
  // Embree takes no notice of a name it does not know.
  const char* const known[] = {"", "sse2", "sse4.2", "avx", "avx2", "avx512"};
  if (std::find(std::begin(known), std::end(known), isa) == std::end(known)) {
    throw Error(ExitCode::usage, "--isa",
                text("unknown instruction set \"", isa, "\"; use sse2, sse4.2, avx, avx2 or avx512"));
  }
  const std::string config = "isa=" + isa;
  const NoFloatTraps traps;
  device = rtcNewDevice(isa.empty() ? nullptr : config.c_str());
  if (device) {
    const auto listen = [](void* own, RTCError, const char* said) {
      static_cast<Impl*>(own)->trouble = said;
    };
    rtcSetDeviceErrorFunction(device, listen, this);
    return;
  }
  const RTCError error = rtcGetDeviceError(nullptr);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ExitCode::no_memory, "", "not enough memory to start the ray tracer; use a larger machine");
  throw Error(ExitCode::usage, isa.empty() ? "" : "--isa",
              text("Embree cannot start", isa.empty() ? "" : " with instruction set \"" + isa + "\"",
                   " (error ", static_cast<int>(error), "); use one that this machine has, such as sse2"));
}

void RayScene::Impl::throw_if_failed() const {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  if (code == RTC_ERROR_OUT_OF_MEMORY || for_want_of_memory(trouble.c_str()))
    throw Error(ExitCode::no_memory, "",
                "not enough memory for the ray tracing structure; use a smaller scene or a larger machine");
  throw Error(
      ExitCode::bad_input, "",
      text("Embree cannot build the ray tracing structure (", trouble, "); check the scene with phos-scene"));
}

void RayScene::Impl::make_facets() {
  facet.resize(scene.triangle.size());
  parallel_for(facet.size(), 4096, [&](std::size_t i) {
    const auto& v = scene.triangle[i].v;
    const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
    const Vec3 normal = normal_of(a, b, c);
    const std::uint32_t instance = scene.triangle_instance[i];
    facet[i] = {{a, b, c},
                normal,
                phos::offset_m(a, b, c),
                instance,
                scene.instance[instance].material,
                is_flat(scene, scene.triangle[i], normal)};
  });
}

/// Called for each candidate hit of the masked geometry, one ray at a time.
void RayScene::Impl::filter(const RTCFilterFunctionNArguments* args) {
  const Impl& impl = *static_cast<const Impl*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t triangle = impl.triangle(kMasked, RTCHitN_primID(args->hit, args->N, i));
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    if (is_hole(impl.scene, triangle, u, v)) args->valid[i] = 0;
  }
}

/// The same of panes: a ray that keeps a log goes on.
void RayScene::Impl::pane_filter(const RTCFilterFunctionNArguments* args) {
  const Impl& impl = *static_cast<const Impl*>(args->geometryUserPtr);
  PaneLog* log = reinterpret_cast<const Context*>(args->context)->log;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t triangle = impl.triangle(kPane, RTCHitN_primID(args->hit, args->N, i));
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    const bool masked =
        impl.scene.material[impl.facet[triangle].material].alpha_mode == Material::Alpha::mask;
    if (masked && is_hole(impl.scene, triangle, u, v)) {
      args->valid[i] = 0;
    } else if (log) {
      const float distance_m = impl.m_per_unit * RTCRayN_tfar(args->ray, args->N, i);
      log->entries.push_back({RTCRayN_id(args->ray, args->N, i), {distance_m, triangle, u, v}});
      args->valid[i] = 0;
    }
  }
}

void RayScene::Impl::attach(unsigned id, const std::vector<std::uint32_t>* triangles) {
  const std::size_t count = triangles ? triangles->size() : scene.triangle.size();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree's own buffers: it reads 16 bytes at the last vertex, which an array of Vec3 does not have.
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3), scene.position.size());
  auto* indices = static_cast<Triangle*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), count));
  if (vertices && indices) {
    std::transform(scene.position.begin(), scene.position.end(), static_cast<Vec3*>(vertices),
                   [this](const Vec3& p) { return units_per_m * p; });
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t t = triangles ? (*triangles)[i] : static_cast<std::uint32_t>(i);
      const auto& v = scene.triangle[t].v;
      // Without area it must not be hit, whatever its rounded edges say.
      indices[i] = geometric_normal(scene, t) == Vec3(0) ? Triangle{{v[0], v[0], v[0]}} : scene.triangle[t];
    }
    if (id == kMasked) {
      rtcSetGeometryUserData(geometry, this);
      rtcSetGeometryIntersectFilterFunction(geometry, filter);
      rtcSetGeometryOccludedFilterFunction(geometry, filter);
    } else if (id == kPane) {
      rtcSetGeometryUserData(geometry, this);
      rtcSetGeometryIntersectFilterFunction(geometry, pane_filter);
      rtcSetGeometryOccludedFilterFunction(geometry, pane_filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, id);
  }
  rtcReleaseGeometry(geometry);
  throw_if_failed();
}

/// Plane faces of solid glass may have parallel ones behind them. `straight` tells of materials, `filled` of
/// triangles.
unsigned RayScene::Impl::geometry_of(std::uint32_t triangle, const std::vector<std::uint8_t>& straight,
                                     const std::vector<std::uint8_t>& filled) const {
  const Facet& f = facet[triangle];
  const Material& m = scene.material[f.material];
  const bool block = !filled.empty() && filled[triangle];
  if (straight[f.material] || (is_solid_glass(m) && f.flat && !block)) return kPane;
  return m.alpha_mode == Material::Alpha::mask ? kMasked : kOpaque;
}

void RayScene::Impl::build() {
  units_per_m = tree_units_per_m(scene), m_per_unit = 1 / units_per_m;
  tree = rtcNewScene(device);
  throw_if_failed();
  rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
  std::vector<std::uint8_t> straight;  // per material
  for (const Material& m : scene.material) straight.push_back(passes_straight(scene, m));
  const std::vector<std::uint8_t> filled = find_filled_glass(scene);
  std::vector<std::uint32_t> triangles[kGeometries];
  for (std::uint32_t i = 0; i < scene.triangle.size(); ++i)
    triangles[geometry_of(i, straight, filled)].push_back(i);
  if (triangles[kOpaque].size() == scene.triangle.size()) {
    if (!scene.triangle.empty()) attach(kOpaque, nullptr);
  } else {
    for (unsigned id = 0; id < kGeometries; ++id) {
      triangle_of[id] = std::move(triangles[id]);
      if (!triangle_of[id].empty()) attach(id, &triangle_of[id]);
    }
  }
  const NoFloatTraps traps;  // Embree divides by zero extents
  const StopAtOnce stop;     // and does not look
  rtcCommitScene(tree);
  throw_if_failed();
}

RayScene::RayScene(const Scene& scene, const RayOptions& options) : impl_(std::make_unique<Impl>(scene)) {
  impl_->make_device(options.isa);
  impl_->make_facets();
  for (const Material& material : scene.material) impl_->reads.push_back(reads_of(scene, material));
  impl_->build();
}

RayScene::~RayScene() = default;

const Scene& RayScene::scene() const { return impl_->scene; }

void* RayScene::native() const { return impl_->tree; }

bool RayScene::intersect(const Ray& ray, Hit& hit) const {
  Context context;
  alignas(16) RTCRayHit query = embree_ray(ray, impl_->units_per_m);
  const NoFloatTraps traps;  // Embree divides by zero components of directions
  rtcIntersect1(impl_->tree, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.distance_m = impl_->m_per_unit * query.ray.tfar;
  hit.triangle = impl_->triangle(query.hit.geomID, query.hit.primID);
  hit.u = query.hit.u, hit.v = query.hit.v;
  return true;
}

void RayScene::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
  PHOS_CHECK(rays.size() == hits.size(), rays.size(), " rays, ", hits.size(), " hits");
  Context context(true);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    alignas(64) int valid[kPacket] = {};
    alignas(64) RTCRayHit16 packet;
    pack(rays.subspan(first, count), impl_->units_per_m, valid, packet.ray);
    for (std::size_t i = 0; i < count; ++i)
      packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcIntersect16(valid, impl_->tree, &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i) {
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + i] = {impl_->m_per_unit * packet.ray.tfar[i],
                         impl_->triangle(packet.hit.geomID[i], packet.hit.primID[i]), packet.hit.u[i],
                         packet.hit.v[i]};
    }
  }
}

void RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  PHOS_CHECK(rays.size() == blocked.size(), rays.size(), " rays, ", blocked.size(), " answers");
  Context context(true);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    if (count == 1) {
      blocked[first] = occluded(rays[first]);
      break;
    }
    alignas(64) int valid[kPacket] = {};
    alignas(64) RTCRay16 packet;
    pack(rays.subspan(first, count), impl_->units_per_m, valid, packet);
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcOccluded16(valid, impl_->tree, &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i)
      blocked[first + i] = packet.tfar[i] == -std::numeric_limits<float>::infinity();
  }
}

bool RayScene::occluded(const Ray& ray) const {
  Context context;
  RTCRayHit query = embree_ray(ray, impl_->units_per_m);
  const NoFloatTraps traps;  // Embree divides by zero components of directions
  rtcOccluded1(impl_->tree, &context.embree, &query.ray);
  return query.ray.tfar < 0;
}

bool RayScene::has_panes() const { return impl_->has_panes(); }

bool RayScene::through(const Ray& ray, Hit& hit, std::vector<Crossing>& crossings) const {
  crossings.clear();
  if (!impl_->has_panes()) return intersect(ray, hit);
  PaneLog& log = fresh_log();
  Context context(false, &log);
  alignas(16) RTCRayHit query = embree_ray(ray, impl_->units_per_m);
  {
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcIntersect1(impl_->tree, &context.embree, &query);
  }
  const bool found = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  if (found)
    hit = {impl_->m_per_unit * query.ray.tfar, impl_->triangle(query.hit.geomID, query.hit.primID),
           query.hit.u, query.hit.v};
  const PaneHit* end = find_crossings(*this, ray, log.of(0, found ? hit.distance_m : kInfinity), crossings);
  if (end) hit = {end->distance_m, end->triangle, end->u, end->v};
  return found || end;
}

/// Of a ray that nothing else is in the way of.
Rgb RayScene::Impl::transmittance(const RayScene& self, const Ray& ray, std::span<PaneHit> hits) const {
  if (hits.empty()) return Rgb(1);
  thread_local std::vector<Crossing> crossings;
  if (find_crossings(self, ray, hits, crossings)) return Rgb(0);
  StraightLight light;
  for (const Crossing& c : crossings) light.add(c, ray.direction);
  return light.transmittance() * light.nearer(ray.t_max_m);
}

Rgb RayScene::transmittance(const Ray& ray) const {
  if (!impl_->has_panes()) return Rgb(occluded(ray) ? 0.f : 1.f);
  PaneLog& log = fresh_log();
  Context context(false, &log);
  RTCRayHit query = embree_ray(ray, impl_->units_per_m);
  {
    const NoFloatTraps traps;  // Embree divides by zero components of directions
    rtcOccluded1(impl_->tree, &context.embree, &query.ray);
  }
  if (query.ray.tfar < 0) return Rgb(0);
  return impl_->transmittance(*this, ray, log.of(0, kInfinity));
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
    Context context(true, &log);
    alignas(64) int valid[kPacket] = {};
    alignas(64) RTCRay16 packet;
    pack(rays.subspan(first, count), impl_->units_per_m, valid, packet);
    {
      const NoFloatTraps traps;  // Embree divides by zero components of directions
      rtcOccluded16(valid, impl_->tree, &context.embree, &packet);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const bool blocked = packet.tfar[i] == -std::numeric_limits<float>::infinity();
      shares[first + i] = blocked ? Rgb(0)
                                  : impl_->transmittance(*this, rays[first + i],
                                                         log.of(static_cast<std::uint32_t>(i), kInfinity));
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
  const Scene& scene = impl_->scene;
  if (scene.triangle.size() < kLarge) return;
  if (turn + 2 * kAhead < hits.size()) {
    if (const Hit& later = hits[turn + 2 * kAhead]; std::isfinite(later.distance_m)) {
      __builtin_prefetch(&impl_->facet[later.triangle]);
      __builtin_prefetch(&scene.triangle[later.triangle]);
    }
  }
  if (turn + kAhead >= hits.size()) return;
  const Hit& soon = hits[turn + kAhead];
  if (!std::isfinite(soon.distance_m)) return;
  const Facet& facet = impl_->facet[soon.triangle];
  const bool mapped = impl_->reads[facet.material].uv0;
  for (const std::uint32_t v : scene.triangle[soon.triangle].v) {
    if (!facet.flat) __builtin_prefetch(&scene.normal[v]);
    if (mapped) __builtin_prefetch(&scene.uv0[v]);
  }
}

SurfacePoint RayScene::surface(const Ray& ray, const Hit& hit) const {
  const Facet& facet = impl_->facet[hit.triangle];
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
  shade(impl_->scene, impl_->reads[point.material], weight, -ray.direction, point, facet.flat);
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
