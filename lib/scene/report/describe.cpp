#include "scene/report/describe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/origin.h"
#include "scene/luminaire/photometric_file.h"
#include "scene/material/merl.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/report/light_ways.h"
#include "scene/report/unsampled.h"
#include "scene/sky/environment.h"
#include "scene/spectral/bands.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

/// `colour`: mean luminance of the vertex colours.
void classify(const Scene& scene, double colour, MaterialSummary& s) {
  const Material& m = *s.material;
  const double base = luminance(Rgb(mean_texel(scene, m.base_colour))) * colour;
  const double kd = luminance(m.kd) * base, ks = luminance(m.ks);
  const double through = m.diffuse_transmission * mean_texel(scene, m.diffuse_transmission_map).w;
  static_cast<ReflectionSummary&>(s) = row_of(m).summarise({scene, m, base, kd, ks, through});
}

/// Mean luminance of the vertex colours of a triangle.
double colour_of(const Scene& scene, std::uint32_t triangle) {
  double sum = 0;
  for (const std::uint32_t v : scene.triangle[triangle].v)
    sum += static_cast<double>(luminance(Rgb(scene.colour[v])));
  return sum / 3;
}

std::string names_of(const std::vector<const Material*>& materials) {
  constexpr std::size_t kShown = 3;
  std::string out;
  for (std::size_t i = 0; i < std::min(kShown, materials.size()); ++i)
    out.append(i ? ", " : "").append(materials[i]->name);
  if (materials.size() > kShown) out += text(" and ", materials.size() - kShown, " more");
  return out;
}

Json numbers(const Vec3& v) { return Json::Array{v.x, v.y, v.z}; }

const char* kind_name(Light::Kind kind) {
  constexpr const char* kNames[] = {"area", "point", "spot", "directional", "environment", "measured"};
  return kNames[static_cast<int>(kind)];
}

Json describe_light(const Scene& scene, const Light& light) {
  Json j;
  j["name"] = light.name;
  j["kind"] = kind_name(light.kind);
  j["lumens"] = luminance(light.flux_lm);
  j["flux_lm"] = numbers(light.flux_lm);
  if (light.fitting >= 0) {
    const Fitting& fitting = scene.fitting[static_cast<std::size_t>(light.fitting)];
    j["luminaire"] = describe_photometry(fitting.file());
    j["down"] = numbers(fitting.down());
    j["c0"] = numbers(fitting.axes()[0]);
  }
  if (light.kind == Light::Kind::area) {
    const Instance& instance = scene.instance[light.instance];
    j["area_m2"] = light.area_m2;
    j["triangles"] = instance.triangle_count;
    j["two_sided"] = scene.material[instance.material].double_sided;
    j["luminance_cd_m2"] = numbers(scene.material[instance.material].emission);
    return j;
  }
  if (light.kind == Light::Kind::environment) {
    const Environment& map = *scene.environment;
    j["size"] = Json::Array{map.width(), map.height()};
    j["rotation_deg"] = glm::degrees(map.rotation_rad());
    j["mean_luminance_cd_m2"] = numbers(Rgb(map.integral_lx() / (4 * std::numbers::pi)));
    j["horizontal_illuminance_lx"] = numbers(Rgb(map.irradiance_up_lx()));
    if (const auto& sun = map.sun()) {
      j["sun_illuminance_lx"] = numbers(sun->illuminance_lx);
      j["sun_direction"] = numbers(Vec3(sun->towards));
      j["sun_diameter_deg"] = static_cast<float>(glm::degrees(2 * sun->radius_rad));
    }
    if (scene.portal.empty()) return j;
    double area_m2 = 0;
    for (const Portal& p : scene.portal) area_m2 += p.area_m2();
    j["portals"] = scene.portal.size();
    j["portals_m2"] = static_cast<float>(area_m2);
    return j;
  }
  j[light.kind == Light::Kind::directional ? "illuminance_lx" : "intensity_cd"] = numbers(light.intensity);
  if (light.kind != Light::Kind::directional) j["position_m"] = world_json(scene.origin_m, light.position);
  if (light.kind != Light::Kind::point) j["direction"] = numbers(light.direction);
  if (light.kind == Light::Kind::spot) {
    j["inner_deg"] = static_cast<float>(glm::degrees(std::acos(light.cos_inner)));
    j["outer_deg"] = static_cast<float>(glm::degrees(std::acos(light.cos_outer)));
  }
  return j;
}

