// A closed room with glossy walls: the light that its surfaces absorb by its records, against the light that
// its lamp emits.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "hsh/quadrature.h"
#include "radiance/brdf/lobe_projection.h"
#include "radiance/cache.h"
#include "scene/material/bsdf.h"
#include "support/records.h"

namespace phos::test {

/// The room of 2 x 1 x 1.5 m with a point lamp of 100 lm: a floor of broad gloss on a dark base (Phong), a
/// rough metal wall (GGX), a shinier one (Phong 22), and white paint.
inline Scene glossy_room() {
  Scene s;
  const auto material = [&](const std::string& name, Model model, float kd, float ks) -> Material& {
    add_lambert(s, name, kd);
    Material& m = s.material.back();
    m.model = model, m.ks = Rgb(ks);
    return m;
  };
  material("paint", Model::lambert, 0.6f, 0);
  material("floor", Model::phong, 0.1f, 0.6f).exponent = 5;
  Material& metal = material("metal", Model::conductor, 0, 0.8f);
  metal.alpha_x = metal.alpha_y = 0.5f;
  material("varnish", Model::phong, 0.3f, 0.5f).exponent = 22;
  const Vec3 d(2, 1, 1.5f), x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  const auto wall = [&](std::uint32_t m, const Vec3& corner, const Vec3& u, const Vec3& v) {
    begin_instance(s, s.material[m].name, m);
    add_quad(s, corner, u, v);
  };
  wall(1, Vec3(0), z, x), wall(0, y, x, z);
  wall(0, Vec3(0), y, z), wall(2, x, z, y);
  wall(3, Vec3(0), x, y), wall(0, z, y, x);
  add_point_light(s, {0.7f, 0.6f, 0.5f}, 100 / (4 * kPi));
  finalize(s);
  return s;
}

/// What glossy surfaces send on is lost.
inline Scene without_gloss(Scene s) {
  for (Material& m : s.material) {
    m.ks = Rgb(0);
    if (m.model == Model::conductor) m.model = Model::lambert;
  }
  return s;
}

/// How much of the light from each direction a material absorbs: 1 - its albedo, by Helmholtz's reciprocity
/// that for light that leaves there.
class Absorption {
 public:
  Absorption(const Scene& scene, std::uint32_t material) {
    const Bsdf bsdf(scene, material);
    const Quadrature q = hemisphere_quadrature(64, 128);
    for (int i = 0; i <= kRows; ++i) {
      const float z = std::max(1e-4f, static_cast<float>(i) / kRows);
      const Vec3 w(std::sqrt(1 - z * z), 0, z);
      double albedo = 0;
      for (std::size_t k = 0; k < q.size(); ++k) {
        const Vec3 wo(DVec3(q.x[k], q.y[k], q.z[k]));
        albedo += static_cast<double>(bsdf.evaluate(w, wo).y) * q.weight[k] * q.z[k];
      }
      share_.push_back(static_cast<float>(1 - albedo));
    }
    glossy_ = bsdf.has_gloss();
    const Vec3 up(0, 0, 1);
    const auto f = [&](const Vec3& w) { return Rgb(of(w.z)); };
    moments_ = project_lobe(f, {&up, 1}, HarmonicBasis<float>(kOrder)).coefficients;
  }
  static constexpr int kOrder = 10;
  bool glossy() const { return glossy_; }
  float of(float cosine) const {
    const float at = std::clamp(cosine, 0.f, 1.f) * kRows;
    const auto i = std::min(static_cast<std::size_t>(at), std::size_t{kRows - 1});
    return glm::mix(share_[i], share_[i + 1], at - static_cast<float>(i));
  }
  /// Of the light of a record, lm/m2: integral of L cos (1 - albedo).
  double of(const RadianceRecord& r) const {
    double sum = 0;
    for (std::size_t i = 1; i < r.light.size(); i += 3)
      sum += static_cast<double>(r.light[i]) * static_cast<double>(moments_[i]);
    return sum;
  }

 private:
  static constexpr int kRows = 256;
  std::vector<float> share_, moments_;
  bool glossy_ = false;
};

/// Sum over the walls of a room of its area times the mean of use(place, unit normal, material) over one
/// place in each cell of a grid, anywhere in it.
template <class Make>
double over_walls(const Scene& scene, int cells, std::uint64_t seed, const Make& make_use) {
  const auto side = static_cast<std::size_t>(cells), each = side * side;
  const auto of_wall = [&](std::size_t begin, std::size_t end) {
    const auto use = make_use();
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Instance& wall = scene.instance[i / each];
      const Vec3* corner = &scene.position[scene.triangle[wall.first_triangle].v[0]];  // of add_quad
      const Vec3 u = corner[1] - corner[0], v = corner[3] - corner[0], across = glm::cross(u, v);
      RandomStream random(seed, Stage::test, i);
      const Vec2 at = (Vec2(i % side, i % each / side) + random.uniform2()) / static_cast<float>(side);
      const RecordSite site{corner[0] + at.x * u + at.y * v, glm::normalize(across), i};
      sum += use(site, wall.material) * static_cast<double>(glm::length(across)) / static_cast<double>(each);
    }
    return sum;
  };
  return parallel_reduce(scene.instance.size() * each, each, 0.0, of_wall,
                         [](double& sum, double part) { sum += part; });
}

/// Flux that the walls of glossy_room() absorb, lm: of light straight from the lamp, and of other light as
/// records tell it, `radiance` on glossy walls and `irradiance` on the others.
inline double absorbed_lm(const Scene& scene, const Estimator& irradiance, const Estimator& radiance,
                          int cells, std::uint64_t seed) {
  std::vector<Absorption> share;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) share.emplace_back(scene, m);
  const Light& lamp = scene.light.front();
  const double direct = over_walls(scene, 100, seed, [&] {
    return [&](const RecordSite& site, std::uint32_t material) {
      const Vec3 to = lamp.position - site.position;
      const float d2 = glm::dot(to, to), cosine = glm::dot(to, site.normal) / std::sqrt(d2);
      return static_cast<double>(lamp.intensity.y * cosine / d2 * share[material].of(cosine));
    };
  });
  return direct + over_walls(scene, cells, seed, [&] {
           return [&, plain = irradiance.make_worker(), glossy = radiance.make_worker()](
                      const RecordSite& site, std::uint32_t material) {
             if (share[material].glossy()) return share[material].of(*radiance.make(site, *glossy).radiance);
             const float e = irradiance.make(site, *plain).record.irradiance.y;
             return static_cast<double>(share[material].of(1.f) * e);
           };
         });
}

}  // namespace phos::test
