// A room with gloss of two kinds, and radiance records that cost nothing.
#pragma once

#include <memory>
#include <string>

#include "radiance/cache.h"
#include "scene/rays.h"
#include "support/estimators.h"
#include "support/one_material.h"
#include "support/scenes.h"

namespace phos::test {

inline constexpr float kParlourSide = 2;

inline std::uint32_t add_phong(Scene& scene, const std::string& name, const Rgb& kd, float exponent) {
  Material m = make_material(Model::phong, kd, Rgb(0.6f), 0, 0);
  m.name = name, m.exponent = exponent;
  scene.material.push_back(m);
  return static_cast<std::uint32_t>(scene.material.size() - 1);
}

/// A white room with a glossy floor, and a plate over it whose gloss is sharper and all it has.
struct Parlour {
  std::uint32_t walls, floor, plate;
  Scene scene;
  Parlour() {
    walls = add_lambert(scene, "walls", 0.7f);
    floor = add_phong(scene, "floor", Rgb(0.2f), 5);
    plate = add_phong(scene, "plate", Rgb(0), 22);
    const Vec3 x(kParlourSide, 0, 0), y(0, kParlourSide, 0), z(0, 0, kParlourSide);
    begin_instance(scene, "walls", walls);
    add_quad(scene, y, x, z);  // ceiling
    add_quad(scene, {}, y, z), add_quad(scene, x, z, y);
    add_quad(scene, {}, x, y), add_quad(scene, z, y, x);
    begin_instance(scene, "floor", floor);
    add_quad(scene, {}, z, x);
    begin_instance(scene, "plate", plate);
    add_quad(scene, {0.5f, 0.3f, 0.5f}, 0.5f * z, 0.5f * x);
    add_point_light(scene, {1, 1.5f, 1}, 100);
    scene.camera.push_back(look_at({1, 1.6f, 1.9f}, {1, 0, 0.8f}, {0, 1, 0}, 1.2f));
    finalize(scene);
  }
};

/// Records of a room's distances whose light is one number in each coefficient.
class FlatRadiance : public DistanceEstimator {
 public:
  FlatRadiance(const RayScene& rays, int order) : DistanceEstimator(rays), order_(order) {}
  Made make(const RecordSite& site, Worker& worker) const override {
    Made made = DistanceEstimator::make(site, worker);
    RadianceRecord r;
    r.position = site.position, r.frame = make_frame(site.normal);
    r.distance_m = made.record.distance_m, r.radius_m = made.record.radius_m;
    r.light.assign(3 * static_cast<std::size_t>(order_ * order_), 1.f);
    r.gradient_x = r.gradient_y = r.light;
    r.stderr_light.assign(3 * static_cast<std::size_t>(order_), 0.1f);
    made.radiance = std::make_shared<RadianceRecord>(r);
    return made;
  }

 private:
  int order_;
};

}  // namespace phos::test
