#include "scene/material/glass_sheets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/error.h"
#include "scene/material/models.h"

namespace phos::inline scene {
namespace {

/// Of points in a plane, those off it by no more than this part of the length of their box are in it.
constexpr float kFlat = 1e-4f;

/// Sets of instances whose vertices meet.
class Unions {
 public:
  explicit Unions(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

template <class Visit>
void each_vertex(const Scene& scene, const Instance& instance, const Visit& visit) {
  for (std::uint32_t t = 0; t < instance.triangle_count; ++t)
    for (const std::uint32_t v : scene.triangle[instance.first_triangle + t].v) visit(scene.position[v]);
}

template <class Visit>
void each_triangle(const Scene& scene, const std::vector<std::size_t>& instances, const Visit& visit) {
  for (const std::size_t i : instances)
    for (std::uint32_t t = 0; t < scene.instance[i].triangle_count; ++t)
      visit(scene.instance[i].first_triangle + t);
}

/// The largest triangle of a part; its area is 0 where no triangle has one.
struct Largest {
  Vec3 normal{0}, place{0};
  float m2 = 0;

  Largest(const Scene& scene, const std::vector<std::size_t>& instances) {
    each_triangle(scene, instances, [&](std::uint32_t t) {
      if (const float own_m2 = area_m2(scene, t); own_m2 > m2)
        m2 = own_m2, normal = geometric_normal(scene, t), place = scene.position[scene.triangle[t].v[0]];
    });
  }
};

bool lies_in_a_plane(const Scene& scene, const std::vector<std::size_t>& instances) {
  const auto [normal, place, largest_m2] = Largest(scene, instances);
  Bounds box;
  for (const std::size_t i : instances)
    each_vertex(scene, scene.instance[i], [&](const Vec3& p) { box.include(p); });
  bool flat = largest_m2 > 0;
  const float slack_m = kFlat * box.diagonal_m();
  for (const std::size_t i : instances)
    each_vertex(scene, scene.instance[i],
                [&](const Vec3& p) { flat = flat && std::fabs(glm::dot(p - place, normal)) <= slack_m; });
  return flat;
}

/// A box without thickness has two faces at one place. Marks one of them, so that it is one pane.
void mark_second_face(const Scene& scene, const std::vector<std::size_t>& instances,
                      std::vector<std::uint8_t>& left_out) {
  const Vec3 normal = Largest(scene, instances).normal;
  const auto is_behind = [&](std::uint32_t t) { return glm::dot(geometric_normal(scene, t), normal) < 0; };
  double front_m2 = 0, behind_m2 = 0;
  each_triangle(scene, instances, [&](std::uint32_t t) {
    (is_behind(t) ? behind_m2 : front_m2) += static_cast<double>(area_m2(scene, t));
  });
  constexpr double kAlike = 1e-4;
  if (std::fabs(front_m2 - behind_m2) > kAlike * front_m2) return;
  each_triangle(scene, instances, [&](std::uint32_t t) { left_out[t] = is_behind(t); });
}

void leave_out(Scene& scene, const std::vector<std::uint8_t>& left_out) {
  std::uint32_t kept = 0;
  for (Instance& instance : scene.instance) {
    const std::uint32_t first = kept;
    for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
         ++t) {
      if (left_out[t]) continue;
      scene.triangle[kept] = scene.triangle[t], scene.triangle_instance[kept] = scene.triangle_instance[t];
      ++kept;
    }
    instance.first_triangle = first, instance.triangle_count = kept - first;
  }
  scene.triangle.resize(kept), scene.triangle_instance.resize(kept);
}

Material thin(const Material& solid) {
  Material m = solid;
  m.model = Model::thin_dielectric;
  for (int c = 0; c < 3; ++c) {
    const float absorption = solid.absorption_per_m[c];
    m.inside[c] = absorption > 0 ? std::exp(-absorption * solid.thickness_m) : 1;
  }
  m.absorption_per_m = Rgb(0);
  m.thickness_m = 0;
  return m;
}

}  // namespace

void make_sheets_thin(Scene& scene) {
  const std::size_t materials = scene.material.size();
  std::vector<std::uint8_t> left_out(scene.triangle.size(), 0);
  for (std::size_t material = 0; material < materials; ++material) {
    const Material& m = scene.material[material];
    if (!is_solid_glass(m) || !(m.thickness_m > 0)) continue;
    // By the places that their corners share: the faces of a box may be nodes of their own.
    Unions unions(scene.instance.size());
    std::map<std::array<float, 3>, std::size_t> at;
    for (std::size_t i = 0; i < scene.instance.size(); ++i) {
      if (scene.instance[i].material != material) continue;
      each_vertex(scene, scene.instance[i], [&](const Vec3& p) {
        const auto [place, fresh] = at.try_emplace({p.x + 0.f, p.y + 0.f, p.z + 0.f}, i);
        if (!fresh) unions.join(i, place->second);
      });
    }
    std::map<std::size_t, std::vector<std::size_t>> parts;
    for (std::size_t i = 0; i < scene.instance.size(); ++i)
      if (scene.instance[i].material == material) parts[unions.root(i)].push_back(i);
    std::vector<std::size_t> sheets;
    for (const auto& [root, instances] : parts) {
      if (!lies_in_a_plane(scene, instances)) continue;
      sheets.insert(sheets.end(), instances.begin(), instances.end());
      mark_second_face(scene, instances, left_out);
    }
    if (sheets.empty()) continue;
    scene.warnings.emplace_back(
        Note::Level::info, "loader", "material", m.name,
        text(sheets.size(), " instances of it enclose no volume; each is read as a thin pane"));
    const bool all = sheets.size() == static_cast<std::size_t>(std::count_if(
                                          scene.instance.begin(), scene.instance.end(),
                                          [&](const Instance& i) { return i.material == material; }));
    const Material pane = thin(m);
    if (all) {
      scene.material[material] = pane;
      continue;
    }
    for (const std::size_t i : sheets)
      scene.instance[i].material = static_cast<std::uint32_t>(scene.material.size());
    scene.material.push_back(pane);
  }
  leave_out(scene, left_out);
}

}  // namespace phos::inline scene
