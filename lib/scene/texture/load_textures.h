// Images to textures: decoded once each, in parallel, and left out where they cannot be.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

/// Collects the textures that materials ask for, then decodes them all.
class TexturePool {
 public:
  /// How a texture is looked up.
  struct Sampling {
    Texture::Wrap wrap_u = Texture::Wrap::repeat, wrap_v = Texture::Wrap::repeat;
    bool nearest = false;
  };
  /// Index for TextureUse::texture. `key` tells textures apart; `bytes` is the encoded image (PNG, JPEG, BMP,
  /// TGA), and empty with `missing` saying why where there is none. `srgb`: decode the colour channels to
  /// linear.
  std::int32_t add(const std::string& key, const std::string& name, std::string bytes,
                   const std::string& missing, const Sampling& sampling, bool srgb);
  /// Fills scene.texture. Uses of textures that cannot be decoded are cleared, with a warning each
  /// (kTextureNotFound). Returns the place in scene.texture of each index that add() gave; -1: none.
  std::vector<std::int32_t> decode(Scene& scene);

 private:
  struct Request {
    std::string name, bytes, missing;
    Sampling sampling;
    bool srgb = false;
  };
  std::vector<Request> requests_;
  std::map<std::string, std::int32_t> known_;
};

}  // namespace phos::inline scene
