#include "view/scene_message.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/lamp/luminaires.h"
#include "scene/material/bsdf.h"
#include "scene/texture/texture.h"
#include "splat/direct/lamp_places.h"
#include "splat/projection.h"
#include "splat/sight_range.h"
#include "view/glint_fields.h"
#include "view/limits.h"
#include "view/message/writer.h"
#include "view/specular_fields.h"

namespace phos::inline view {
namespace {

using Floats = std::vector<float>;
using Numbers = std::vector<std::uint32_t>;

constexpr int kMostSamples = 256;  // of all lamps together, where each has more than one

void add(Floats& values, const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }
void add(Floats& values, const Vec4& v) { values.insert(values.end(), {v.x, v.y, v.z, v.w}); }

/// Names one after another, and where each ends.
struct NameList {
  std::vector<std::uint8_t> utf8;
  Numbers end;
  void add(const std::string& name) {
    utf8.insert(utf8.end(), name.begin(), name.end());
    end.push_back(static_cast<std::uint32_t>(utf8.size()));
  }
};

void add_geometry(const Scene& scene, MessageWriter& message) {
  message.add("scene", "bounds_lo", std::vector<Vec3>{scene.bounds.lo});
  message.add("scene", "bounds_hi", std::vector<Vec3>{scene.bounds.hi});
  message.add("scene", "origin", std::vector<Vec3>{Vec3(scene.origin_m)});
  const auto sky = std::find_if(scene.light.begin(), scene.light.end(),
                                [](const Light& light) { return light.kind == Light::Kind::environment; });
  message.add(
      "scene", "sky_lamp",
      Numbers{sky == scene.light.end() ? kNoRow : static_cast<std::uint32_t>(sky - scene.light.begin())});
  message.add("vertex", "position", scene.position);
  message.add("vertex", "normal", scene.normal);
  if (!scene.uv0.empty() || !scene.uv1.empty()) {
    Floats uv;
    for (std::size_t i = 0; i < scene.position.size(); ++i)
      add(uv, Vec4(scene.uv0.empty() ? Vec2(0) : scene.uv0[i], scene.uv1.empty() ? Vec2(0) : scene.uv1[i]));
    message.add("vertex", "uv", uv);
  }
  if (!scene.colour.empty()) {
    Floats colour;
    for (const Vec4& c : scene.colour) add(colour, c);
    message.add("vertex", "colour", colour);
  }
  Numbers corner;
  for (const Triangle& t : scene.triangle) corner.insert(corner.end(), std::begin(t.v), std::end(t.v));
  message.add("triangle", "corner", corner);
}

/// Offset, and the columns of the matrix (scene/texture/texture.h: transformed()).
void add_place(Floats& values, const TextureUse& use) {
  const Vec2 x = transformed(use, Vec2(1, 0)) - use.offset, y = transformed(use, Vec2(0, 1)) - use.offset;
  for (const Vec2& v : {use.offset, x, y}) values.push_back(v.x), values.push_back(v.y);
}

/// What a material does to light, textures at their mean.
struct Reflection {
  Rgb diffuse{0}, gloss{0};
  bool clear = false;
};

Reflection reflection_of(const Scene& scene, std::uint32_t material) {
  constexpr int kSamples = 256;
  const Bsdf bsdf(scene, material);
  const Vec3 wo = glm::normalize(Vec3(1, 0, 1));
  glm::dvec3 reflected(0), scattered(0), passed(0);
  for (int i = 0; i < kSamples; ++i) {
    const double y = 0.5 + 0.6180339887498949 * i, z = 0.5 + 0.7548776662466927 * i;
    BsdfSample sample;
    if (!bsdf.sample(wo, (static_cast<float>(i) + 0.5f) / kSamples,
                     Vec2(static_cast<float>(y - std::floor(y)), static_cast<float>(z - std::floor(z))),
                     sample))
      continue;
    const glm::dvec3 share = glm::dvec3(sample.weight) / double{kSamples};
    (sample.transmitted ? passed : reflected) += share;
    if (!sample.specular && !sample.transmitted) scattered += share;
  }
  Reflection r;
  r.diffuse = bsdf.diffuse_reflectance();
  r.gloss = glm::clamp(Rgb(scattered) - r.diffuse, Rgb(0), Rgb(1));
  r.clear = luminance(Rgb(passed)) > luminance(Rgb(reflected)) && !bsdf.transmits_diffusely();
  return r;
}

/// Returns how many textures are reduced.
std::size_t add_materials(const Scene& scene, const TextureLimits& most, MessageWriter& message) {
  Floats diffuse, gloss, emission, cutoff, colour_place, emission_place;
  Numbers flags, colour_texture, colour_set, emission_texture, emission_set;
  SceneTextures textures(scene, most);
  for (std::uint32_t i = 0; i < scene.material.size(); ++i) {
    const Material& m = scene.material[i];
    const Reflection reflection = reflection_of(scene, i);
    const Vec4 mean = mean_texel(scene, m.base_colour);
    Rgb factor;
    for (int c = 0; c < 3; ++c) factor[c] = mean[c] > 0 ? reflection.diffuse[c] / mean[c] : m.kd[c];
    add(diffuse, Vec4(factor, m.alpha));
    add(gloss, reflection.gloss);
    add(emission, m.emission);
    const bool opaque = m.alpha_mode == Material::Alpha::opaque;
    flags.push_back((m.double_sided ? kTwoSidedEmission : 0u) | (opaque ? 0u : kMasked) |
                    (reflection.clear ? kClear : 0u));
    cutoff.push_back(m.alpha_mode == Material::Alpha::mask ? m.alpha_cutoff : 0.5f);
    colour_texture.push_back(textures.row(m.base_colour));
    colour_set.push_back(m.base_colour.set);
    add_place(colour_place, m.base_colour);
    emission_texture.push_back(textures.row(m.emissive));
    emission_set.push_back(m.emissive.set);
    add_place(emission_place, m.emissive);
  }
  message.add("material", "diffuse", diffuse);
  message.add("material", "gloss", gloss);
  message.add("material", "emission", emission);
  message.add("material", "flags", flags);
  message.add("material", "cutoff", cutoff);
  message.add("material", "colour_texture", colour_texture);
  message.add("material", "colour_set", colour_set);
  message.add("material", "colour_place", colour_place);
  message.add("material", "emission_texture", emission_texture);
  message.add("material", "emission_set", emission_set);
  message.add("material", "emission_place", emission_place);
  return textures.add_to(message);
}

/// Places of a lamp: fewer of each where there are many lamps.
int places_of(const Scene& scene, const Light& light, int light_samples) {
  const auto extended =
      std::count_if(scene.light.begin(), scene.light.end(), [](const Light& l) { return l.extended(); });
  const int fair = std::max(1, kMostSamples / std::max(1, static_cast<int>(extended)));
  const bool environment = light.kind == Light::Kind::environment;
  return place_count(light, std::min(fair, environment ? 4 * light_samples : light_samples));
}

void add_lamps(const Scene& scene, int light_samples, MessageWriter& message) {
  const Luminaires luminaires(scene);
  NameList names;
  Numbers lamp, shape, two_sided, distribution;
  Floats position, nearest, forward, colour, cone, axes, share;
  std::uint32_t distributions = 0;
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const Light& light = scene.light[i];
    names.add(light.name);
    ShareMap map;
    if (light.fitting >= 0) {
      map = share_map(scene, light);
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) axes.push_back(map.axes[column][row]);
      share.insert(share.end(), map.share.begin(), map.share.end());
      ++distributions;
    }
    const int count = places_of(scene, light, light_samples);
    for (int k = 0; k < count; ++k) {
      const auto sample = lamp_place(scene, luminaires, i, k, count, map);
      if (!sample || max_component(sample->colour) <= 0) continue;
      lamp.push_back(static_cast<std::uint32_t>(i));
      shape.push_back(static_cast<std::uint32_t>(sample->shape));
      const bool near = sample->shape != PlaceShape::directional;
      nearest.push_back(near ? static_cast<float>(nearest_m(scene, sample->position, sample->instance))
                             : 0.f);
      add(position, sample->position), add(forward, sample->forward), add(colour, sample->colour);
      cone.push_back(static_cast<float>(sample->cos_outer)),
          cone.push_back(static_cast<float>(sample->cos_inner));
      two_sided.push_back(sample->two_sided ? 1 : 0);
      distribution.push_back(light.fitting >= 0 ? distributions - 1 : kNoRow);
    }
  }
  message.add("lamp", "name_end", names.end);
  message.add("lamp_name", "utf8", names.utf8);
  message.add("sample", "lamp", lamp);
  message.add("sample", "shape", shape);
  message.add("sample", "position", position);
  message.add("sample", "nearest", nearest);
  message.add("sample", "forward", forward);
  message.add("sample", "colour", colour);
  message.add("sample", "cone", cone);
  message.add("sample", "two_sided", two_sided);
  message.add("sample", "distribution", distribution);
  message.add("distribution", "axes", axes);
  message.add("distribution", "share", share);
}

