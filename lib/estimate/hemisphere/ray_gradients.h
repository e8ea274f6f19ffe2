// Gradients of irradiance from the rays of a hemisphere.
#pragma once

#include <cstddef>

#include "core/vector.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/zone/gradients.h"

namespace phos::inline estimate {

/// Does the nearer of the hits of two neighbouring rays hide part of the other (docs/methods.md#b5)? Then
/// their edge moves with the nearer. Distances below `least_m` count as that much.
bool one_hides_other(const Hemisphere& h, std::size_t a, std::size_t b, float least_m);

/// Gradients of irradiance_of. Rotation by ring means of the tangent (docs/methods.md#b1; unstructured: the
/// analytic sum on 8 rings). Translation by `mode`: hybrid, analytic, ward_heckbert, krivanek or none; an
/// unstructured set and one of equal solid angles allow analytic and none. Distances below `least_m` count as
/// that much (a ray that starts at a crease).
Gradients ray_gradients(const Hemisphere& h, GradientMode mode, float least_m);

/// What occlusion adds to the translation gradient (docs/methods.md#b5): mode hybrid less mode analytic, of a
/// stratified set of equal projected solid angles.
struct OcclusionGradient {
  Vec3 light[3]{Vec3(0), Vec3(0), Vec3(0)};  ///< lx/m, by colour
  Vec3 even{0};                              ///< 1/m: were all of the hemisphere of radiance 1 / pi
};
OcclusionGradient occlusion_gradient(const Hemisphere& h, float least_m);

}  // namespace phos::inline estimate