Json describe_material(const Scene& scene, const MaterialSummary& s) {
  const Material& m = *s.material;
  Json j;
  j["name"] = m.name;
  j["model"] = model_name(m.model);
  j["triangles"] = s.triangles;
  j["area_m2"] = s.area_m2;
  j["reflectance"] = s.reflectance;
  j["kd"] = numbers(m.kd);
  if (max_component(m.ks) > 0) j["ks"] = numbers(m.ks);
  for (const ModelParameter& p : row_of(m).parameters) j[p.key] = m.*p.number;
  if (s.glossy && row_of(m).tells_alpha) j["alpha"] = Json::Array{m.alpha_x, m.alpha_y};
  if (m.emits()) j["luminance_cd_m2"] = numbers(m.emission);
  if (passes_straight(scene, m)) {  // at normal incidence
    const auto index = static_cast<std::uint32_t>(&m - scene.material.data());
    j["transmittance"] = numbers(Bsdf(scene, index).pane(Vec3(0, 0, 1)).transmittance());
  }
  if (m.diffuse_transmission > 0) {
    const auto index = static_cast<std::uint32_t>(&m - scene.material.data());
    j["diffuse_transmittance"] = numbers(Bsdf(scene, index).diffuse_transmittance());
  }
  Json textures = Json::Array{};
  constexpr const char* kNames[] = {"base colour",
                                    "metallic-roughness",
                                    "normal",
                                    "emissive",
                                    "anisotropy",
                                    "transmission",
                                    "diffuse transmission",
                                    "diffuse transmission colour"};
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    if (m.texture_uses()[i]->used()) textures.push_back(kNames[i]);
  }
  j["textures"] = textures;
  return j;
}

Json describe_camera(const Scene& scene, const Camera& camera) {
  Json j;
  j["name"] = camera.name;
  j["kind"] = camera.perspective ? "perspective" : "orthographic";
  j["eye_m"] = world_json(scene.origin_m, Vec3(camera.to_world[3]));
  j["direction"] = numbers(-Vec3(camera.to_world[2]));
  if (camera.perspective) j["yfov_deg"] = glm::degrees(camera.yfov_rad);
  if (!camera.perspective) j["ymag_m"] = camera.ymag_m;
  j["aspect"] = camera.aspect;
  return j;
}

Json describe_animation(const Animation& animation) {
  Json j;
  j["name"] = animation.name;
  j["start_s"] = animation.start_s;
  j["end_s"] = animation.end_s;
  Json targets = Json::Array{};
  for (const std::string& t : animation.targets) targets.push_back(t);
  j["targets"] = targets;
  return j;
}

template <class T>
std::uint64_t bytes_of(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

std::uint64_t scene_bytes(const Scene& s) {
  std::uint64_t n = bytes_of(s.position) + bytes_of(s.normal) + bytes_of(s.uv0) + bytes_of(s.uv1) +
                    bytes_of(s.tangent) + bytes_of(s.colour) + bytes_of(s.triangle) +
                    bytes_of(s.triangle_instance);
  for (const Texture& t : s.texture) n += bytes_of(t.texels) + bytes_of(t.codes);
  for (const auto& measured : s.measured) n += measured->memory_bytes();
  return n;
}

/// Of light that comes to surfaces by mirrors, glass or sharp gloss so that rays seldom find it.
void add_ways(const std::vector<LightWay>& all, std::vector<Requirement>& out) {
  constexpr std::size_t kShown = 3;
  const std::vector<LightWay> ways = unsampled(all, Sampler::gathering, kUsualRays);
  if (ways.empty()) return;
  std::string why;
  for (std::size_t i = 0; i < std::min(kShown, ways.size()); ++i)
    why.append(i > 0 ? "; " : "").append(share_text(ways[i]));
  if (ways.size() > kShown) why += text("; and ", ways.size() - kShown, " more such ways");
  out.push_back({kCausticPhotons, why});
}

}  // namespace

const char* model_name(Model model) { return model_rows()[static_cast<std::size_t>(model)].name; }

std::vector<MaterialSummary> summarize_materials(const Scene& scene) {
  std::vector<MaterialSummary> out(scene.material.size());
  std::vector<double> coloured_m2(scene.material.size(), 0);
  for (const Instance& instance : scene.instance) {
    MaterialSummary& s = out[instance.material];
    s.triangles += instance.triangle_count;
    for (std::uint32_t t = 0; t < instance.triangle_count; ++t) {
      const double area = area_m2(scene, instance.first_triangle + t);
      s.area_m2 += area;
      if (!scene.colour.empty())
        coloured_m2[instance.material] += area * colour_of(scene, instance.first_triangle + t);
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].material = &scene.material[i];
    const bool coloured = !scene.colour.empty() && out[i].area_m2 > 0;
    classify(scene, coloured ? coloured_m2[i] / out[i].area_m2 : 1, out[i]);
  }
  return out;
}

