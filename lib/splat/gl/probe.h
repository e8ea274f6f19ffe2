// Can OpenGL draw on this machine?
#pragma once

#include <string>

#include "splat/gl/kinds.h"

namespace phos::inline splat {

/// Draws one triangle over a small picture and reads the picture back. Returns the driver's name and version.
/// Throws NoGl where no context can be had, or the picture is wrong. A broken library may end the process:
/// call it in one of its own where that must not be.
std::string try_gl(GlBy by);

}  // namespace phos::inline splat
