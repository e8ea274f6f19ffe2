#include "view/specular_fields.h"

#include <cmath>
#include <map>

#include "scene/material/bsdf.h"
#include "scene/mirror/planes.h"

namespace phos::inline view {
namespace {

using Floats = std::vector<float>;
using Numbers = std::vector<std::uint32_t>;

void add(Floats& values, const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

/// The planes that parts lie in, in the order of their first use.
class MirrorRows {
 public:
  explicit MirrorRows(const Scene& scene) : planes_(scene) {}

  std::uint32_t of(std::uint32_t triangle) {
    const std::int32_t plane = planes_.plane_of(triangle);
    if (plane == MirrorPlanes::kNone) return kNoRow;
    const auto [found, first] = row_.emplace(plane, static_cast<std::uint32_t>(row_.size()));
    if (first) {
      const MirrorPlanes::Plane& p = planes_.plane(plane);
      add(plane_of_, p.normal);
      plane_of_.push_back(-glm::dot(p.normal, p.point));
      add(centre_, 0.5f * (p.box.lo + p.box.hi));
      area_.push_back(p.area_m2);
    }
    return found->second;
  }
  void add_to(MessageWriter& message) const {
    message.add("mirror", "plane", plane_of_);
    message.add("mirror", "centre", centre_);
    message.add("mirror", "area", area_);
  }

 private:
  MirrorPlanes planes_;
  std::map<std::int32_t, std::uint32_t> row_;
  Floats plane_of_, centre_, area_;
};

}  // namespace

void add_parts(const Scene& scene, MessageWriter& message) {
  Numbers first, count, material, mirror, lamp;
  Numbers lamp_of(scene.instance.size(), kNoRow);
  for (std::size_t i = 0; i < scene.light.size(); ++i)
    if (scene.light[i].kind == Light::Kind::area)
      lamp_of[scene.light[i].instance] = static_cast<std::uint32_t>(i);
  MirrorRows rows(scene);
  for (std::size_t i = 0; i < scene.instance.size(); ++i) {
    const Instance& instance = scene.instance[i];
    for (std::uint32_t k = 0; k < instance.triangle_count; ++k) {
      const std::uint32_t triangle = instance.first_triangle + k, row = rows.of(triangle);
      if (k > 0 && mirror.back() == row) {
        ++count.back();
        continue;
      }
      first.push_back(triangle), count.push_back(1);
      material.push_back(instance.material), mirror.push_back(row), lamp.push_back(lamp_of[i]);
    }
  }
  message.add("part", "first_triangle", first);
  message.add("part", "triangle_count", count);
  message.add("part", "material", material);
  message.add("part", "mirror", mirror);
  message.add("part", "lamp", lamp);
  rows.add_to(message);
}

void add_specular(const Scene& scene, MessageWriter& message) {
  Numbers row;
  Floats reflects, passes;
  std::uint32_t rows = 0;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) {
    const Bsdf bsdf(scene, m);
    row.push_back(bsdf.has_specular() ? rows++ : kNoRow);
    if (!bsdf.has_specular()) continue;
    for (unsigned i = 0; i < kSpecularCosines; ++i) {
      const float cosine = std::max(static_cast<float>(i) / (kSpecularCosines - 1), 1e-3f);
      BsdfSample branches[2];
      const int n = bsdf.specular_branches(Vec3(std::sqrt(1 - cosine * cosine), 0, cosine), branches,
                                           TransportMode::flux);
      Rgb reflected(0), passed(0);
      for (int k = 0; k < n; ++k) (branches[k].transmitted ? passed : reflected) += branches[k].weight;
      add(reflects, reflected), add(passes, passed);
    }
  }
  message.add("material", "specular", row);
  message.add("specular", "reflects", reflects);
  message.add("specular", "passes", passes);
}

}  // namespace phos::inline view
