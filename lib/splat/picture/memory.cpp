#include "splat/picture/memory.h"

#include "core/error.h"
#include "core/memory.h"
#include "splat/direct/interleaved.h"
#include "splat/gbuffer.h"
#include "splat/picture/layers.h"

namespace phos::inline splat {
namespace {

/// Bytes a pixel: of the visible surface, and of the records drawn there.
constexpr double kSeen = sizeof(Hit) + 3 * sizeof(Vec4), kSplats = 3 * sizeof(Vec4);
/// Bytes a pixel of OpenGL's own buffers, measured with OSMesa.
constexpr double kOpenGl = 128;

}  // namespace

double picture_bytes(const RenderOptions& options) {
  double of_pixel = kSeen + kSplats;
  if (options.splat == SplatBy::gl) of_pixel += kOpenGl;
  if (options.direct == DirectBy::interleaved) of_pixel += sizeof(SharedLight);
  of_pixel += Layers::bytes_of_pixel(LayerSet(options.layers));
  return of_pixel * static_cast<double>(options.width) * static_cast<double>(options.height);
}

std::string require_memory(const RenderOptions& options) {
  RenderOptions least = options;
  least.layers = {"beauty"}, least.splat = SplatBy::cpu;
  const double small = picture_bytes(least);
  return phos::require_memory(
      text("a picture of ", options.width, " x ", options.height), picture_bytes(options),
      text("give a smaller --width", small < static_cast<double>(free_memory_bytes())
                                         ? text(", or --layers beauty --splat cpu (", memory_text(small), ")")
                                         : ""));
}

}  // namespace phos::inline splat
