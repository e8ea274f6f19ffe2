#include "splat/gl/osmesa.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>

#include "splat/gl/library.h"

namespace phos::inline splat {
namespace {

struct OsMesa {
  GlLibrary library{GlBy::osmesa, PHOS_OSMESA};
#define PHOS_OSMESA_FUNCTION(name) \
  decltype(::OSMesa##name)* name = library.find<decltype(::OSMesa##name)>("OSMesa" #name)
  PHOS_OSMESA_FUNCTION(CreateContextAttribs);
  PHOS_OSMESA_FUNCTION(DestroyContext);
  PHOS_OSMESA_FUNCTION(GetProcAddress);
  PHOS_OSMESA_FUNCTION(MakeCurrent);
#undef PHOS_OSMESA_FUNCTION
};

const OsMesa& osmesa() {
  static const OsMesa loaded;
  return loaded;
}

class OsMesaNative : public GlNative {
 public:
  explicit OsMesaNative(OSMesaContext context) : context_(context) {}
  ~OsMesaNative() override { osmesa().DestroyContext(context_); }
  OsMesaNative(const OsMesaNative&) = delete;
  OsMesaNative& operator=(const OsMesaNative&) = delete;

  bool make_current() override {
    return osmesa().MakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, 16, 16) != GL_FALSE;
  }
  void release() override { osmesa().MakeCurrent(nullptr, nullptr, 0, 0, 0); }
  Function find(const char* name) const override { return osmesa().GetProcAddress(name); }
  std::string detail() const override { return ""; }

 private:
  OSMesaContext context_;
  std::array<std::uint8_t, 16 * 16 * 4> dummy_{};  // everything is drawn into framebuffer objects
};

}  // namespace

std::unique_ptr<GlNative> make_osmesa() {
  refuse_narrow_vectors(GlBy::osmesa);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            4,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            5,
                            0};
  const OSMesaContext context = osmesa().CreateContextAttribs(attributes, nullptr);
  if (context == nullptr) no_context(GlBy::osmesa, "it refuses to make one (is GALLIUM_DRIVER set?)");
  return std::make_unique<OsMesaNative>(context);
}

}  // namespace phos::inline splat
