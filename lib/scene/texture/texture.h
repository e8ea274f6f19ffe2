// Looking textures up where a surface uses them.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Linear value, 0..1, of a channel's code out of 0..largest.
float decode_channel(int code, int largest, bool srgb);

/// Texture coordinates after KHR_texture_transform (scale, then rotation, then offset).
Vec2 transformed(const TextureUse& use, const Vec2& uv);

/// The texture at texture coordinates of its own set; (1,1,1,1) where the use names no texture.
Vec4 look_up(const Scene& scene, const TextureUse& use, const Vec2& uv0, const Vec2& uv1);

/// Mean of all texels, linear; (1,1,1,1) where the use names no texture, or an empty one.
Vec4 mean_texel(const Scene& scene, const TextureUse& use);

/// Texture coordinates of a point of a triangle, `set` 0 or 1; (0,0) where the scene has none. `u` and `v`
/// are the barycentric weights of the second and third vertex.
Vec2 texture_coordinates(const Scene& scene, std::uint32_t triangle, int set, float u, float v);

/// Luminance leaving the shining side of a triangle at one of its points, cd/m2, emissive texture and
/// visible_share() included.
Rgb emission_at(const Scene& scene, std::uint32_t triangle, float u, float v);

}  // namespace phos::inline scene
