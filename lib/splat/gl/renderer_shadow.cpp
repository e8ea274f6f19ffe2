// Direct light by shadow maps (Williams 1978): from each sample of a light the scene's depth is drawn, and a
// pixel is lit if nothing is nearer than its own surface. The depth of a texel is compared with the plane of
// the pixel's triangle at that texel (receiver-plane bias), so that only half a texel remains to be added
// against the facets beside it.
#include <algorithm>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "scene/lamp/luminaires.h"
#include "scene/shading_frame.h"
#include "splat/direct/lamp_places.h"
#include "splat/gl/renderer.h"
#include "splat/gl/renderer_impl.h"
#include "splat/gl/shaders.h"
#include "splat/sight_range.h"

namespace phos::inline splat {
namespace {

/// A place that light comes from, with the views that its shadow map is made of.
struct ShadowSample : LampPlace {
  const ShareMap* map = nullptr;
  std::vector<GlView> faces;
  float bias = 0;
};

Mat3 looking(const DVec3& forward, const DVec3& up, double scale) {
  return Mat3(glm::transpose(glm::dmat3(glm::cross(forward, up), up, -forward)) * scale);
}

/// Axis of the greatest extent first: forward, four sides, backward.
std::vector<Mat3> cube_axes(const Vec3& forward, double scale) {
  const Frame frame = make_frame(forward);
  const DVec3 x(frame.x), y(frame.y), z(frame.z);
  return {looking(z, x, scale), looking(x, z, scale),  looking(-x, z, scale),
          looking(y, z, scale), looking(-y, z, scale), looking(-z, x, scale)};
}

/// Perspective views from a point: `faces` of the cube about `forward`, or one of the given half opening.
void add_views(const Scene& scene, ShadowSample& sample, const Vec3& eye, std::size_t faces,
               double half_opening, std::int64_t but_instance, int map_size) {
  const double scale = 1 / farthest_m(scene, eye);
  GlView view;
  view.eye = eye;
  view.lens = Vec4(Vec2(static_cast<float>(1 / half_opening)), 0, 0);
  view.depth.x = static_cast<float>(0.999 * scale * nearest_m(scene, eye, but_instance) /
                                    std::sqrt(1 + 2 * half_opening * half_opening));
  const std::vector<Mat3> axes = cube_axes(sample.forward, scale);
  for (std::size_t f = 0; f < faces; ++f) view.axes = axes[f], sample.faces.push_back(view);
  sample.bias = static_cast<float>(half_opening / map_size);
  sample.colour = Rgb(glm::dvec3(sample.colour) * (scale * scale));
}

/// Parallel views: only as wide as the visible surfaces.
void add_parallel_view(const Scene& scene, const GBuffer& g, ShadowSample& sample, int map_size) {
  const Vec3 eye = scene.bounds.centre();
  const double scale = 1 / std::max(static_cast<double>(bounding_radius_m(scene)), 1e-30);
  GlView view;
  view.eye = eye;
  view.perspective = false;
  view.axes = looking(DVec3(sample.forward), DVec3(make_frame(sample.forward).x), scale);
  Bounds seen;
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    if (g.covered(i)) seen.include(view.axes * (Vec3(g.position[i]) - eye));
  }
  if (seen.empty()) return;
  const Vec3 size = glm::max(seen.size(), Vec3(1e-6f)) * (1 + 4 / static_cast<float>(map_size));
  const Vec3 centre = seen.centre();
  view.lens = Vec4(2 / size.x, 2 / size.y, -2 * centre.x / size.x, -2 * centre.y / size.y);
  // The bounding sphere lies within a distance of 1 of its centre.
  view.depth = Vec2(0.5f, -0.499f);
  sample.bias = 0.25f * std::max(size.x, size.y) / static_cast<float>(map_size) + 1e-6f;
  sample.faces.push_back(view);
}

/// Adds the views of a shadow map. Cones up to 50 degrees off the axis have one map, a little wider than they
/// are.
ShadowSample with_views(const Scene& scene, const GBuffer& gbuffer, const LampPlace& lamp,
                        const ShareMap& map, int map_size) {
  ShadowSample sample{lamp, &map, {}, 0};
  if (lamp.shape == PlaceShape::directional) {
    add_parallel_view(scene, gbuffer, sample, map_size);
    return sample;
  }
  std::size_t faces = 6;
  double half_opening = 1;
  if (lamp.shape == PlaceShape::area && !lamp.two_sided) faces = 5;
  if (lamp.shape == PlaceShape::spot && lamp.cos_outer > 0.64) {
    const double cosine = std::min(lamp.cos_outer, 1 - 1e-6);
    faces = 1, half_opening = 1.02 * std::sqrt(1 - cosine * cosine) / cosine;
  }
  add_views(scene, sample, lamp.position, faces, half_opening, lamp.instance, map_size);
  return sample;
}

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
  int map_size;
  GlObject maps, framebuffer, share;

