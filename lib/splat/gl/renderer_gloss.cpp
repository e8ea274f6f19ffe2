// Radiance records by OpenGL: one record at a time, a few rectangles each, added to the picture.
#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/interrupt.h"
#include "hsh/basis.h"
#include "radiance/tree.h"
#include "splat/gl/gloss_rows.h"
#include "splat/gl/renderer.h"
#include "splat/gl/renderer_impl.h"
#include "splat/gl/shaders.h"
#include "splat/tiles.h"

namespace phos::inline splat {
namespace {

/// The uniform block of gloss_fragment. `footprint`: its own, or null.
void pack(const RadianceRecord& r, const AdaptiveFootprint* footprint, std::vector<Vec4>& block) {
  block = {Vec4(r.position, std::min(1 / r.radius_m, std::numeric_limits<float>::max())),
           Vec4(r.frame.z, -kFrontTolerance * r.radius_m), Vec4(r.frame.x, steepness_per_m(r)),
           Vec4(r.frame.y, r.weight)};
  if (footprint) {
    const auto& f = footprint->inverse_m();
    const float inverse_shortest = std::min(1 / footprint->shortest_m(), std::numeric_limits<float>::max());
    block.insert(block.end(), {Vec4(f[0], f[2], f[4], f[6]), Vec4(f[1], f[3], f[5], f[7]),
                               Vec4(inverse_shortest, footprint->longest_m() / r.radius_m, 0, 0)});
  }
  const std::size_t first_number = block.size();
  const auto rgb = [](const std::vector<float>& v, std::size_t i) {
    return v.empty() ? Vec4(0) : Vec4(v[i], v[i + 1], v[i + 2], 0);
  };
  for (std::size_t i = 0; i < r.light.size(); i += 3)
    block.insert(block.end(), {rgb(r.light, i), rgb(r.gradient_x, i), rgb(r.gradient_y, i)});
  block[first_number].w = over_limit_m(r.distance_m, r.radius_m);
}

GLsizeiptr bytes(const std::vector<Vec4>& v) { return static_cast<GLsizeiptr>(v.size() * sizeof(Vec4)); }

}  // namespace

GlProgram& GlRenderer::Impl::gloss_program(int order, bool shaped) {
  const Gl& gl = context.gl();
  if (!gloss_array) {
    gloss_array = make_vertex_array(gl), gloss_rects = make_buffer(gl), gloss_record = make_buffer(gl);
    const GLuint array = gloss_array.id();
    gl.VertexArrayVertexBuffer(array, 0, gloss_rects.id(), 0, sizeof(Vec4));
    gl.VertexArrayBindingDivisor(array, 0, 1);
    gl.EnableVertexArrayAttrib(array, 0);
    gl.VertexArrayAttribFormat(array, 0, 4, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(array, 0, 0);
  }
  GlProgram& program = gloss_programs[{order, shaped}];
  if (!program) {
    const std::string fragment =
        text("#version 450 core\n", shaders::record_weight, "#define COUNT ", harmonic_count(order), "\n",
             shaped ? "#define FOOTPRINT\n" : "", shaders::gloss_fragment);
    program = GlProgram(gl, "gloss", shaders::one_record_vertex, fragment.c_str());
  }
  return program;
}

GlossBuffer GlRenderer::splat_gloss(const GlossCache& cache, double accuracy, const RayScene& rays,
                                    const GBuffer& g, const Camera& camera, const Vec2& subpixel) {
  impl_->context.make_current();
  const Gl& gl = impl_->context.gl();
  const GlossRows rows(cache.tables(), rays.scene().material.size(), impl_->context.largest_texture());
  GlossLeft left;
  GlossBuffer buffer = splat_gloss_beside(cache, accuracy, rays, g, camera, subpixel, rows, left);
  const std::vector<Vec4>& places = left.place;
  if (std::all_of(places.begin(), places.end(), [](const Vec4& p) { return p.x < 0; })) return buffer;

  const GlPictureTarget& target = impl_->picture_target(g);
  const GlObject lobes = make_texture(gl, GL_RGBA32F, g.width, g.height),
                 table = make_texture(gl, GL_RGBA32F, rows.width(), rows.height());
  gl.TextureSubImage2D(lobes.id(), 0, 0, 0, g.width, g.height, GL_RGBA, GL_FLOAT, places.data());
  gl.TextureSubImage2D(table.id(), 0, 0, 0, rows.width(), rows.height(), GL_RGBA, GL_FLOAT,
                       rows.texels().data());
  impl_->bind_for_sum(target, true);
  gl.BindTextureUnit(2, lobes.id());
  gl.BindTextureUnit(3, table.id());

  const auto a = static_cast<float>(accuracy);
  const TileGrid grid(g, kSplatTile);
  std::vector<PixelRect> rects;
  std::vector<Vec4> instances, block;
  for (const int order : cache.tables().orders()) {
    const RadianceTree& tree = *cache.tree(order);
    const auto [first, end] = rows.of_order(order);
    if (first == end) continue;
    const std::span<const IrradianceRecord> records = tree.irradiance().records();
    std::optional<bool> drawn_shaped;  // what the program in use draws
    const auto use_program = [&](bool shaped) {
      if (drawn_shaped == shaped) return;
      GlProgram& program = impl_->gloss_program(order, shaped);
      program.set("rule", Vec4(1 / a, kLeastWeight, static_cast<float>(first), static_cast<float>(end)));
      program.set("unit", Vec4(1 / buffer.unit, 0, 0, 0));
      program.use();
      gl.BindVertexArray(impl_->gloss_array.id());
      drawn_shaped = shaped;
    };
    const std::vector<PixelRect> bounds = record_bounds(records, accuracy, camera, g.width, g.height);
    for (std::size_t i = 0; i < records.size(); ++i) {
      if (bounds[i].empty()) continue;
      grid.cut(records[i], a, bounds[i], rects);
      if (rects.empty()) continue;
      instances.clear();
      for (const PixelRect& rect : rects) instances.push_back(in_viewport(rect, g.width, g.height));
      const AdaptiveFootprint* footprint = records[i].footprint.get();
      use_program(footprint != nullptr);
      pack(tree[i], footprint, block);
      gl.NamedBufferData(impl_->gloss_rects.id(), bytes(instances), instances.data(), GL_STREAM_DRAW);
      gl.NamedBufferData(impl_->gloss_record.id(), bytes(block), block.data(), GL_STREAM_DRAW);
      gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, impl_->gloss_record.id());
      gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances.size()));
      throw_if_interrupted();
    }
  }
  std::vector<Vec4> light(places.size()), spread(places.size());
  impl_->read(target.light, light);
  impl_->read(target.spread, spread);
  impl_->context.check("splatting gloss");
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(places[i].x >= 0)) continue;
    buffer.light[i] = glm::max(light[i], Vec4(0));
    left.spread[i].value2 = static_cast<double>(spread[i].z);
    if (!(light[i].w > 0)) continue;
    const Rgb error = gloss_error(left.spread[i], light[i].w, Rgb(buffer.light[i]), Rgb(light[i]),
                                  Rgb(buffer.error[i]), buffer.unit);
    buffer.error[i] = Vec4(error, buffer.error[i].w);
  }
  return buffer;
}

}  // namespace phos::inline splat
