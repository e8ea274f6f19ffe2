#include "splat/gl/context.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.h"
#include "core/last_words.h"
#include "core/parallel.h"

namespace phos::inline splat {
namespace {

[[noreturn]] void no_context(const std::string& why) {
  if (for_want_of_memory("")) throw std::bad_alloc();
  throw Error(ExitCode::bad_input, "",
              text("no OpenGL 4.5 core context from OSMesa: ", why,
                   "; pass --splat cpu (and not --direct shadow-map), which need none"));
}

/// With vectors of 128 bits the driver corrupts its heap instead of failing.
void refuse_narrow_vectors() {
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width != nullptr && std::strcmp(width, "128") == 0) {
    no_context("its driver is not safe with LP_NATIVE_VECTOR_WIDTH=128 (unset it)");
  }
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx")) no_context("its driver is not safe on a processor without AVX");
#endif
}

/// OSMesa and the compiler behind it take long to load: only programs that draw load them.
struct Library {
  void* handle = ::dlopen(PHOS_OSMESA, RTLD_NOW | RTLD_LOCAL);
  Library() {
    if (handle != nullptr) return;
    const std::string why = ::dlerror();
    if (why.find("memory") != why.npos || why.find("map segment") != why.npos) throw std::bad_alloc();
    no_context(why);
  }
  template <class Function>
  Function* find(const char* name) const {
    void* const found = ::dlsym(handle, name);
    if (found == nullptr) no_context(text("it lacks ", name));
    return reinterpret_cast<Function*>(found);
  }
};

struct OsMesa {
  Library library;
#define PHOS_OSMESA_FUNCTION(name) \
  decltype(::OSMesa##name)* name = library.find<decltype(::OSMesa##name)>("OSMesa" #name)
  PHOS_OSMESA_FUNCTION(CreateContextAttribs);
  PHOS_OSMESA_FUNCTION(DestroyContext);
  PHOS_OSMESA_FUNCTION(GetCurrentContext);
  PHOS_OSMESA_FUNCTION(GetProcAddress);
  PHOS_OSMESA_FUNCTION(MakeCurrent);
#undef PHOS_OSMESA_FUNCTION
};

const OsMesa& osmesa() {
  static const OsMesa loaded;
  return loaded;
}

template <class Pointer>
void look_up(GlFunction<Pointer>& function, const char* name) {
  const OSMESAproc found = osmesa().GetProcAddress(name);
  if (found == nullptr) no_context(text("it lacks ", name));
  function.set(reinterpret_cast<Pointer>(found));
}

}  // namespace

struct GlContext::Native {
  OSMesaContext context = nullptr;
  std::array<std::uint8_t, 16 * 16 * 4> dummy{};  // everything is drawn into framebuffer objects
  ~Native() {
    if (context != nullptr) osmesa().DestroyContext(context);
  }
};

GlContext::GlContext() : native_(std::make_unique<Native>()) {
  refuse_narrow_vectors();
  // Read by the driver when it starts, once per process.
  setenv("LP_NUM_THREADS", std::to_string(std::min(thread_count(), 16)).c_str(), 0);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            4,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            5,
                            0};
  const NoFloatTraps traps;
  native_->context = osmesa().CreateContextAttribs(attributes, nullptr);
  if (native_->context == nullptr) no_context("it refuses to make one (is GALLIUM_DRIVER set?)");
  make_current();
#define PHOS_GL_LOOK_UP(name) look_up(gl_.name, "gl" #name);
  PHOS_GL_FUNCTIONS(PHOS_GL_LOOK_UP)
#undef PHOS_GL_LOOK_UP
  // A function that is missing has an address all the same: only the version tells.
  const auto* version = reinterpret_cast<const char*>(gl_.GetString(GL_VERSION));
  int major = 0, minor = 0;
  if (version == nullptr || std::sscanf(version, "%d.%d", &major, &minor) != 2 || major * 10 + minor < 45) {
    no_context(text("it offers version ", version == nullptr ? "none" : version));
  }
  description_ = text(reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER)), ", OpenGL ", version);
  gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_texture_);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

GlContext::~GlContext() = default;

void GlContext::make_current() const {
  if (osmesa().GetCurrentContext() == native_->context) return;
  const NoFloatTraps traps;
  if (osmesa().MakeCurrent(native_->context, native_->dummy.data(), GL_UNSIGNED_BYTE, 16, 16) == GL_FALSE) {
    no_context("it cannot be made current");
  }
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
