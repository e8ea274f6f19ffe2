#include "splat/gl/library.h"

#include <dlfcn.h>

#include <new>

namespace phos::inline splat {

GlLibrary::GlLibrary(GlBy by, const char* file) : by_(by), handle_(::dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ != nullptr) return;
  const std::string why = ::dlerror();
  if (why.find("memory") != why.npos || why.find("map segment") != why.npos) throw std::bad_alloc();
  no_context(by, why);
}

void* GlLibrary::address(const char* name) const {
  void* const found = ::dlsym(handle_, name);
  if (found == nullptr) no_context(by_, text("it lacks ", name));
  return found;
}

}  // namespace phos::inline splat
