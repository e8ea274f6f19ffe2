// An area light that is as bright all over, as a few patches: the quick way to its points.
#pragma once

#include <vector>

#include "core/vector.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline scene {

class LampPanel {
 public:
  /// A triangle, or the parallelogram of two, from a corner along two edges (counter-clockwise seen from the
  /// shining side).
  struct Patch {
    Vec3 corner{0}, edge[2]{Vec3(0), Vec3(0)}, normal{0};
    float error_m = 0;
    bool parallelogram = false;
  };
  /// The way from a point to one of the panel's.
  struct Way {
    float weight_sr =
        0;               ///< projected solid angle over density: illuminance / luminance. 0: it is dark there
    bool above = false;  ///< the geometric surface, too, faces it
    Ray ray;             ///< must be free; t_max_m is not above 0 where nothing fits between
  };

  LampPanel() = default;
  /// Without patches for every light but an area light of one luminance, as seen from everywhere.
  LampPanel(const Scene& scene, const Light& light);

  bool empty() const { return patch_.empty(); }
  const std::vector<Patch>& patches() const { return patch_; }
  /// cd/m2
  const Rgb& luminance() const { return luminance_cd_m2_; }
  bool two_sided() const { return two_sided_; }
  /// Is p so close that points uniform over the area weigh too differently?
  bool near(const Vec3& p) const { return glm::dot(middle_ - p, middle_ - p) < near2_m2_; }
  /// To a point uniform over the area: `u_patch` chooses the patch (of several), `u` the point on it.
  /// Coordinates in [0, 1]. There must be a patch.
  Way way(const SurfacePoint& point, float u_patch, const Vec2& u) const;

 private:
  static bool join(Patch& first, const Patch& second);

  Rgb luminance_cd_m2_{0};
  bool two_sided_ = false;
  float area_m2_ = 0, near2_m2_ = 0;
  Vec3 middle_{0};
  std::vector<float> cdf_;
  std::vector<Patch> patch_;
};

}  // namespace phos::inline scene
