// What a picture takes of memory.
#pragma once

#include <string>

#include "splat/picture/render.h"

namespace phos::inline splat {

/// Bytes that render_scene() takes for the pixels of a picture at most, the scene and the records not
/// counted.
double picture_bytes(const RenderOptions& options);

/// Throws Error(no_memory) where a picture takes more than there is. A line for people where it takes a good
/// part (over 1 GiB), else empty.
std::string require_memory(const RenderOptions& options);

}  // namespace phos::inline splat
