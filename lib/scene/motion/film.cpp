#include "scene/motion/film.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/error.h"
#include "scene/instance_bounds.h"
#include "scene/luminaire/photometry.h"

namespace phos::inline scene {
namespace {

/// A triangle whose winding a mirroring transform turned is the same.
bool same_corners(const Triangle& a, const Triangle& b) {
  return a.v[0] == b.v[0] && std::minmax({a.v[1], a.v[2]}) == std::minmax({b.v[1], b.v[2]});
}

bool same_instance(const Scene& a, const Scene& b, std::size_t i) {
  const Instance &x = a.instance[i], &y = b.instance[i];
  if (x.node != y.node || x.material != y.material || x.first_triangle != y.first_triangle ||
      x.triangle_count != y.triangle_count) {
    return false;
  }
  for (std::uint32_t t = x.first_triangle; t < x.first_triangle + x.triangle_count; ++t)
    if (!same_corners(a.triangle[t], b.triangle[t])) return false;
  return true;
}

void require_one_scene(const Scene& a, const Scene& b) {
  const auto fail = [&](const std::string& what) {
    throw Error(
        ExitCode::bad_input, b.path,
        what +
            ": the scene has changed between two of its frames; was it exported again meanwhile? Start anew");
  };
  const std::size_t n = std::min(a.instance.size(), b.instance.size());
  for (std::size_t i = 0; i < n; ++i)
    if (!same_instance(a, b, i)) fail(text("\"", b.instance[i].node, "\" has other triangles"));
  if (a.instance.size() != b.instance.size())
    fail(text("\"", (a.instance.size() > n ? a : b).instance[n].node, "\" exists in one frame alone"));
  if (a.position.size() != b.position.size() || a.material.size() != b.material.size())
    fail("vertices or materials are others");
}

template <class Visit>
void for_each_vertex(const Scene& scene, std::size_t instance, const Visit& visit) {
  const Instance& i = scene.instance[instance];
  for (std::uint32_t t = i.first_triangle; t < i.first_triangle + i.triangle_count; ++t)
    for (const std::uint32_t v : scene.triangle[t].v) visit(v);
}

bool is_turned_over(const Scene& a, const Scene& b, std::size_t instance) {
  const std::uint32_t t = a.instance[instance].first_triangle;
  return a.triangle[t].v[1] != b.triangle[t].v[1];
}

bool has_moved(const Scene& a, const Scene& b, std::size_t instance) {
  bool moved = is_turned_over(a, b, instance);
  for_each_vertex(a, instance, [&](std::uint32_t v) {
    moved = moved || a.position[v] != b.position[v] || a.normal[v] != b.normal[v];
  });
  return moved;
}

/// The flux of directional and environment light also depends on how large the scene is.
bool same_lamp(const Light& a, const Light& b) {
  return a.kind == b.kind && a.name == b.name && a.position == b.position && a.direction == b.direction &&
         a.intensity == b.intensity && a.cos_inner == b.cos_inner && a.cos_outer == b.cos_outer &&
         a.instance == b.instance && (a.kind != Light::Kind::area || a.flux_lm == b.flux_lm);
}

bool same_fitting(const Fitting& a, const Fitting& b) {
  return a.axes() == b.axes() && a.colour() == b.colour() && a.photometry().hash() == b.photometry().hash();
}

std::string materials_hash(const Scene& scene) {
  const Json* hash = scene.parts.find("materials");
  return hash ? hash->as_string() : "";
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.name == b.name && a.to_world == b.to_world && a.perspective == b.perspective &&
         a.yfov_rad == b.yfov_rad && a.ymag_m == b.ymag_m && a.aspect == b.aspect;
}

}  // namespace

void require_frames(const Scene& scene, const FrameRange& range) {
  if (scene.animation.empty()) return;
  const std::int64_t last = std::max<std::int64_t>(scene.frames, 1) - 1;
  if (range.first >= 0 && range.last <= last) return;
  throw Error(ExitCode::usage, "--frames",
              text(range.first, ":", range.last, " goes beyond the animation of ", scene.path,
                   ", whose frames are 0:", last, "; give frames of that range"));
}

Scene load_frame(const std::string& path, const SceneOptions& options, std::int64_t frame) {
  if (options.time_s || options.frame)
    throw Error(ExitCode::usage, options.time_s ? "--time" : "--frame",
                "states another time than --frames; leave it out");
  SceneOptions at = options;
  at.frame = static_cast<double>(frame);
  return load_scene(path, at);
}

bool Changes::anything_moved() const { return std::find(moved.begin(), moved.end(), true) != moved.end(); }

Changes changes(const Scene& a, const Scene& b) {
  require_one_scene(a, b);
  Changes out;
  for (std::size_t i = 0; i < a.instance.size(); ++i) out.moved.push_back(has_moved(a, b, i));
  out.lights =
      !std::equal(a.light.begin(), a.light.end(), b.light.begin(), b.light.end(), same_lamp) ||
      !std::equal(a.fitting.begin(), a.fitting.end(), b.fitting.begin(), b.fitting.end(), same_fitting);
  for (const Light& light : a.light)
    out.lights = out.lights || (light.kind == Light::Kind::area && out.moved[light.instance]);
  out.materials = materials_hash(a) != materials_hash(b);
  out.cameras = !std::equal(a.camera.begin(), a.camera.end(), b.camera.begin(), b.camera.end(), same_camera);
  return out;
}

namespace {

constexpr float kFarBeyond = 4;  // times the steps before and after
constexpr float kOwnSize = 0.1f, kSceneSize = 0.05f, kLampPlace = 0.01f;
constexpr float kFlux = 0.1f, kAngle_rad = 0.1f;

/// A quantity's steps a to b, b to c, c to d, and how large the middle one must be to matter.
bool is_jump(float before, float step, float after, float large) {
  return step > large && step > kFarBeyond * std::max(before, after);
}

bool has_area(const Scene& scene, std::size_t instance) {
  const Instance& i = scene.instance[instance];
  for (std::uint32_t t = i.first_triangle; t < i.first_triangle + i.triangle_count; ++t)
    if (geometric_normal(scene, t) != Vec3(0)) return true;
  return false;
}

float object_step_m(const Scene& a, const Scene& b, std::size_t instance) {
  const bool from = has_area(a, instance), to = has_area(b, instance);
  if (!from && !to) return 0;
  // Where it was while nothing saw it is no matter, but how large.
  const Vec3 way =
      from && to ? Vec3(0)
                 : bounds_of(b, b.instance[instance]).centre() - bounds_of(a, a.instance[instance]).centre();
  float step = 0;
  for_each_vertex(a, instance, [&](std::uint32_t v) {
    step = std::max(step, glm::distance(a.position[v], b.position[v] - way));
  });
  return step;
}

bool object_jumps(const Scene& a, const Scene& b, const Scene& c, const Scene& d, std::size_t i,
                  float scene_m) {
  const float step = object_step_m(b, c, i);
  if (step == 0) return false;
  const float size =
      std::max(bounds_of(b, b.instance[i]).diagonal_m(), bounds_of(c, c.instance[i]).diagonal_m());
  if (is_turned_over(b, c, i)) return true;
  const float large = std::min(kOwnSize * size, kSceneSize * scene_m);
  return step > large && is_jump(object_step_m(a, b, i), step, object_step_m(c, d, i), large);
}

/// A lamp is the same at another time if its kind and name are, and as many like it come before; an area
/// light, if its instance is.
using LampKey = std::pair<std::pair<Light::Kind, std::string>, std::uint32_t>;
using Lamps = std::map<LampKey, Light>;

Lamps lamps_of(const Scene& scene) {
  Lamps lamps;
  for (const Light& light : scene.light) {
    if (light.kind == Light::Kind::environment) continue;
    LampKey key{{light.kind, light.name}, light.kind == Light::Kind::area ? light.instance : 0};
    while (!lamps.emplace(key, light).second) ++key.second;
  }
  return lamps;
}

const Light* find(const Lamps& lamps, const LampKey& key) {
  const auto it = lamps.find(key);
  return it == lamps.end() ? nullptr : &it->second;
}

Rgb brightness(const Light* light) {
  if (!light) return Rgb(0);
  return light->kind == Light::Kind::directional ? light->intensity : light->flux_lm;
}
float flux_step(const Light* a, const Light* b) {
  return max_component(glm::abs(brightness(a) - brightness(b)));
}
float place_step_m(const Light* a, const Light* b) {
  if (!a || !b || a->kind == Light::Kind::directional || a->kind == Light::Kind::area) return 0;
  return glm::distance(a->position, b->position);
}
float turn_step_rad(const Light* a, const Light* b) {
  if (!a || !b || a->kind == Light::Kind::point || a->kind == Light::Kind::area) return 0;
  return 2 * std::asin(std::min(0.5f * glm::distance(a->direction, b->direction), 1.0f));
}

}  // namespace

bool jumps(const Scene& a, const Scene& b, const Scene& c, const Scene& d) {
  const float scene_m = std::max(b.bounds.diagonal_m(), c.bounds.diagonal_m());
  for (const Scene* other : {&a, &c, &d}) require_one_scene(b, *other);
  for (std::size_t i = 0; i < b.instance.size(); ++i)
    if (object_jumps(a, b, c, d, i, scene_m)) return true;

  const Lamps lamps[4] = {lamps_of(a), lamps_of(b), lamps_of(c), lamps_of(d)};
  std::set<LampKey> keys;
  for (const Lamps& some : {lamps[1], lamps[2]})
    for (const auto& [key, light] : some) keys.insert(key);
  for (const LampKey& key : keys) {
    const Light* at[4];
    for (int t = 0; t < 4; ++t) at[t] = find(lamps[t], key);
    const auto jump = [&](float (*step)(const Light*, const Light*), float large) {
      return is_jump(step(at[0], at[1]), step(at[1], at[2]), step(at[2], at[3]), large);
    };
    const float flux = std::max(max_component(brightness(at[1])), max_component(brightness(at[2])));
    if (jump(flux_step, kFlux * flux) || jump(place_step_m, kLampPlace * scene_m) ||
        jump(turn_step_rad, kAngle_rad)) {
      return true;
    }
  }
  return false;
}

}  // namespace phos::inline scene
