#include "splat/gl/egl.h"

#define EGL_NO_X11  // headers of X11 define common words
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "splat/gl/library.h"

namespace phos::inline splat {
namespace {

struct EglLibrary {
  GlLibrary library{GlBy::egl, "libEGL.so.1"};
#define PHOS_EGL_FUNCTION(name) decltype(::egl##name)* name = library.find<decltype(::egl##name)>("egl" #name)
  PHOS_EGL_FUNCTION(BindAPI);
  PHOS_EGL_FUNCTION(CreateContext);
  PHOS_EGL_FUNCTION(DestroyContext);
  PHOS_EGL_FUNCTION(GetError);
  PHOS_EGL_FUNCTION(GetPlatformDisplay);
  PHOS_EGL_FUNCTION(GetProcAddress);
  PHOS_EGL_FUNCTION(Initialize);
  PHOS_EGL_FUNCTION(MakeCurrent);
  PHOS_EGL_FUNCTION(QueryString);
  PHOS_EGL_FUNCTION(Terminate);
#undef PHOS_EGL_FUNCTION
};

/// Is the extension in a list with spaces between? Null is an empty list.
bool lists(const char* extensions, const std::string& extension) {
  std::istringstream words(extensions == nullptr ? "" : extensions);
  for (std::string word; words >> word;)
    if (word == extension) return true;
  return false;
}

/// A display that may be there.
struct Candidate {
  std::string name;  // for people
  EGLenum platform;
  void* native;
};

/// GPUs first, then software.
std::vector<Candidate> candidates(const EglLibrary& egl) {
  const char* const client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<Candidate> all, software;
  if (lists(client, "EGL_MESA_platform_surfaceless"))
    software.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.GetProcAddress("eglQueryDevicesEXT"));
  const auto query_device =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.GetProcAddress("eglQueryDeviceStringEXT"));
  if (!lists(client, "EGL_EXT_platform_device") || query_devices == nullptr || query_device == nullptr)
    return software;
  EGLint count = 0;
  if (query_devices(0, nullptr, &count) == EGL_FALSE || count < 1) return software;
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (query_devices(count, devices.data(), &count) == EGL_FALSE) return software;
  devices.resize(static_cast<std::size_t>(std::max(count, 0)));
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const bool in_software = lists(query_device(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
    (in_software ? software : all).push_back({text("device ", i), EGL_PLATFORM_DEVICE_EXT, devices[i]});
  }
  all.insert(all.end(), software.begin(), software.end());
  return all;
}

/// The library, and the first display that gives contexts.
struct Egl : EglLibrary {
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string detail;

  Egl() {
    std::string faults;
    for (const Candidate& candidate : candidates(*this)) {
      const std::string fault = open(candidate);
      if (fault.empty()) return;
      faults += text(faults.empty() ? "" : ", ", candidate.name, " ", fault);
    }
    no_context(GlBy::egl, faults.empty() ? "it knows no GPU, and no platform without a display" : faults);
  }

  EGLContext make_context() const {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    if (BindAPI(EGL_OPENGL_API) == EGL_FALSE) return EGL_NO_CONTEXT;
    return CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  }

 private:
  /// "" if all is well; else display is closed.
  std::string open(const Candidate& candidate) {
    display = GetPlatformDisplay(candidate.platform, candidate.native, nullptr);
    if (display == EGL_NO_DISPLAY) return text("is no display (", error(), ")");
    EGLint major = 0, minor = 0;
    if (Initialize(display, &major, &minor) == EGL_FALSE) return text("does not start (", error(), ")");
    const std::string fault = try_context();
    if (!fault.empty())
      Terminate(display);
    else
      detail = text("EGL ", major, ".", minor, " of ", QueryString(display, EGL_VENDOR));
    return fault;
  }
  std::string try_context() const {
    const char* const has = QueryString(display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
      if (!lists(has, needed)) return text("lacks ", needed);
    const EGLContext context = make_context();
    if (context == EGL_NO_CONTEXT) return text("refuses to make one (", error(), ")");
    DestroyContext(display, context);
    return "";
  }
  std::string error() const {
    std::ostringstream out;
    out << "EGL error 0x" << std::hex << GetError();
    return out.str();
  }
};

const Egl& egl() {
  static const Egl loaded;
  return loaded;
}

class EglNative : public GlNative {
 public:
  explicit EglNative(EGLContext context) : context_(context) {}
  ~EglNative() override { egl().DestroyContext(egl().display, context_); }
  EglNative(const EglNative&) = delete;
  EglNative& operator=(const EglNative&) = delete;

  bool make_current() override {
    return egl().MakeCurrent(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_FALSE;
  }
  void release() override {
    egl().MakeCurrent(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  Function find(const char* name) const override { return egl().GetProcAddress(name); }
  std::string detail() const override { return egl().detail; }

 private:
  EGLContext context_;
};

}  // namespace

std::unique_ptr<GlNative> make_egl() {
  setenv("EGL_LOG_LEVEL", "fatal", 0);  // Mesa writes to stderr of devices that it cannot open
  const EGLContext context = egl().make_context();
  if (context == EGL_NO_CONTEXT) no_context(GlBy::egl, "it refuses to make another one");
  return std::make_unique<EglNative>(context);
}

}  // namespace phos::inline splat
