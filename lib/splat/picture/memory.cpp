#include "splat/picture/memory.h"

#include "core/error.h"
#include "core/memory.h"
#include "splat/direct/interleaved.h"
#include "splat/gbuffer.h"
#include "splat/picture/layers.h"
#include "splat/splatter.h"

namespace phos::inline splat {
namespace {

/// Bytes a pixel: of the visible surface, and of the records drawn there.
constexpr double kSeen = sizeof(Hit) + 3 * sizeof(Vec4), kSplats = 3 * sizeof(Vec4);
/// Bytes a pixel of OpenGL's own buffers, measured with OSMesa.
constexpr double kOpenGl = 128;
constexpr double kMuch = 1024.0 * 1024 * 1024;

}  // namespace

double picture_bytes(const RenderOptions& options) {
  double of_pixel = kSeen + kSplats;
  if (options.splat == SplatBy::gl) of_pixel += kOpenGl;
  if (options.direct == DirectBy::interleaved) of_pixel += sizeof(SharedLight);
  of_pixel += Layers::bytes_of_pixel(LayerSet(options.layers));
  return of_pixel * static_cast<double>(options.width) * static_cast<double>(options.height);
}

std::string require_memory(const RenderOptions& options) {
  const double needed = picture_bytes(options), free = static_cast<double>(free_memory_bytes());
  const std::string takes = text("a picture of ", options.width, " x ", options.height, " takes about ",
                                 memory_text(needed), " of memory");
  if (needed > free) {
    RenderOptions least = options;
    least.layers = {"beauty"}, least.splat = SplatBy::cpu;
    const double small = picture_bytes(least);
    throw Error(
        ExitCode::no_memory, "",
        text(takes, ", and ", memory_text(free), " are free; give a smaller --width",
             small < free ? text(", or --layers beauty --splat cpu (", memory_text(small), ")") : ""));
  }
  return needed > kMuch ? takes : "";
}

}  // namespace phos::inline splat
