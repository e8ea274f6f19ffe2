#include "scene/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/interrupt.h"
#include "core/last_words.h"
#include "core/parallel.h"
#include "scene/material/filled_glass.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/offset.h"
#include "scene/ray_query.h"
#include "scene/shading_frame.h"
#include "scene/texture/visible_share.h"

namespace phos::inline scene {

namespace {

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

/// Lengths of a scene in units of the tree, a power of two so that nothing is rounded. Embree takes triangles
/// of less than 1e-18 square units for points; scenes that metres suit are left in metres.
float tree_units_per_m(const Scene& scene) {
  Bounds bounds;
  for (const Vec3& p : scene.position) bounds.include(p);
  const float size_m = max_component(bounds.size());
  if (!(size_m > 0) || !std::isfinite(size_m) || (size_m >= 0x1p-8f && size_m <= 0x1p20f)) return 1;
  return std::ldexp(1.f, std::clamp(-std::ilogb(size_m), -126, 126));
}

}  // namespace

RayTree::RayTree(const Scene& scene, const std::string& isa) : RayTree(scene) {
  make_device(isa);
  make_facets();
  build();
}

RayTree::~RayTree() {
  if (tree_) rtcReleaseScene(tree_);
  if (device_) rtcReleaseDevice(device_);
}

void RayTree::make_device(const std::string& isa) {
  // Embree takes no notice of a name it does not know.
  const char* const known[] = {"", "sse2", "sse4.2", "avx", "avx2", "avx512"};
  if (std::find(std::begin(known), std::end(known), isa) == std::end(known)) {
    throw Error(ExitCode::usage, "--isa",
                text("unknown instruction set \"", isa, "\"; use sse2, sse4.2, avx, avx2 or avx512"));
  }
  const std::string config = "isa=" + isa;
  const NoFloatTraps traps;
  device_ = rtcNewDevice(isa.empty() ? nullptr : config.c_str());
  if (device_) {
    const auto listen = [](void* own, RTCError, const char* said) {
      static_cast<RayTree*>(own)->trouble_ = said;
    };
    rtcSetDeviceErrorFunction(device_, listen, this);
    return;
  }
  const RTCError error = rtcGetDeviceError(nullptr);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ExitCode::no_memory, "", "not enough memory to start the ray tracer; use a larger machine");
  throw Error(ExitCode::usage, isa.empty() ? "" : "--isa",
              text("Embree cannot start", isa.empty() ? "" : " with instruction set \"" + isa + "\"",
                   " (error ", static_cast<int>(error), "); use one that this machine has, such as sse2"));
}

void RayTree::throw_if_failed() const {
  const RTCError code = rtcGetDeviceError(device_);
  if (code == RTC_ERROR_NONE) return;
  if (code == RTC_ERROR_OUT_OF_MEMORY || for_want_of_memory(trouble_.c_str()))
    throw Error(ExitCode::no_memory, "",
                "not enough memory for the ray tracing structure; use a smaller scene or a larger machine");
  throw Error(ExitCode::bad_input, "",
              text("Embree cannot build the ray tracing structure (", trouble_,
                   "); check the scene with phos-scene"));
}

void RayTree::make_facets() {
  facet_.resize(scene_.triangle.size());
  parallel_for(facet_.size(), 4096, [&](std::size_t i) {
    const auto& v = scene_.triangle[i].v;
    const Vec3 &a = scene_.position[v[0]], &b = scene_.position[v[1]], &c = scene_.position[v[2]];
    const Vec3 normal = normal_of(a, b, c);
    const std::uint32_t instance = scene_.triangle_instance[i];
    facet_[i] = {{a, b, c},
                 normal,
                 phos::offset_m(a, b, c),
                 instance,
                 scene_.instance[instance].material,
                 is_flat(scene_, scene_.triangle[i], normal)};
  });
}

/// Called for each candidate hit of the masked geometry, one ray at a time.
void RayTree::filter(const RTCFilterFunctionNArguments* args) {
  const RayTree& own = *static_cast<const RayTree*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t triangle = own.triangle(kMasked, RTCHitN_primID(args->hit, args->N, i));
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    if (is_hole(own.scene_, triangle, u, v)) args->valid[i] = 0;
  }
}

