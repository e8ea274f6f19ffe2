#include "splat/gl/choice.h"

#include "splat/gl/probe.h"

namespace phos::inline splat {
void declare_gl(Options& options, GlBy& by) {
  Names<GlBy> names;
  for (const GlKind& kind : gl_kinds()) names.emplace_back(kind.option, kind.by);
  options.choice<GlBy>(
      "gl", by, names,
      "library of OpenGL: osmesa: drawing in software; egl: on a GPU without a display, or in software "
      "without "
      "a GPU. Both give the same picture to 1e-3. Without EGL a warning gives the reason, and OSMesa draws",
      Recorded::unless_default);
}

void use_gl(const Tool& tool, GlBy& by) {
  if (by == chosen_gl()) return;
  const GlKind& kind = gl_kind(by);
  try {
    tool.say(text("OpenGL by ", kind.name, ": ", try_gl(by)));
  } catch (const NoGl& e) {
    by = GlBy::osmesa;
    tool.warn(text("--gl ", kind.option, ": ", e.why(), "; ", gl_kind(by).name, " draws instead"));
  }
  choose_gl(by);
}

}  // namespace phos::inline splat
