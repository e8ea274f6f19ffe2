#include "splat/gl/objects.h"

#include <string>
#include <vector>

#include "core/error.h"

namespace phos::inline splat {
namespace {

GlObject compile(const Gl& gl, const char* label, GLenum kind, const char* source) {
  GlObject shader(gl, gl.CreateShader(kind), [](const Gl& g, GLuint id) { g.DeleteShader(id); });
  gl.ShaderSource(shader.id(), 1, &source, nullptr);
  gl.CompileShader(shader.id());
  GLint good = GL_FALSE;
  gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &good);
  char log[1024] = "";
  if (good == GL_FALSE) gl.GetShaderInfoLog(shader.id(), sizeof log, nullptr, log);
  PHOS_CHECK(good != GL_FALSE, label, ": ", log);
  return shader;
}

}  // namespace

GlObject make_buffer(const Gl& gl) {
  GLuint id = 0;
  gl.CreateBuffers(1, &id);
  return {gl, id, [](const Gl& g, GLuint i) { g.DeleteBuffers(1, &i); }};
}

GlObject make_vertex_array(const Gl& gl) {
  GLuint id = 0;
  gl.CreateVertexArrays(1, &id);
  return {gl, id, [](const Gl& g, GLuint i) { g.DeleteVertexArrays(1, &i); }};
}

static GlObject new_texture(const Gl& gl, GLenum target) {
  GLuint id = 0;
  gl.CreateTextures(target, 1, &id);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    gl.TextureParameteri(id, filter, GL_NEAREST);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TextureParameteri(id, wrap, GL_CLAMP_TO_EDGE);
  return {gl, id, [](const Gl& g, GLuint i) { g.DeleteTextures(1, &i); }};
}

GlObject make_texture(const Gl& gl, GLenum format, int width, int height) {
  GlObject texture = new_texture(gl, GL_TEXTURE_2D);
  gl.TextureStorage2D(texture.id(), 1, format, width, height);
  return texture;
}

GlObject make_texture_array(const Gl& gl, GLenum format, int width, int height, int layers) {
  GlObject texture = new_texture(gl, GL_TEXTURE_2D_ARRAY);
  gl.TextureStorage3D(texture.id(), 1, format, width, height, layers);
  return texture;
}

GlObject make_framebuffer(const Gl& gl, std::initializer_list<GLuint> colours, GLuint depth) {
  GLuint id = 0;
  gl.CreateFramebuffers(1, &id);
  GlObject framebuffer(gl, id, [](const Gl& g, GLuint i) { g.DeleteFramebuffers(1, &i); });
  std::vector<GLenum> targets;
  for (const GLuint colour : colours) {
    targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
    gl.NamedFramebufferTexture(id, targets.back(), colour, 0);
  }
  gl.NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(targets.size()), targets.data());
  if (depth != 0) gl.NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, depth, 0);
  const GLenum status = gl.CheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(ExitCode::bad_input, "",
                text("OpenGL cannot draw a picture of this size (status ", status, "); pass --splat cpu"));
  }
  return framebuffer;
}

GlProgram::GlProgram(const Gl& gl, const char* label, const char* vertex, const char* fragment)
    : gl_(&gl), program_(gl, gl.CreateProgram(), [](const Gl& g, GLuint id) { g.DeleteProgram(id); }) {
  const GlObject v = compile(gl, label, GL_VERTEX_SHADER, vertex);
  const GlObject f = compile(gl, label, GL_FRAGMENT_SHADER, fragment);
  gl.AttachShader(program_.id(), v.id());
  gl.AttachShader(program_.id(), f.id());
  gl.LinkProgram(program_.id());
  GLint good = GL_FALSE;
  gl.GetProgramiv(program_.id(), GL_LINK_STATUS, &good);
  char log[1024] = "";
  if (good == GL_FALSE) gl.GetProgramInfoLog(program_.id(), sizeof log, nullptr, log);
  PHOS_CHECK(good != GL_FALSE, label, ": ", log);
}

void GlProgram::use() const { gl_->UseProgram(program_.id()); }
// A uniform that a program does not use has no place, and setting it does nothing.
GLint GlProgram::at(const char* name) const { return gl_->GetUniformLocation(program_.id(), name); }
void GlProgram::set(const char* name, float v) const { gl_->ProgramUniform1f(program_.id(), at(name), v); }
void GlProgram::set(const char* name, int v) const { gl_->ProgramUniform1i(program_.id(), at(name), v); }
void GlProgram::set(const char* name, std::uint32_t v) const {
  gl_->ProgramUniform1ui(program_.id(), at(name), v);
}
void GlProgram::set(const char* name, const Vec2& v) const {
  gl_->ProgramUniform2f(program_.id(), at(name), v.x, v.y);
}
void GlProgram::set(const char* name, const Vec3& v) const {
  gl_->ProgramUniform3f(program_.id(), at(name), v.x, v.y, v.z);
}
void GlProgram::set(const char* name, const Vec4& v) const {
  gl_->ProgramUniform4f(program_.id(), at(name), v.x, v.y, v.z, v.w);
}
void GlProgram::set(const char* name, std::span<const Mat3> v) const {
  gl_->ProgramUniformMatrix3fv(program_.id(), at(name), static_cast<GLsizei>(v.size()), GL_FALSE,
                               &v[0][0][0]);
}

}  // namespace phos::inline splat