void add_cameras(const Scene& scene, MessageWriter& message) {
  NameList names;
  Floats position, right, up, half_height, aspect;
  Numbers perspective;
  for (const Camera& camera : scene.camera) {
    const Projection projection(camera, 1, 1);
    const glm::dmat3 rows = glm::transpose(projection.axes());
    add(position, Vec3(projection.eye())), add(right, Vec3(rows[0])), add(up, Vec3(rows[1]));
    half_height.push_back(static_cast<float>(projection.half_height()));
    aspect.push_back(camera.aspect);
    perspective.push_back(camera.perspective ? 1 : 0);
    names.add(camera.name);
  }
  message.add("camera", "position", position);
  message.add("camera", "right", right);
  message.add("camera", "up", up);
  message.add("camera", "perspective", perspective);
  message.add("camera", "half_height", half_height);
  message.add("camera", "aspect", aspect);
  message.add("camera", "name_end", names.end);
  message.add("camera_name", "utf8", names.utf8);
}

void add_sky(const Scene& scene, MessageWriter& message) {
  if (!scene.environment) return;
  Floats luminance;
  for (unsigned y = 0; y < kSkyRows; ++y)
    for (unsigned x = 0; x < kSkyColumns; ++x) {
      const double from_top = std::numbers::pi * (y + 0.5) / kSkyRows;
      const double azimuth = 2 * std::numbers::pi * ((x + 0.5) / kSkyColumns - 0.5);
      add(luminance,
          background_luminance(scene, Vec3(std::sin(from_top) * std::cos(azimuth), std::cos(from_top),
                                           std::sin(from_top) * std::sin(azimuth))));
    }
  message.add("sky", "luminance", luminance);
}

}  // namespace

SceneMessage scene_message(const Scene& scene, int light_samples, const TextureLimits& most) {
  MessageWriter message(MessageKind::scene);
  add_geometry(scene, message);
  add_parts(scene, message);
  const std::size_t reduced = add_materials(scene, most, message);
  add_specular(scene, message);
  add_glints(scene, message);
  add_lamps(scene, light_samples, message);
  add_cameras(scene, message);
  add_sky(scene, message);
  std::string bytes = message.message();
  if (bytes.size() > kMostPageBytes.as<std::size_t>())
    throw Error(ExitCode::usage, "",
                text("the scene takes ", bytes.size(), " bytes in a browser, and more than ",
                     written(kMostPageBytes), " do not fit there; leave out meshes with many triangles"));
  return {std::move(bytes), reduced};
}

}  // namespace phos::inline view