std::vector<Requirement> scene_requirements(const Scene& scene) {
  std::vector<const Material*> diffuse, glossy, specular;
  for (const MaterialSummary& s : summarize_materials(scene)) {
    if (s.triangles == 0) continue;
    if (s.diffuse) diffuse.push_back(s.material);
    if (s.glossy) glossy.push_back(s.material);
    if (s.specular) specular.push_back(s.material);
  }
  std::vector<Requirement> out;
  const bool lit = !scene.light.empty();
  const bool scatters = !diffuse.empty() || !glossy.empty();
  if (lit && scatters) {
    out.push_back({"direct light", "lights: " + std::to_string(scene.light.size())});
    out.push_back({"global photons", "light is reflected between surfaces that are not mirrors"});
  }
  if (lit && sends_light_on(scene)) add_ways(light_ways(RayScene(scene), Luminaires(scene)), out);
  if (lit && !diffuse.empty()) out.push_back({"irradiance records", "diffuse: " + names_of(diffuse)});
  if (lit && !glossy.empty()) out.push_back({"gloss", "glossy: " + names_of(glossy)});
  if (!specular.empty())
    out.push_back(
        {"specular tracing", "mirrors, or materials that light passes straight: " + names_of(specular)});
  if (!scene.animation.empty()) {
    out.push_back({"temporal data", text("animated over ", scene.frames, " frames")});
  }
  return out;
}

Json describe_scene(const Scene& scene, const std::vector<Finding>& findings) {
  Json j;
  j["path"] = scene.path;
  j["hash"] = scene.hash;
  j["triangles"] = scene.triangle.size();
  j["vertices"] = scene.position.size();
  j["instances"] = scene.instance.size();
  j["memory_bytes"] = scene_bytes(scene);
  j["bounds_m"] =
      Json::Array{world_json(scene.origin_m, scene.bounds.lo), world_json(scene.origin_m, scene.bounds.hi)};
  if (scene.bands.number > 0) {
    const Bands bands(scene.bands.number);
    const int first = bands.band_of(scene.bands.triplet, 0), last = std::min(first + 2, bands.size() - 1);
    Json& part = j["bands"] = Json::Object{};
    part["number"] = bands.size(), part["triplet"] = scene.bands.triplet;
    part["from_nm"] = bands.lo_nm(first), part["to_nm"] = bands.hi_nm(last);
  }
  if (scene.origin_m != DVec3(0)) j["origin_m"] = origin_json(scene.origin_m);
  j["diagonal_m"] = scene.bounds.diagonal_m();
  double area = 0, lumens = 0;
  Json materials = Json::Array{}, lights = Json::Array{}, cameras = Json::Array{}, textures = Json::Array{};
  for (const MaterialSummary& s : summarize_materials(scene)) {
    area += s.area_m2;
    materials.push_back(describe_material(scene, s));
  }
  for (const Light& light : scene.light) {
    lumens += luminance(light.flux_lm);
    lights.push_back(describe_light(scene, light));
  }
  for (const Camera& camera : scene.camera) cameras.push_back(describe_camera(scene, camera));
  for (const Texture& t : scene.texture) {
    Json texture;
    texture["name"] = t.name;
    texture["size"] = Json::Array{t.width, t.height};
    textures.push_back(texture);
  }
  j["surface_m2"] = area;
  j["materials"] = materials;
  j["textures"] = textures;
  j["lights"] = lights;
  j["total_lumens"] = lumens;
  j["cameras"] = cameras;
  Json animations = Json::Array{}, requirements = Json::Array{}, lint = Json::Array{};
  for (const Animation& a : scene.animation) animations.push_back(describe_animation(a));
  j["animations"] = animations;
  j["time_s"] = scene.time_s;
  j["frames"] = scene.frames;
  j["frames_per_s"] = scene.frames_per_s;
  for (const Requirement& r : scene_requirements(scene)) {
    Json item;
    item["what"] = r.what;
    item["why"] = r.why;
    requirements.push_back(item);
  }
  for (const Finding& f : findings) {
    Json item;
    item["level"] = level_name(f.level);
    item["code"] = f.code;
    item["message"] = f.message;
    item["mend"] = f.mend;
    lint.push_back(item);
  }
  j["requires"] = requirements;
  j["lint"] = lint;
  return j;
}

}  // namespace phos::inline scene
