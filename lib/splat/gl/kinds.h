// What contexts of OpenGL are had from: one row for each library.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/error.h"

namespace phos::inline splat {

enum class GlBy {
  osmesa,  ///< in software
  egl      ///< a GPU without a display; in software where there is none
};

/// A context of a library. Not current, of no thread, when it is destroyed.
class GlNative {
 public:
  using Function = void (*)();
  virtual ~GlNative() = default;
  /// In the thread that calls; false: it cannot be.
  virtual bool make_current() = 0;
  /// It is current in the thread that calls, and no longer.
  virtual void release() = 0;
  /// Of OpenGL, by its whole name ("glFinish"), while the context is current; null: there is none.
  virtual Function find(const char* name) const = 0;
  /// What the context's description says beside the driver's name and version; "" if nothing.
  virtual std::string detail() const = 0;
};

struct GlKind {
  GlBy by;
  const char *option, *name;  ///< of --gl; for people
  bool required;              ///< a default setting of some program fails without it
  const char* instead;        ///< what to do without it: the end of an error's line
  const char* remedy;         ///< how it is had
  /// OpenGL 4.5 core. Throws NoGl.
  std::unique_ptr<GlNative> (*make)();
};

std::span<const GlKind> gl_kinds();
const GlKind& gl_kind(GlBy by);

/// What contexts of this process are had from where nothing else is said: OSMesa, until choose_gl().
GlBy chosen_gl();
void choose_gl(GlBy by);

/// Error(bad_input): OpenGL cannot be had from a library.
class NoGl : public Error {
 public:
  NoGl(GlBy by, const std::string& why);
  const std::string& why() const { return why_; }

 private:
  std::string why_;
};

/// Throws NoGl, or std::bad_alloc where memory lacks.
[[noreturn]] void no_context(GlBy by, const std::string& why);

/// With vectors of 128 bits Mesa's driver corrupts its heap instead of failing. Throws NoGl where it would
/// have them.
void refuse_narrow_vectors(GlBy by);

}  // namespace phos::inline splat
