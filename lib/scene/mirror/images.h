// Light of lamps by way of flat mirrors alone: image sources.
#pragma once

#include "scene/lamp/luminaires.h"
#include "scene/mirror/planes.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Has a light images? Of the environment the sun has; the rest is found in mirrors by rays and
/// photons.
bool has_images(const Scene& scene, const Light& light);

/// Luminance of the sun alone in a direction, cd/m2: 0 beyond its disc, and without a sun.
Rgb sun_luminance(const Scene& scene, const Vec3& direction);

/// A sample of a lamp's image (of an environment, the sun's), seen from a point by way of one chain of
/// lights.mirrors(): as Luminaires::illuminate() has it of the lamp, direction and distance along the
/// unfolded way; `value` with the reflectances and transmittances of the way, which is clear: no shadow ray
/// is left to trace. False where no such light arrives. Deterministic in its arguments; for the place of the
/// sample on the lamp only `u` counts.
bool illuminate_by_mirrors(const RayScene& rays, const Luminaires& lights, std::size_t chain,
                           std::size_t light, const SurfacePoint& from, float u_triangle, const Vec2& u,
                           Illumination& result);

}  // namespace phos::inline scene
