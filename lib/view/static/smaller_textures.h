// Textures for a page that is to be small.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace phos::inline view {

struct SmallerTextures {
  std::string message;      ///< MessageKind::scene
  std::size_t reduced = 0;  ///< textures that are smaller than they were
};

/// The scene of a message with textures of at most this many texels on a side (1 or more). Each texel of a
/// reduced texture is the mean of the area that it covers, of linear light where the colours are sRGB, of
/// each channel for itself. Throws Error(bad_input) for a message that is no whole scene.
SmallerTextures with_smaller_textures(std::string_view scene_message, unsigned most_side);

}  // namespace phos::inline view
