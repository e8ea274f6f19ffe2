#include "splat/gl/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "scene/shading_frame.h"
#include "splat/sight_range.h"

namespace phos::inline splat {
namespace {

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
void add_parallel_view(const Scene& scene, std::span<const Vec4> places, ShadowSample& sample, int map_size) {
  const Vec3 eye = scene.bounds.centre();
  const double scale = 1 / std::max(static_cast<double>(bounding_radius_m(scene)), 1e-30);
  GlView view;
  view.eye = eye;
  view.perspective = false;
  view.axes = looking(DVec3(sample.forward), DVec3(make_frame(sample.forward).x), scale);
  Bounds seen;
  for (const Vec4& p : places) {
    if (p.w > 0) seen.include(view.axes * (Vec3(p) - eye));
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

}  // namespace

/// Cones up to 50 degrees off the axis have one map, a little wider than they are.
ShadowSample shadow_sample(const Scene& scene, std::span<const Vec4> places, const LampPlace& lamp,
                           const ShareMap& map, int map_size) {
  ShadowSample sample{lamp, &map, {}, 0};
  if (lamp.shape == PlaceShape::directional) {
    add_parallel_view(scene, places, sample, map_size);
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

ShadowTarget::ShadowTarget(const GlContext& context, int size, int faces)
    : gl_(context.gl()),
      size_(std::min(size, context.largest_texture())),
      faces_(faces),
      maps_(make_texture_array(gl_, GL_DEPTH_COMPONENT32F, size_, size_, faces_)) {
  gl_.TextureParameteri(maps_.id(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
  GLuint framebuffer = 0;
  gl_.CreateFramebuffers(1, &framebuffer);
  framebuffer_ = GlObject(gl_, framebuffer, [](const Gl& g, GLuint id) { g.DeleteFramebuffers(1, &id); });
  gl_.NamedFramebufferDrawBuffers(framebuffer, 0, nullptr);
}

void ShadowTarget::draw(const GlMesh& mesh, const ShadowSample& sample) const {
  const float far = 0;
  gl_.DepthMask(GL_TRUE);
  gl_.Viewport(0, 0, size_, size_);
  for (std::size_t f = 0; f < sample.faces.size(); ++f) {
    gl_.NamedFramebufferTextureLayer(framebuffer_.id(), GL_DEPTH_ATTACHMENT, maps_.id(), 0,
                                     static_cast<GLint>(f));
    gl_.ClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &far);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
    mesh.draw(sample.faces[f]);
  }
}

std::vector<float> ShadowTarget::read() const {
  const auto side = static_cast<std::size_t>(size_);
  std::vector<float> depth(static_cast<std::size_t>(faces_) * side * side);
  gl_.GetTextureImage(maps_.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                      static_cast<GLsizei>(depth.size() * sizeof(float)), depth.data());
  return depth;
}

}  // namespace phos::inline splat
