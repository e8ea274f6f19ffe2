// --gl: the library that the process draws with.
#pragma once

#include "core/options.h"
#include "file/tool.h"
#include "splat/gl/kinds.h"

namespace phos::inline splat {

/// --gl. Files record it where OpenGL was not OSMesa's.
void declare_gl(Options& options, GlBy& by);
/// Draws a small picture by it and says with what; contexts that are made after this call are had from it.
/// Where it cannot draw, warns why, and sets `by` to OSMesa. Call before up_to_date().
void use_gl(const Tool& tool, GlBy& by);

}  // namespace phos::inline splat
