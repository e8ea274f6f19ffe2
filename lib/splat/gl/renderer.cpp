#include "splat/gl/renderer.h"

#include "core/error.h"
#include "splat/gl/renderer_impl.h"

namespace phos::inline splat {

GlRenderer::GlRenderer(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {
  impl_->context.check("loading the scene");
}
GlRenderer::~GlRenderer() = default;

const char* GlRenderer::description() const { return impl_->context.description().c_str(); }

void require_size(const GlContext& context, int width, int height) {
  const int largest = context.largest_texture();
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  if (width > largest || height > largest) {
    throw Error(ExitCode::usage, "",
                text("a picture of ", width, " x ", height, " is more than OpenGL can draw (", largest,
                     " a side); pass --splat cpu"));
  }
}

GlRasterTarget& GlRenderer::Impl::raster_target(int width, int height) {
  if (raster.width != width || raster.height != height)
    raster = GlRasterTarget(), raster = make_raster_target(context, width, height);
  return raster;
}

GlPictureTarget& GlRenderer::Impl::picture_target(const GBuffer& g) {
  require_size(context, g.width, g.height);
  const Gl& gl = context.gl();
  if (picture.width != g.width || picture.height != g.height) {
    picture = {};
    for (GlObject* texture : {&picture.position, &picture.normal, &picture.facet, &picture.light,
                              &picture.error, &picture.spread}) {
      *texture = make_texture(gl, GL_RGBA32F, g.width, g.height);
    }
    picture.framebuffer = make_framebuffer(gl, {picture.light.id(), picture.error.id()}, 0);
    picture.with_spread =
        make_framebuffer(gl, {picture.light.id(), picture.error.id(), picture.spread.id()}, 0);
    picture.width = g.width, picture.height = g.height;
  }
  gl.TextureSubImage2D(picture.position.id(), 0, 0, 0, g.width, g.height, GL_RGBA, GL_FLOAT,
                       g.position.data());
  gl.TextureSubImage2D(picture.normal.id(), 0, 0, 0, g.width, g.height, GL_RGBA, GL_FLOAT, g.normal.data());
  const float black[4] = {0, 0, 0, 0};
  for (const GLint target : {0, 1, 2})
    gl.ClearNamedFramebufferfv(picture.with_spread.id(), GL_COLOR, target, black);
  return picture;
}

void GlRenderer::Impl::bind_for_sum(const GlPictureTarget& target, bool spread) const {
  const Gl& gl = context.gl();
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, spread ? target.with_spread.id() : target.framebuffer.id());
  gl.Viewport(0, 0, target.width, target.height);
  gl.Disable(GL_DEPTH_TEST);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ONE);
  gl.BindTextureUnit(0, target.position.id());
  gl.BindTextureUnit(1, target.normal.id());
  gl.BindTextureUnit(2, target.facet.id());
}

void GlRenderer::Impl::read(const GlObject& texture, std::vector<Vec4>& pixels) const {
  context.gl().GetTextureImage(texture.id(), 0, GL_RGBA, GL_FLOAT,
                               static_cast<GLsizei>(pixels.size() * sizeof(Vec4)), pixels.data());
}

}  // namespace phos::inline splat