  /// Binds the map that the samples from here on have.
  void take(const ShareMap& map) {
    const Gl& gl = impl.context.gl();
    if (!share) share = make_texture(gl, GL_R32F, ShareMap::kWidth, ShareMap::kHeight);
    gl.TextureSubImage2D(share.id(), 0, 0, 0, ShareMap::kWidth, ShareMap::kHeight, GL_RED, GL_FLOAT,
                         map.share.data());
    gl.BindTextureUnit(4, share.id());
  }

  void draw_maps(const ShadowSample& sample) const {
    const Gl& gl = impl.context.gl();
    const float far = 0;
    gl.Viewport(0, 0, map_size, map_size);
    for (std::size_t f = 0; f < sample.faces.size(); ++f) {
      gl.NamedFramebufferTextureLayer(framebuffer.id(), GL_DEPTH_ATTACHMENT, maps.id(), 0,
                                      static_cast<GLint>(f));
      gl.ClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &far);
      gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
      impl.mesh.draw(sample.faces[f]);
    }
  }

  void add(const ShadowSample& sample) const {
    if (sample.faces.empty()) return;
    draw_maps(sample);
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
    program.set("kind", static_cast<int>(sample.shape));
    program.set("two_sided", sample.two_sided ? 1 : 0);
    program.set("colour", sample.colour);
    program.set("forward", sample.forward);
    program.set("cone", Vec2(sample.cos_outer, sample.cos_inner));
    if (!sample.map->share.empty()) program.set("luminaire_axes", std::span(&sample.map->axes, 1));
    program.use();
    impl.bind_for_sum(target);
    gl.BindTextureUnit(3, maps.id());
    gl.BindVertexArray(impl.empty_array.id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }
};

std::vector<Rgb> GlRenderer::direct_illuminance(const GBuffer& gbuffer, int light_samples, int map_size) {
  PHOS_CHECK(light_samples > 0 && map_size > 0, light_samples, " samples, maps of ", map_size);
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
  ShadowPass pass{*impl_, target, size, make_texture_array(gl, GL_DEPTH_COMPONENT32F, size, size, 6), {}, {}};
  gl.TextureParameteri(pass.maps.id(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
  GLuint framebuffer = 0;
  gl.CreateFramebuffers(1, &framebuffer);
  pass.framebuffer = GlObject(gl, framebuffer, [](const Gl& g, GLuint id) { g.DeleteFramebuffers(1, &id); });
  gl.NamedFramebufferDrawBuffers(framebuffer, 0, nullptr);

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
        pass.add(with_views(scene, gbuffer, *sample, map, size));
      progress.advance();
    }
  }
  std::vector<Vec4> sum(illuminance.size());
  impl_->read(target.light, sum);
  impl_->context.check("drawing shadow maps");
  for (std::size_t i = 0; i < sum.size(); ++i) illuminance[i] = Rgb(sum[i]);
  return illuminance;
}

}  // namespace phos::inline splat
