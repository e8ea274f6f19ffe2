// OpenGL 4.5 core without a window. Private to the OpenGL sources of this module.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <memory>
#include <string>

#include "core/float_traps.h"
#include "splat/gl/kinds.h"

namespace phos::inline splat {

// Every function that is called. They are looked up at run time: the library exports the older ones only.
#define PHOS_GL_FUNCTIONS(X)                                                                                 \
  X(AttachShader)                                                                                            \
  X(BindBufferBase)                                                                                          \
  X(BindFramebuffer)                                                                                         \
  X(BindTextureUnit)                                                                                         \
  X(BindVertexArray)                                                                                         \
  X(BlendFunc)                                                                                               \
  X(CheckNamedFramebufferStatus)                                                                             \
  X(ClearNamedFramebufferfv)                                                                                 \
  X(ClearNamedFramebufferuiv)                                                                                \
  X(ClipControl)                                                                                             \
  X(ColorMask)                                                                                               \
  X(CompileShader) X(CreateBuffers) X(CreateFramebuffers) X(CreateProgram) X(CreateShader) X(CreateTextures) \
      X(CreateVertexArrays) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteShader)          \
          X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable) X(DrawArrays)         \
              X(DrawArraysInstanced) X(DrawElements) X(Enable) X(EnableVertexArrayAttrib) X(Finish)          \
                  X(GetError) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog)        \
                      X(GetShaderiv) X(GetString) X(GetTextureImage) X(GetUniformLocation) X(LinkProgram)    \
                          X(NamedBufferData) X(NamedFramebufferDrawBuffers) X(NamedFramebufferTexture)       \
                              X(NamedFramebufferTextureLayer) X(PixelStorei) X(ProgramUniform1f)             \
                                  X(ProgramUniform1i) X(ProgramUniform1ui) X(ProgramUniform2f)               \
                                      X(ProgramUniform3f) X(ProgramUniform4f) X(ProgramUniformMatrix3fv)     \
                                          X(ShaderSource) X(TextureParameteri) X(TextureStorage2D)           \
                                              X(TextureStorage3D) X(TextureSubImage2D) X(UseProgram)         \
                                                  X(VertexArrayAttribBinding) X(VertexArrayAttribFormat)     \
                                                      X(VertexArrayBindingDivisor)                           \
                                                          X(VertexArrayElementBuffer)                        \
                                                              X(VertexArrayVertexBuffer) X(Viewport)

/// A function of OpenGL. Called without traps: the driver and the shaders that it compiles divide by zero.
template <class Pointer>
class GlFunction;
template <class Result, class... Arguments>
class GlFunction<Result (*)(Arguments...)> {
 public:
  using Pointer = Result (*)(Arguments...);
  void set(Pointer pointer) { pointer_ = pointer; }
  Result operator()(Arguments... arguments) const {
    const NoFloatTraps traps;
    return pointer_(arguments...);
  }

 private:
  Pointer pointer_ = nullptr;
};

struct Gl {
#define PHOS_GL_POINTER(name) GlFunction<decltype(&::gl##name)> name;
  PHOS_GL_FUNCTIONS(PHOS_GL_POINTER)
#undef PHOS_GL_POINTER
};

/// A context of its own, current in the thread that made it.
class GlContext {
 public:
  /// Throws NoGl where no 4.5 core context can be had.
  explicit GlContext(GlBy by = chosen_gl());
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  void make_current() const;
  const Gl& gl() const { return gl_; }
  const std::string& description() const { return description_; }
  int largest_texture() const { return largest_texture_; }
  /// Throws Error(no_memory) if OpenGL ran out of memory since the last call; another error is a mistake of
  /// ours.
  void check(const char* doing) const;

 private:
  void start();
  void release() const;  // if it is current

  GlBy by_;
  std::unique_ptr<GlNative> native_;
  Gl gl_;
  std::string description_;
  int largest_texture_ = 0;
};

}  // namespace phos::inline splat
