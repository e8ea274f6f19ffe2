// Contexts of EGL without a window or a display: of a GPU, or of Mesa's driver in software.
#pragma once

#include <memory>

#include "splat/gl/kinds.h"

namespace phos::inline splat {

/// Of the first GPU that gives one (EGL_PLATFORM_DEVICE_EXT); where none does, of Mesa's surfaceless platform
/// (EGL_MESA_platform_surfaceless) or of a device in software. Throws NoGl.
std::unique_ptr<GlNative> make_egl();

}  // namespace phos::inline splat
