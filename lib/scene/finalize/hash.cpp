#include "scene/finalize/hash.h"

#include <array>
#include <map>
#include <set>
#include <string_view>

#include "core/origin.h"
#include "file/hash.h"
#include "scene/luminaire/photometry.h"
#include "scene/material/merl.h"
#include "scene/material/models.h"
#include "scene/material/pane.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {
namespace {

/// More names than this and the parts would outgrow the header of a small cache.
constexpr std::size_t kMaxNamedNodes = 256;

/// Floats by their bits, -0 as 0 (x + 0 turns one into the other).
void add_floats(Hasher& hasher, const float* values, std::size_t n) {
  std::array<float, 1024> block;
  hasher.add(static_cast<std::int64_t>(n));
  for (std::size_t i = 0; i < n; i += block.size()) {
    const std::size_t m = std::min(block.size(), n - i);
    for (std::size_t k = 0; k < m; ++k) block[k] = values[i + k] + 0.0f;
    hasher.add_bytes(block.data(), m * sizeof(float));
  }
}

template <class V>
void add_vectors(Hasher& hasher, const std::vector<V>& values) {
  static_assert(sizeof(V) == sizeof(float) * static_cast<std::size_t>(V::length()));
  add_floats(hasher, reinterpret_cast<const float*>(values.data()),
             values.size() * static_cast<std::size_t>(V::length()));
}

template <class V>
void add_vector(Hasher& hasher, const V& v) {
  for (int c = 0; c < V::length(); ++c) hasher.add(v[c]);
}

void add_use(Hasher& hasher, const TextureUse& use) {
  hasher.add(use.texture);
  if (!use.used()) return;
  hasher.add(use.set);
  add_vector(hasher, use.offset);
  add_vector(hasher, use.scale);
  hasher.add(use.rotation_rad);
}

void add_material(Hasher& hasher, const Material& m) {
  hasher.add(m.model);
  for (const Rgb& c : {m.kd, m.ks, m.specular_colour, m.emission}) add_vector(hasher, c);
  for (const float v : {m.exponent, m.alpha_x, m.alpha_y, m.roughness, m.metallic, m.ior, m.specular,
                        m.transmission, m.normal_scale, m.alpha, m.alpha_cutoff}) {
    hasher.add(v);
  }
  for (const TextureUse* use : {&m.base_colour, &m.metallic_roughness, &m.normal, &m.emissive})
    add_use(hasher, *use);
  if (m.anisotropy > 0) {
    hasher.add(m.anisotropy);
    hasher.add(m.anisotropy_rad);
    add_use(hasher, m.anisotropy_map);
  }
  if (m.tint != Rgb(1)) add_vector(hasher, m.tint);
  if (m.inside != Rgb(1)) add_vector(hasher, m.inside);
  if (m.absorption_per_m != Rgb(0)) add_vector(hasher, m.absorption_per_m);
  if (m.transmission_map.used()) add_use(hasher, m.transmission_map);
  if (m.diffuse_transmission > 0) {
    hasher.add(m.diffuse_transmission);
    add_vector(hasher, m.diffuse_transmission_colour);
    add_use(hasher, m.diffuse_transmission_map), add_use(hasher, m.diffuse_transmission_colour_map);
  }
  if (m.curve)
    for (const TransmittanceCurve::Point& p : m.curve->points()) {
      hasher.add(static_cast<float>(p.angle_deg));
      hasher.add(static_cast<float>(p.transmittance));
    }
  if (m.measured >= 0) hasher.add(m.measured);
  for (const ModelParameter& p : row_of(m).parameters)
    if (!p.of_every_model) hasher.add(m.*p.number);
  hasher.add(m.double_sided);
  hasher.add(m.alpha_mode);
}

std::string hash_geometry(const Scene& scene) {
  Hasher hasher;
  if (scene.origin_m != DVec3(0)) hasher.add_bytes(&scene.origin_m, sizeof scene.origin_m);
  add_vectors(hasher, scene.position);
  add_vectors(hasher, scene.normal);
  add_vectors(hasher, scene.uv0);
  add_vectors(hasher, scene.uv1);
  add_vectors(hasher, scene.tangent);
  add_vectors(hasher, scene.colour);
  hasher.add_span(std::span<const Triangle>(scene.triangle));
  for (const Instance& i : scene.instance) {
    hasher.add(i.material);
    hasher.add(i.triangle_count);
  }
  return hasher.finish().hex();
}

std::string hash_materials(const Scene& scene) {
  Hasher hasher;
  for (const Material& m : scene.material) add_material(hasher, m);
  for (const Texture& t : scene.texture) {
    hasher.add(t.width);
    hasher.add(t.height);
    hasher.add(t.wrap_u);
    hasher.add(t.wrap_v);
    hasher.add(t.nearest);
    add_vectors(hasher, t.texels);
    hasher.add_span(std::span<const Texture::Code>(t.codes));
    hasher.add(t.srgb);
  }
  for (const auto& measured : scene.measured) hasher.add(measured->contents());
  return hasher.finish().hex();
}

void add_light(Hasher& hasher, const Scene& scene, const Light& light) {
  hasher.add(light.kind);
  add_vector(hasher, light.position);
  add_vector(hasher, light.direction);
  add_vector(hasher, light.intensity);
  for (const double cosine : {light.cos_inner, light.cos_outer}) {
    const auto rounded = static_cast<float>(cosine);
    hasher.add(rounded);
    if (static_cast<double>(rounded) != cosine) hasher.add_bytes(&cosine, sizeof cosine);
  }
  add_vector(hasher, light.flux_lm);
  if (light.fitting >= 0) scene.fitting[static_cast<std::size_t>(light.fitting)].add_to(hasher);
}

/// Empty where there is none.
std::string hash_environment(const Environment* environment) {
  if (!environment) return {};
  if (!environment->recipe().empty()) return hash_text(environment->recipe()).hex();
  Hasher hasher;
  hasher.add(environment->width());
  hasher.add(environment->height());
  const double rotation_rad = environment->rotation_rad() + 0.0;
  hasher.add_bytes(&rotation_rad, sizeof rotation_rad);
  add_vectors(hasher, environment->texels());
  return hasher.finish().hex();
}

/// The light of measured luminaires, wherever they hang; empty where there are none.
std::string hash_luminaires(const Scene& scene) {
  if (scene.fitting.empty()) return {};
  Hasher hasher;
  for (const Fitting& fitting : scene.fitting) {
    hasher.add(fitting.photometry().hash());
    add_vector(hasher, fitting.colour());
  }
  for (const Instance& instance : scene.instance) hasher.add(instance.fitting);
  return hasher.finish().hex();
}

std::string hash_lights(const Scene& scene) {
  Hasher hasher;
  for (const Light& light : scene.light) add_light(hasher, scene, light);
  return hasher.finish().hex();
}

/// What each named thing is and where, so that a mismatch can say which one moved. Null if there are too
/// many.
Json hash_nodes(const Scene& scene) {
  std::set<std::string_view> names;
  for (const Instance& i : scene.instance) {
    names.insert(i.node);
    if (names.size() > kMaxNamedNodes) return Json();
  }
  std::map<std::string, std::vector<const Instance*>> instances;
  std::map<std::string, std::vector<const Light*>> lights;
  for (const Instance& i : scene.instance) instances[i.node].push_back(&i);
  for (const Light& l : scene.light) {
    if (l.kind != Light::Kind::area && l.kind != Light::Kind::environment) lights[l.name].push_back(&l);
  }
  std::map<std::string, Hasher> hashers;
  for (const auto& [name, list] : instances) {
    Hasher& hasher = hashers[name];
    for (const Instance* i : list) {
      for (std::uint32_t t = i->first_triangle; t < i->first_triangle + i->triangle_count; ++t) {
        for (const std::uint32_t v : scene.triangle[t].v) add_vector(hasher, scene.position[v]);
      }
    }
  }
  for (const auto& [name, list] : lights) {
    Hasher& hasher = hashers[name];
    for (const Light* l : list) add_light(hasher, scene, *l);
  }
  if (hashers.size() > kMaxNamedNodes) return Json();
  Json out = Json::Object{};
  for (const auto& [name, hasher] : hashers) out[name] = hasher.finish().hex().substr(0, 16);
  return out;
}

}  // namespace

void fill_hash(Scene& scene) {
  const std::string geometry = hash_geometry(scene), materials = hash_materials(scene),
                    lights = hash_lights(scene), environment = hash_environment(scene.environment.get());
  Json parts = Json::Object{};
  parts["geometry"] = geometry;
  parts["materials"] = materials;
  parts["lights"] = lights;
  if (!environment.empty()) parts["environment"] = environment;
  if (const std::string luminaires = hash_luminaires(scene); !luminaires.empty())
    parts["luminaires"] = luminaires;
  std::string bands;
  if (scene.bands.number > 0) {
    Json& part = parts["bands"] = Json::Object{};
    part["number"] = scene.bands.number, part["triplet"] = scene.bands.triplet;
    bands = part.dump();
  }
  if (scene.origin_m != DVec3(0)) parts["origin_m"] = origin_json(scene.origin_m);
  parts["time"] = scene.time_s + 0.0;
  if (Json nodes = hash_nodes(scene); !nodes.is_null()) parts["nodes"] = std::move(nodes);
  scene.parts = std::move(parts);
  scene.hash = hash_text(geometry + materials + lights + environment + bands).hex();
}

}  // namespace phos::inline scene
