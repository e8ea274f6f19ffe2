// Warps from the unit square to directions and shapes. Directions are in a local frame with z up.
#pragma once

#include <cstdint>

#include "core/vector.h"

namespace phos {

inline constexpr float kBelowOne = 0x1.fffffep-1f;  ///< the largest float below 1

/// (cos, sin) of an angle of `turns` full turns, in [0, 1]; error below 1.5e-7. Polynomials: unlike the C
/// library's, the same bits on every machine.
Vec2 cos_sin(float turns);
/// Cosine-weighted direction on the upper hemisphere; density cos(theta)/pi per sr.
Vec3 sample_cosine_hemisphere(const Vec2& u);
/// Uniform on the sphere; density 1/(4 pi) per sr.
Vec3 sample_uniform_sphere(const Vec2& u);
/// Uniform in the cone about +z with cos(theta) in [cos_max, 1]; density 1/(2 pi (1-cos_max)) per sr.
Vec3 sample_uniform_cone(const Vec2& u, float cos_max);
/// About +z with density (n+1)/(2 pi) cos^n(theta) per sr.
Vec3 sample_power_cosine(const Vec2& u, float exponent);
/// Uniform in the unit disc (concentric map).
Vec2 sample_disc(const Vec2& u);
/// Barycentric weights of the second and third vertex, uniform over a triangle.
Vec2 sample_triangle(const Vec2& u);
/// Point i of the additive R2 sequence (Roberts 2018) that starts at `shift`, in [0,1)^2: low discrepancy in
/// two dimensions, however many points there will be.
Vec2 r2_point(int i, const Vec2& shift);
/// Point i >= 0 of the first two dimensions of the Sobol' sequence, each with its digits shifted by 32 random
/// bits, in [0,1)^2: the first 2^k points, and any later 2^k that begin at a multiple of it, have one in each
/// elementary interval (a (0, 2)-sequence). Beside R2 where the same samples choose two things: there the two
/// places do not go together.
Vec2 sobol_point(int i, std::uint32_t shift_x, std::uint32_t shift_y);
/// Point i >= 0 of the additive sequence of the golden ratio that starts at `shift` / 2^32, in [0,1): low
/// discrepancy in one dimension.
float golden_point(int i, std::uint32_t shift);

}  // namespace phos
