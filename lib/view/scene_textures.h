// Textures of a scene as the page draws them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "scene/scene.h"
#include "view/message/writer.h"

namespace phos::inline view {

/// The textures of colours and emission, in the order of their first use, 8 bits a channel.
class SceneTextures {
 public:
  /// Texels of all together: at most `most_texels`, or 1 for each texture. The sides of the largest are
  /// halved until they fit; a texel is then the mean of the block that it stands for. Keeps a reference to
  /// `scene`.
  SceneTextures(const Scene& scene, std::size_t most_texels) : scene_(scene), most_texels_(most_texels) {}

  /// Row of the texture; kNoRow: the use names none.
  std::uint32_t row(const TextureUse& use);
  /// The tables `texture` and `texel`.
  void add_to(MessageWriter& message) const;

 private:
  const Scene& scene_;
  std::size_t most_texels_;
  std::map<std::int32_t, std::uint32_t> row_;
  std::vector<const Texture*> used_;
};

}  // namespace phos::inline view
