// Direct light by shadow maps (Williams 1978): from each sample of a light the scene's depth is drawn, and a
// pixel is lit if nothing is nearer than its own surface. The depth of a texel is compared with the plane of
// the pixel's triangle at that texel (receiver-plane bias), so that only half a texel remains to be added
// against the facets beside it.
#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "scene/lamp/luminaires.h"
#include "scene/shading_frame.h"
#include "splat/direct/lamp_places.h"
#include "splat/gl/lamp_map.h"
#include "splat/gl/renderer.h"
#include "splat/gl/renderer_impl.h"
#include "splat/gl/shaders.h"

namespace phos::inline splat {
namespace {

/// Geometric normal of the surface in each pixel, on the side that is seen.
std::vector<Vec4> facets(const Scene& scene, const GBuffer& g) {
  std::vector<Vec4> facet(g.position.size(), Vec4(0));
  parallel_for(facet.size(), 1 << 14, [&](std::size_t i) {
    if (!g.covered(i)) return;
    PHOS_CHECK(g.hit[i].triangle < scene.triangle.size(), "G-buffer of another scene");
    const auto& v = scene.triangle[g.hit[i].triangle].v;
    const Vec3 n = normal_of(scene.position[v[0]], scene.position[v[1]], scene.position[v[2]]);
    facet[i] = Vec4(glm::dot(n, Vec3(g.normal[i])) < 0 ? -n : n, 0);
  });
  return facet;
}

}  // namespace

/// Depth maps of one sample, and the sum over the picture.
struct GlRenderer::ShadowPass {
  Impl& impl;
  const GlPictureTarget& target;
  ShadowTarget maps;
  int taps;
  GlObject share;

  /// Binds the map that the samples from here on have.
  void take(const ShareMap& map) {
    const Gl& gl = impl.context.gl();
    if (!share) share = make_texture(gl, GL_R32F, ShareMap::kWidth, ShareMap::kHeight);
    gl.TextureSubImage2D(share.id(), 0, 0, 0, ShareMap::kWidth, ShareMap::kHeight, GL_RED, GL_FLOAT,
                         map.share.data());
    gl.BindTextureUnit(4, share.id());
  }

  void add(const ShadowSample& sample) const {
    if (sample.faces.empty()) return;
    maps.draw(impl.mesh, sample);
    const Gl& gl = impl.context.gl();
    const GlProgram& program = impl.shadow_program;
    std::vector<Mat3> axes;
    for (const GlView& face : sample.faces) axes.push_back(face.axes);
    const GlView& view = sample.faces.front();
    program.set("face_count", static_cast<int>(axes.size()));
    program.set("axes", axes);
    program.set("eye", view.eye);
    program.set("lens", view.lens);
    program.set("depth", view.depth);
    program.set("perspective", view.perspective ? 1 : 0);
    program.set("bias", sample.bias);
    program.set("taps", taps);
    program.set("kind", static_cast<int>(sample.shape));
    program.set("two_sided", sample.two_sided ? 1 : 0);
    program.set("colour", sample.colour);
    program.set("forward", sample.forward);
    program.set("cone", Vec2(sample.cos_outer, sample.cos_inner));
    if (!sample.map->share.empty()) program.set("luminaire_axes", std::span(&sample.map->axes, 1));
    program.use();
    impl.bind_for_sum(target);
    gl.BindTextureUnit(3, maps.maps().id());
    gl.BindVertexArray(impl.empty_array.id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }
};

std::vector<Rgb> GlRenderer::direct_illuminance(const GBuffer& gbuffer, int light_samples, int map_size,
                                                int taps) {
  PHOS_CHECK(light_samples > 0 && map_size > 0 && taps > 0, light_samples, " samples, maps of ", map_size);
  const Scene& scene = impl_->scene;
  std::vector<Rgb> illuminance(gbuffer.position.size(), Rgb(0));
  if (illuminance.empty() || scene.light.empty()) return illuminance;

  impl_->context.make_current();
  const Gl& gl = impl_->context.gl();
  if (!impl_->shadow_program) {
    impl_->shadow_program = GlProgram(gl, "shadow", shaders::picture_vertex, shaders::shadow_fragment);
    impl_->empty_array = make_vertex_array(gl);
  }
  const int size = std::min(map_size, impl_->context.largest_texture());
  const GlPictureTarget& target = impl_->picture_target(gbuffer);
  gl.TextureSubImage2D(target.facet.id(), 0, 0, 0, gbuffer.width, gbuffer.height, GL_RGBA, GL_FLOAT,
                       facets(scene, gbuffer).data());
  ShadowPass pass{*impl_, target, {impl_->context, size}, taps, {}};

  const Luminaires luminaires(scene);
  std::size_t total = 0;
  for (const Light& light : scene.light) total += static_cast<std::size_t>(place_count(light, light_samples));
  Progress progress("shadow maps", total, "maps");
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const Light& light = scene.light[i];
    ShareMap map;
    if (light.fitting >= 0) {
      map = share_map(scene, light);
      pass.take(map);
    }
    const int count = place_count(light, light_samples);
    for (int k = 0; k < count; ++k) {
      throw_if_interrupted();
      if (const auto sample = lamp_place(scene, luminaires, i, k, count, map))
        pass.add(shadow_sample(scene, gbuffer.position, *sample, map, size));
      progress.advance();
    }
  }
  std::vector<Vec4> sum(illuminance.size());
  impl_->read(target.light, sum);
  impl_->context.check("drawing shadow maps");
  for (std::size_t i = 0; i < sum.size(); ++i) illuminance[i] = Rgb(sum[i]);
  return illuminance;
}

void GlRenderer::each_lamp_map(const GBuffer& gbuffer, int light_samples, int map_size,
                               const std::function<void(const LampMap& map, bool extended)>& use) {
  const Scene& scene = impl_->scene;
  impl_->context.make_current();
  const Luminaires luminaires(scene);
  const int size = std::min(map_size, impl_->context.largest_texture());
  std::optional<ShadowTarget> target;
  std::size_t faces = 0;
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const Light& light = scene.light[i];
    ShareMap shares;
    if (light.fitting >= 0) shares = share_map(scene, light);
    const int count = place_count(light, light_samples);
    for (int k = 0; k < count; ++k) {
      throw_if_interrupted();
      const auto place = lamp_place(scene, luminaires, i, k, count, shares);
      if (!place) continue;
      LampMap map;
      map.sample = shadow_sample(scene, gbuffer.position, *place, shares, size);
      if (map.sample.faces.empty()) continue;
      if (!target || faces != map.sample.faces.size()) {
        faces = map.sample.faces.size();
        target.emplace(impl_->context, size, static_cast<int>(faces));
      }
      target->draw(impl_->mesh, map.sample);
      map.size = target->size(), map.depth = target->read();
      use(map, light.extended());
    }
  }
  impl_->context.check("drawing shadow maps");
}

}  // namespace phos::inline splat
