// Textures of a scene as the page draws them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "scene/scene.h"
#include "view/limits.h"
#include "view/message/writer.h"

namespace phos::inline view {

/// The most texels that a page gets.
struct TextureLimits {
  std::size_t all = kMostPageTexels.as<std::size_t>();         ///< of all textures together
  std::size_t side = std::numeric_limits<std::size_t>::max();  ///< of the longer side of each; 1 or more
};

/// The textures of colours and emission, in the order of their first use, 8 bits a channel.
class SceneTextures {
 public:
  /// The sides of a texture that is too large are halved until it fits, then those of the largest until all
  /// together do, or are of one texel each. A texel of such a texture is the mean, of linear light, of the
  /// block that it stands for. Keeps a reference to `scene`.
  SceneTextures(const Scene& scene, const TextureLimits& most) : scene_(scene), most_(most) {}

  /// Row of the texture; kNoRow: the use names none.
  std::uint32_t row(const TextureUse& use);
  /// Adds the tables `texture` and `texel`. Returns how many textures have fewer texels there than in the
  /// scene.
  std::size_t add_to(MessageWriter& message) const;

 private:
  const Scene& scene_;
  TextureLimits most_;
  std::map<std::int32_t, std::uint32_t> row_;
  std::vector<const Texture*> used_;
};

}  // namespace phos::inline view
