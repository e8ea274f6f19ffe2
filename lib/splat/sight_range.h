// How near and how far the scene lies from an eye: the depths of a view.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace phos::inline splat {

/// Distance from `eye` to the farthest corner of the bounds, m.
double farthest_m(const Scene& scene, const Vec3& eye);
/// A distance such that nothing of the scene is nearer to `eye`, except triangles of `but_instance` (-1:
/// none). Never below 1e-6 of farthest_m, nor above it.
double nearest_m(const Scene& scene, const Vec3& eye, std::int64_t but_instance);

}  // namespace phos::inline splat
