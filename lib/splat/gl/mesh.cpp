#include "splat/gl/mesh.h"

#include <algorithm>

#include "core/error.h"
#include "splat/gl/shaders.h"

namespace phos::inline splat {
namespace {

GLint gl_wrap(Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::clamp) return GL_CLAMP_TO_EDGE;
  return wrap == Texture::Wrap::mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

}  // namespace

GlMesh::GlMesh(const Gl& gl, const Scene& scene)
    : gl_(gl),
      scene_(scene),
      vertices_(make_buffer(gl)),
      indices_(make_buffer(gl)),
      array_(make_vertex_array(gl)),
      opaque_(gl, "scene", shaders::scene_vertex, shaders::scene_fragment),
      alpha_(scene.texture.size()) {
  make_ranges();
  make_vertices();
  make_masks();
}

void GlMesh::make_ranges() {
  for (const Instance& instance : scene_.instance) {
    if (instance.triangle_count == 0) continue;
    const bool opaque = scene_.material[instance.material].alpha_mode == Material::Alpha::opaque;
    const std::int32_t material = opaque ? -1 : static_cast<std::int32_t>(instance.material);
    if (!ranges_.empty() && ranges_.back().material == material &&
        ranges_.back().first + ranges_.back().count == instance.first_triangle) {
      ranges_.back().count += instance.triangle_count;
    } else {
      ranges_.push_back({instance.first_triangle, instance.triangle_count, material});
    }
  }
}

void GlMesh::make_vertices() {
  const auto bytes = [](const auto& v) { return static_cast<GLsizeiptr>(v.size() * sizeof(v[0])); };
  gl_.NamedBufferData(vertices_.id(), bytes(scene_.position), scene_.position.data(), GL_STATIC_DRAW);
  gl_.NamedBufferData(indices_.id(), bytes(scene_.triangle), scene_.triangle.data(), GL_STATIC_DRAW);
  const GLuint array = array_.id();
  gl_.VertexArrayElementBuffer(array, indices_.id());
  gl_.VertexArrayVertexBuffer(array, 0, vertices_.id(), 0, sizeof(Vec3));
  gl_.EnableVertexArrayAttrib(array, 0);
  gl_.VertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl_.VertexArrayAttribBinding(array, 0, 0);
}

/// What only materials with holes need: texture coordinates, vertex alpha, and the alpha of their textures.
void GlMesh::make_masks() {
  if (std::none_of(ranges_.begin(), ranges_.end(), [](const Range& r) { return r.material >= 0; })) return;
  masked_ = GlProgram(gl_, "mask", shaders::scene_vertex, shaders::masked_fragment);
  struct MaskVertex {
    Vec2 uv0{0}, uv1{0};
    float alpha = 1;
  };
  std::vector<MaskVertex> vertex(scene_.position.size());
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    if (!scene_.uv0.empty()) vertex[i].uv0 = scene_.uv0[i];
    if (!scene_.uv1.empty()) vertex[i].uv1 = scene_.uv1[i];
    if (!scene_.colour.empty()) vertex[i].alpha = scene_.colour[i].w;
  }
  mask_vertices_ = make_buffer(gl_);
  gl_.NamedBufferData(mask_vertices_.id(), static_cast<GLsizeiptr>(vertex.size() * sizeof(MaskVertex)),
                      vertex.data(), GL_STATIC_DRAW);
  gl_.VertexArrayVertexBuffer(array_.id(), 1, mask_vertices_.id(), 0, sizeof(MaskVertex));
  for (const GLuint attribute : {1u, 2u}) {
    gl_.EnableVertexArrayAttrib(array_.id(), attribute);
    gl_.VertexArrayAttribFormat(array_.id(), attribute, attribute == 1 ? 4 : 1, GL_FLOAT, GL_FALSE,
                                attribute == 1 ? 0 : offsetof(MaskVertex, alpha));
    gl_.VertexArrayAttribBinding(array_.id(), attribute, 1);
  }
  for (const Range& range : ranges_) {
    if (range.material < 0) continue;
    const TextureUse& use = scene_.material[static_cast<std::size_t>(range.material)].base_colour;
    if (!use.used()) continue;
    const Texture& texture = scene_.texture[static_cast<std::size_t>(use.texture)];
    GlObject& alpha = alpha_[static_cast<std::size_t>(use.texture)];
    if (alpha || texture.size() == 0) continue;
    std::vector<float> there(texture.size());
    for (std::size_t t = 0; t < there.size(); ++t) there[t] = texture.texel(t).w;
    alpha = make_texture(gl_, GL_R32F, texture.width, texture.height);
    const GLint filter = texture.nearest ? GL_NEAREST : GL_LINEAR;
    gl_.TextureParameteri(alpha.id(), GL_TEXTURE_MIN_FILTER, filter);
    gl_.TextureParameteri(alpha.id(), GL_TEXTURE_MAG_FILTER, filter);
    gl_.TextureParameteri(alpha.id(), GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
    gl_.TextureParameteri(alpha.id(), GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
    gl_.TextureSubImage2D(alpha.id(), 0, 0, 0, texture.width, texture.height, GL_RED, GL_FLOAT, there.data());
  }
}

void GlMesh::set_mask(const Material& material) const {
  const TextureUse& use = material.base_colour;
  const bool textured = use.used() && alpha_[static_cast<std::size_t>(use.texture)];
  const float c = std::cos(use.rotation_rad), s = std::sin(use.rotation_rad);
  masked_.set("mask", Vec2(material.alpha,
                           material.alpha_mode == Material::Alpha::mask ? material.alpha_cutoff : 0.5f));
  masked_.set("uv_matrix", Vec4(c * use.scale.x, -s * use.scale.x, s * use.scale.y, c * use.scale.y));
  masked_.set("uv_offset", use.offset);
  masked_.set("uv_set", static_cast<int>(use.set));
  masked_.set("textured", textured ? 1 : 0);
  gl_.BindTextureUnit(0, textured ? alpha_[static_cast<std::size_t>(use.texture)].id() : 0);
}

void GlMesh::draw(const GlView& view) const {
  gl_.BindVertexArray(array_.id());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
  gl_.Disable(GL_BLEND);
  for (const GlProgram* program : {&opaque_, &masked_}) {
    if (!*program) continue;
    program->set("eye", view.eye);
    program->set("axes", std::span(&view.axes, 1));
    program->set("lens", view.lens);
    program->set("depth", view.depth);
    program->set("perspective", view.perspective ? 1 : 0);
  }
  for (const Range& range : ranges_) {
    const GlProgram& program = range.material < 0 ? opaque_ : masked_;
    program.use();
    if (range.material >= 0) set_mask(scene_.material[static_cast<std::size_t>(range.material)]);
    program.set("first_triangle", range.first);
    gl_.DrawElements(
        GL_TRIANGLES, static_cast<GLsizei>(3 * range.count), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(static_cast<std::uintptr_t>(range.first) * sizeof(Triangle)));
  }
}

}  // namespace phos::inline splat
