#include "splat/gl/context.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "core/parallel.h"

namespace phos::inline splat {
namespace {

/// Libraries share what is current (Mesa's OSMesa and EGL do), and ask only their own: kept here instead.
thread_local const GlContext* current = nullptr;

template <class Pointer>
void look_up(GlFunction<Pointer>& function, GlBy by, const GlNative& native, const char* name) {
  const GlNative::Function found = native.find(name);
  if (found == nullptr) no_context(by, text("it lacks ", name));
  function.set(reinterpret_cast<Pointer>(found));
}

}  // namespace

GlContext::GlContext(GlBy by) : by_(by) {
  // Read by Mesa's driver when it starts, once per process.
  setenv("LP_NUM_THREADS", std::to_string(std::min(thread_count(), 16)).c_str(), 0);
  const NoFloatTraps traps;
  native_ = gl_kind(by).make();
  make_current();
  try {
    start();
  } catch (...) {
    release();
    throw;
  }
}

void GlContext::start() {
#define PHOS_GL_LOOK_UP(name) look_up(gl_.name, by_, *native_, "gl" #name);
  PHOS_GL_FUNCTIONS(PHOS_GL_LOOK_UP)
#undef PHOS_GL_LOOK_UP
  // A function that is missing has an address all the same: only the version tells.
  const auto* version = reinterpret_cast<const char*>(gl_.GetString(GL_VERSION));
  int major = 0, minor = 0;
  if (version == nullptr || std::sscanf(version, "%d.%d", &major, &minor) != 2 || major * 10 + minor < 45) {
    no_context(by_, text("it offers version ", version == nullptr ? "none" : version));
  }
  const std::string renderer = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
  if (renderer.starts_with("llvmpipe")) refuse_narrow_vectors(by_);
  const std::string detail = native_->detail();
  description_ = text(renderer, ", OpenGL ", version, detail.empty() ? "" : ", ", detail);
  gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_texture_);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

GlContext::~GlContext() {
  const NoFloatTraps traps;
  release();
  native_.reset();
}

void GlContext::make_current() const {
  if (current == this) return;
  const NoFloatTraps traps;
  if (current != nullptr && current->by_ != by_) current->release();
  if (!native_->make_current()) no_context(by_, "it cannot be made current");
  current = this;
}

void GlContext::release() const {
  if (current != this) return;
  native_->release();
  current = nullptr;
}

void GlContext::check(const char* doing) const {
  const GLenum error = gl_.GetError();
  if (error == GL_OUT_OF_MEMORY) {
    throw Error(ExitCode::no_memory, "",
                text("OpenGL ran out of memory ", doing, "; make the picture smaller or pass --splat cpu"));
  }
  PHOS_CHECK(error == GL_NO_ERROR, doing, ": OpenGL error ", error);
}

}  // namespace phos::inline splat
