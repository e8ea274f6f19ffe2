// Contexts of OSMesa: OpenGL in software.
#pragma once

#include <memory>

#include "splat/gl/kinds.h"

namespace phos::inline splat {

/// Throws NoGl.
std::unique_ptr<GlNative> make_osmesa();

}  // namespace phos::inline splat
