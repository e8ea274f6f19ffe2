// OpenGL objects that delete themselves. Private to the OpenGL sources of this module.
#pragma once

#include <initializer_list>
#include <span>
#include <utility>

#include "core/vector.h"
#include "splat/gl/context.h"

namespace phos::inline splat {

/// One name of one kind. Empty after a move. Its context must be current when it goes.
class GlObject {
 public:
  using Delete = void (*)(const Gl&, GLuint);
  GlObject() = default;
  GlObject(const Gl& gl, GLuint id, Delete destroy) : gl_(&gl), id_(id), delete_(destroy) {}
  GlObject(GlObject&& o) noexcept : gl_(o.gl_), id_(std::exchange(o.id_, 0)), delete_(o.delete_) {}
  GlObject& operator=(GlObject&& o) noexcept {
    std::swap(gl_, o.gl_), std::swap(id_, o.id_), std::swap(delete_, o.delete_);
    return *this;
  }
  ~GlObject() {
    if (id_ != 0) delete_(*gl_, id_);
  }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  const Gl* gl_ = nullptr;
  GLuint id_ = 0;
  Delete delete_ = nullptr;
};

GlObject make_buffer(const Gl& gl);
GlObject make_vertex_array(const Gl& gl);
/// Immutable storage, nearest filtering, clamped.
GlObject make_texture(const Gl& gl, GLenum format, int width, int height);
GlObject make_texture_array(const Gl& gl, GLenum format, int width, int height, int layers);
/// Draws into `colours` (attachments 0, 1, ...) with `depth` (0: none).
GlObject make_framebuffer(const Gl& gl, std::initializer_list<GLuint> colours, GLuint depth);

/// A linked program and its uniforms by name.
class GlProgram {
 public:
  GlProgram() = default;
  /// `label` names it if it does not compile (a mistake of ours).
  GlProgram(const Gl& gl, const char* label, const char* vertex, const char* fragment);
  explicit operator bool() const { return static_cast<bool>(program_); }
  void use() const;
  void set(const char* name, float v) const;
  void set(const char* name, int v) const;
  void set(const char* name, std::uint32_t v) const;
  void set(const char* name, const Vec2& v) const;
  void set(const char* name, const Vec3& v) const;
  void set(const char* name, const Vec4& v) const;
  void set(const char* name, std::span<const Mat3> v) const;

 private:
  GLint at(const char* name) const;
  const Gl* gl_ = nullptr;
  GlObject program_;
};

}  // namespace phos::inline splat