/// The same of panes: a ray that keeps a log goes on.
void RayTree::pane_filter(const RTCFilterFunctionNArguments* args) {
  const RayTree& own = *static_cast<const RayTree*>(args->geometryUserPtr);
  PaneLog* log = reinterpret_cast<const RayContext*>(args->context)->log;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t triangle = own.triangle(kPane, RTCHitN_primID(args->hit, args->N, i));
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    const bool masked =
        own.scene_.material[own.facet_[triangle].material].alpha_mode == Material::Alpha::mask;
    if (masked && is_hole(own.scene_, triangle, u, v)) {
      args->valid[i] = 0;
    } else if (log) {
      const float distance_m = own.m_per_unit() * RTCRayN_tfar(args->ray, args->N, i);
      log->entries.push_back({RTCRayN_id(args->ray, args->N, i), {distance_m, triangle, u, v}});
      args->valid[i] = 0;
    }
  }
}

void RayTree::attach(unsigned id, const std::vector<std::uint32_t>* triangles) {
  const std::size_t count = triangles ? triangles->size() : scene_.triangle.size();
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree's own buffers: it reads 16 bytes at the last vertex, which an array of Vec3 does not have.
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3), scene_.position.size());
  auto* indices = static_cast<Triangle*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), count));
  if (vertices && indices) {
    std::transform(scene_.position.begin(), scene_.position.end(), static_cast<Vec3*>(vertices),
                   [this](const Vec3& p) { return units_per_m_ * p; });
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t t = triangles ? (*triangles)[i] : static_cast<std::uint32_t>(i);
      const auto& v = scene_.triangle[t].v;
      // Without area it must not be hit, whatever its rounded edges say.
      indices[i] = geometric_normal(scene_, t) == Vec3(0) ? Triangle{{v[0], v[0], v[0]}} : scene_.triangle[t];
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
    rtcAttachGeometryByID(tree_, geometry, id);
  }
  rtcReleaseGeometry(geometry);
  throw_if_failed();
}

/// Plane faces of solid glass may have parallel ones behind them. `straight` tells of materials, `filled` of
/// triangles.
unsigned RayTree::geometry_of(std::uint32_t triangle, const std::vector<std::uint8_t>& straight,
                              const std::vector<std::uint8_t>& filled) const {
  const Facet& f = facet_[triangle];
  const Material& m = scene_.material[f.material];
  const bool block = !filled.empty() && filled[triangle];
  if (straight[f.material] || (is_solid_glass(m) && f.flat && !block)) return kPane;
  return m.alpha_mode == Material::Alpha::mask ? kMasked : kOpaque;
}

void RayTree::build() {
  units_per_m_ = tree_units_per_m(scene_), m_per_unit_ = 1 / units_per_m_;
  tree_ = rtcNewScene(device_);
  throw_if_failed();
  rtcSetSceneFlags(tree_, RTC_SCENE_FLAG_ROBUST);
  std::vector<std::uint8_t> straight;  // per material
  for (const Material& m : scene_.material) straight.push_back(passes_straight(scene_, m));
  const std::vector<std::uint8_t> filled = find_filled_glass(scene_);
  std::vector<std::uint32_t> triangles[kGeometries];
  for (std::uint32_t i = 0; i < scene_.triangle.size(); ++i)
    triangles[geometry_of(i, straight, filled)].push_back(i);
  if (triangles[kOpaque].size() == scene_.triangle.size()) {
    if (!scene_.triangle.empty()) attach(kOpaque, nullptr);
  } else {
    for (unsigned id = 0; id < kGeometries; ++id) {
      triangle_of_[id] = std::move(triangles[id]);
      if (!triangle_of_[id].empty()) attach(id, &triangle_of_[id]);
    }
  }
  const NoFloatTraps traps;  // Embree divides by zero extents
  const StopAtOnce stop;     // and does not look
  rtcCommitScene(tree_);
  throw_if_failed();
}

}  // namespace phos::inline scene
