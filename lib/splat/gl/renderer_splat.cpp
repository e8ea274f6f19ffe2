// Splatting by OpenGL: each record is an instanced rectangle, or a few that cover the tiles where it can
// weigh something, added to the picture by 32-bit float blending. Records that serve a disc and records with
// footprints have a program each: the latter have too many numbers for the attributes of an instance.
#include <algorithm>
#include <cstddef>
#include <string>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "splat/cpu/splatter.h"
#include "splat/cpu/splatter_kernel.h"
#include "splat/gl/renderer.h"
#include "splat/gl/renderer_impl.h"
#include "splat/gl/shaders.h"
#include "splat/tiles.h"

namespace phos::inline splat {
namespace {

constexpr std::size_t kBatch = 2048;  // records per draw
constexpr std::size_t kWave = 16;     // draws that are made ready at a time: bounds the memory

struct SplatInstance {
  Vec4 rect;
  PackedRecord record;
};

/// A rectangle of a record with a footprint, and the record's place among the Shapes of its batch.
struct FootprintInstance {
  Vec4 rect;
  float shape;
};

/// A record with a footprint, as footprint_fragment reads it.
struct Shape {
  PackedRecord record;
  PackedFootprint footprint;
};
static_assert(sizeof(PackedRecord) == 38 * sizeof(float) && sizeof(PackedFootprint) == 112 * sizeof(float),
              "the structure of footprint_fragment has these numbers, one after the other");

/// The records of one draw, each kind in its order.
struct SplatBatch {
  std::vector<SplatInstance> discs;
  std::vector<FootprintInstance> footprints;
  std::vector<Shape> shapes;
};

struct Attribute {
  GLuint location;
  GLint size;
  std::size_t offset;
};
constexpr std::size_t kRecord = offsetof(SplatInstance, record);
constexpr Attribute kFootprintAttributes[] = {{0, 4, offsetof(FootprintInstance, rect)},
                                              {1, 1, offsetof(FootprintInstance, shape)}};
constexpr Attribute kAttributes[] = {
    {0, 4, offsetof(SplatInstance, rect)},
    {1, 4, kRecord + offsetof(PackedRecord, position)},
    {2, 4, kRecord + offsetof(PackedRecord, normal)},
    {3, 4, kRecord + offsetof(PackedRecord, irradiance)},
    {4, 4, kRecord + offsetof(PackedRecord, stderr_lx)},
    {5, 3, kRecord + offsetof(PackedRecord, turn)},
    {6, 3, kRecord + offsetof(PackedRecord, turn) + 12},
    {7, 4, kRecord + offsetof(PackedRecord, turn) + 24},
    {8, 3, kRecord + offsetof(PackedRecord, translation)},
    {9, 3, kRecord + offsetof(PackedRecord, translation) + 12},
    {10, 3, kRecord + offsetof(PackedRecord, translation) + 24},
};

/// An array of instances: one binding, which advances from instance to instance.
GlObject instance_array(const Gl& gl, const GlObject& instances, std::size_t stride,
                        std::span<const Attribute> attributes) {
  GlObject made = make_vertex_array(gl);
  const GLuint array = made.id();
  gl.VertexArrayVertexBuffer(array, 0, instances.id(), 0, static_cast<GLsizei>(stride));
  gl.VertexArrayBindingDivisor(array, 0, 1);
  for (const Attribute& attribute : attributes) {
    gl.EnableVertexArrayAttrib(array, attribute.location);
    gl.VertexArrayAttribFormat(array, attribute.location, attribute.size, GL_FLOAT, GL_FALSE,
                               static_cast<GLuint>(attribute.offset));
    gl.VertexArrayAttribBinding(array, attribute.location, 0);
  }
  return made;
}

template <class T>
void upload(const Gl& gl, const GlObject& buffer, const std::vector<T>& values) {
  gl.NamedBufferData(buffer.id(), static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
                     GL_STREAM_DRAW);
}

void draw_rectangles(const Gl& gl, std::size_t count) {
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

}  // namespace

void GlRenderer::Impl::prepare_splat() {
  if (splat_program) return;
  const Gl& gl = context.gl();
  const std::string fragment = text("#version 450 core\n", shaders::record_weight, shaders::splat_fragment);
  splat_program = GlProgram(gl, "splat", shaders::splat_vertex, fragment.c_str());
  splat_instances = make_buffer(gl);
  splat_array = instance_array(gl, splat_instances, sizeof(SplatInstance), kAttributes);
}

void GlRenderer::Impl::prepare_footprints() {
  if (footprint_program) return;
  const Gl& gl = context.gl();
  const std::string fragment =
      text("#version 450 core\n", shaders::record_weight, shaders::footprint_fragment);
  footprint_program = GlProgram(gl, "footprint", shaders::footprint_vertex, fragment.c_str());
  footprint_instances = make_buffer(gl), footprint_shapes = make_buffer(gl);
  footprint_array = instance_array(gl, footprint_instances, sizeof(FootprintInstance), kFootprintAttributes);
}

SplatBuffer GlRenderer::splat(std::span<const IrradianceRecord> records, double accuracy,
                              const GBuffer& gbuffer, const Camera& camera) {
  PHOS_CHECK(accuracy > 0 && std::isfinite(accuracy), "accuracy ", accuracy);
  const std::size_t pixels = gbuffer.position.size();
  SplatBuffer buffer;
  std::vector<Vec4>* const sums[] = {&buffer.light, &buffer.error, &buffer.spread};
  parallel_for(3, 1, [&](std::size_t k) { sums[k]->assign(pixels, Vec4(0)); });
  if (pixels == 0 || records.empty()) return buffer;

  impl_->context.make_current();
  impl_->prepare_splat();
  const Gl& gl = impl_->context.gl();
  const GlPictureTarget& target = impl_->picture_target(gbuffer);
  buffer.unit_lx = splat_unit_lx(records);
  const auto a = static_cast<float>(accuracy);
  const Vec4 rule(1 / a, kLeastWeight, kGrowthLimit, 1 / buffer.unit_lx);
  impl_->splat_program.set("rule", rule);
  if (any_footprint(records)) {
    impl_->prepare_footprints();
    impl_->footprint_program.set("rule", rule);
  }
  impl_->bind_for_sum(target, true);

  const TileGrid grid(gbuffer, kSplatTile);
  const std::vector<PixelRect> bounds =
      record_bounds(records, accuracy, camera, gbuffer.width, gbuffer.height);
  const auto instances_of = [&](std::size_t begin, std::size_t end, SplatBatch& batch) {
    std::vector<PixelRect> rects;
    batch.discs.clear(), batch.footprints.clear(), batch.shapes.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (bounds[i].empty()) continue;
      grid.cut(records[i], a, bounds[i], rects);
      if (rects.empty()) continue;
      const PackedRecord packed = pack_record(records[i]);
      const auto shape = static_cast<float>(batch.shapes.size());
      if (records[i].footprint) batch.shapes.push_back({packed, pack_footprint(records[i])});
      for (const PixelRect& rect : rects) {
        const Vec4 where = in_viewport(rect, gbuffer.width, gbuffer.height);
        if (records[i].footprint)
          batch.footprints.push_back({where, shape});
        else
          batch.discs.push_back({where, packed});
      }
    }
  };
  const auto draw = [&](const SplatBatch& batch) {
    if (!batch.discs.empty()) {
      impl_->splat_program.use();
      gl.BindVertexArray(impl_->splat_array.id());
      upload(gl, impl_->splat_instances, batch.discs);
      draw_rectangles(gl, batch.discs.size());
    }
    if (!batch.footprints.empty()) {
      impl_->footprint_program.use();
      gl.BindVertexArray(impl_->footprint_array.id());
      upload(gl, impl_->footprint_instances, batch.footprints);
      upload(gl, impl_->footprint_shapes, batch.shapes);
      gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, impl_->footprint_shapes.id());
      draw_rectangles(gl, batch.footprints.size());
    }
  };
  // All threads make the instances of a wave; one draws them in order.
  std::vector<SplatBatch> wave(kWave);
  for (std::size_t first = 0; first < records.size(); first += kWave * kBatch) {
    const std::size_t count = std::min(kWave * kBatch, records.size() - first);
    parallel_chunks(count, kBatch, [&](std::size_t begin, std::size_t end) {
      instances_of(first + begin, first + end, wave[begin / kBatch]);
    });
    for (std::size_t k = 0; k * kBatch < count; ++k) draw(wave[k]);
    throw_if_interrupted();
  }
  impl_->read(target.light, buffer.light);
  impl_->read(target.error, buffer.error);
  impl_->read(target.spread, buffer.spread);
  impl_->context.check("splatting");
  return buffer;
}

}  // namespace phos::inline splat
