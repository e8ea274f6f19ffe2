#include "splat/gl/kinds.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/last_words.h"
#include "splat/gl/egl.h"
#include "splat/gl/osmesa.h"

namespace phos::inline splat {
namespace {

constexpr GlKind kKinds[] = {
    {GlBy::osmesa, "osmesa", "OSMesa", true,
     "pass --splat cpu (and not --direct shadow-map), which need none",
     "apt-get install libosmesa6; or phos-splat --splat cpu", make_osmesa},
    {GlBy::egl, "egl", "EGL", false, "pass --gl osmesa",
     "apt-get install libegl1, and the driver of the GPU; only --gl egl needs it", make_egl},
};

std::atomic<GlBy> chosen = GlBy::osmesa;

}  // namespace

std::span<const GlKind> gl_kinds() { return kKinds; }

const GlKind& gl_kind(GlBy by) {
  for (const GlKind& kind : kKinds)
    if (kind.by == by) return kind;
  PHOS_CHECK(false, "OpenGL by ", static_cast<int>(by));
}

GlBy chosen_gl() { return chosen; }

void choose_gl(GlBy by) { chosen = by; }

NoGl::NoGl(GlBy by, const std::string& why)
    : Error(ExitCode::bad_input, "",
            text("no OpenGL 4.5 core context from ", gl_kind(by).name, ": ", why, "; ", gl_kind(by).instead)),
      why_(why) {}

void no_context(GlBy by, const std::string& why) {
  if (for_want_of_memory("")) throw std::bad_alloc();
  throw NoGl(by, why);
}

void refuse_narrow_vectors(GlBy by) {
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width != nullptr && std::strcmp(width, "128") == 0) {
    no_context(by, "its driver is not safe with LP_NATIVE_VECTOR_WIDTH=128 (unset it)");
  }
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx")) no_context(by, "its driver is not safe on a processor without AVX");
#endif
}

}  // namespace phos::inline splat
