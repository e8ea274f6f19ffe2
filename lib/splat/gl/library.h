// A shared library that is loaded when something is first drawn.
#pragma once

#include "splat/gl/kinds.h"

namespace phos::inline splat {

/// OpenGL's libraries, and the compilers behind them, take long to load: only programs that draw load them.
class GlLibrary {
 public:
  /// Throws NoGl where it is not there, std::bad_alloc where memory lacks.
  GlLibrary(GlBy by, const char* file);
  /// Throws NoGl where it has no such function.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;
  GlBy by_;
  void* handle_;  // never closed: drivers have threads
};

}  // namespace phos::inline splat
