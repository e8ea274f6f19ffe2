#include "splat/gl/probe.h"

#include <cmath>
#include <vector>

#include "core/error.h"
#include "splat/gl/objects.h"
#include "splat/gl/shaders.h"

namespace phos::inline splat {
namespace {

constexpr int kSide = 32;  // pixels: several tiles of the driver

constexpr const char* kFragment = R"(#version 450 core
layout(location = 0) out vec4 colour;
void main() { colour = vec4(gl_FragCoord.xy, 0.25, 1e6); }
)";

}  // namespace

std::string try_gl(GlBy by) {
  const GlContext context(by);
  const Gl& gl = context.gl();
  const GlObject picture = make_texture(gl, GL_RGBA32F, kSide, kSide);
  const GlObject framebuffer = make_framebuffer(gl, {picture.id()}, 0);
  const GlObject corners = make_vertex_array(gl);
  const GlProgram program(gl, "probe", shaders::picture_vertex, kFragment);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  gl.Viewport(0, 0, kSide, kSide);
  gl.BindVertexArray(corners.id());
  program.use();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<Vec4> pixels(kSide * kSide);
  gl.GetTextureImage(picture.id(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof(Vec4)),
                     pixels.data());
  context.check("drawing a triangle");
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (pixels[static_cast<std::size_t>(y * kSide + x)] !=
          Vec4(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0.25f, 1e6f))
        no_context(by, text("it draws a wrong picture (", context.description(), ")"));
  return context.description();
}

}  // namespace phos::inline splat
