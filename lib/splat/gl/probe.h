// Can OpenGL draw on this machine?
#pragma once

#include <string>

namespace phos::inline splat {

/// Draws one triangle over a small picture through OSMesa and reads the picture back. Returns the driver's
/// name and version. Throws Error(bad_input) where no context can be had, or the picture is wrong. A broken
/// library may end the process: call it in one of its own.
std::string try_gl();

}  // namespace phos::inline splat
