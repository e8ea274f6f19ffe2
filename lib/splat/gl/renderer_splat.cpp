// Splatting by OpenGL: each record is an instanced rectangle, or a few that cover the tiles where it can
// weigh something, added to the picture by 32-bit float blending. Records that serve a disc and records with
// footprints have a program each. The latter have too many numbers for the attributes of an instance, and are
// drawn one at a time, as a uniform block: OSMesa takes three times as long to fetch them from a buffer by
// number.
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

/// A record with a footprint, as the uniform block of footprint_fragment has it.
struct FootprintBlock {
  struct Axis {
    Vec4 slope, half_bend, turn_slope, half_turn_bend;
  };
  Vec4 position, normal, irradiance, stderr_lx, axis_x, axis_y;
  Axis axes[PackedFootprint::kAxes];

  FootprintBlock(const PackedRecord& r, const PackedFootprint& f)
      : position(vector(r.position), f.per_radius),
        normal(vector(r.normal), r.front_limit_m),
        irradiance(vector(r.irradiance), r.weight),
        stderr_lx(vector(r.stderr_lx), r.shared),
        axis_x(vector(f.x), f.inverse_shortest),
        axis_y(vector(f.y), r.over_limit_m) {
    for (int k = 0; k < PackedFootprint::kAxes; ++k)
      axes[k] = {colours(f.slope, k, f.inverse[k]), colours(f.half_bend, k), colours(f.turn_slope, k),
                 colours(f.half_turn_bend, k)};
  }

 private:
  static Vec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
  static Vec4 colours(const float (&v)[3][PackedFootprint::kAxes], int k, float beside = 0) {
    return {v[0][k], v[1][k], v[2][k], beside};
  }
};

/// A record with a footprint, and the rectangles where it is drawn.
struct FootprintDraw {
  FootprintBlock block;
  std::vector<Vec4> rects;
};

/// Records that are made ready together, each kind in its order.
struct SplatBatch {
  std::vector<SplatInstance> discs;
  std::vector<FootprintDraw> footprints;
};

struct Attribute {
  GLuint location;
  GLint size;
  std::size_t offset;
};
constexpr std::size_t kRecord = offsetof(SplatInstance, record);
constexpr Attribute kFootprintAttributes[] = {{0, 4, 0}};
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
void upload(const Gl& gl, const GlObject& buffer, std::span<const T> values) {
  gl.NamedBufferData(buffer.id(), static_cast<GLsizeiptr>(values.size_bytes()), values.data(),
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
  footprint_program = GlProgram(gl, "footprint", shaders::one_record_vertex, fragment.c_str());
  footprint_rects = make_buffer(gl), footprint_block = make_buffer(gl);
  footprint_array = instance_array(gl, footprint_rects, sizeof(Vec4), kFootprintAttributes);
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
    batch.discs.clear(), batch.footprints.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (bounds[i].empty()) continue;
      grid.cut(records[i], a, bounds[i], rects);
      if (rects.empty()) continue;
      const PackedRecord packed = pack_record(records[i]);
      std::vector<Vec4> where;
      for (const PixelRect& rect : rects) where.push_back(in_viewport(rect, gbuffer.width, gbuffer.height));
      if (records[i].footprint)
        batch.footprints.push_back({{packed, pack_footprint(records[i])}, std::move(where)});
      else
        for (const Vec4& rect : where) batch.discs.push_back({rect, packed});
    }
  };
  const auto draw = [&](const SplatBatch& batch) {
    if (!batch.discs.empty()) {
      impl_->splat_program.use();
      gl.BindVertexArray(impl_->splat_array.id());
      upload(gl, impl_->splat_instances, std::span(batch.discs));
      draw_rectangles(gl, batch.discs.size());
    }
    if (batch.footprints.empty()) return;
    impl_->footprint_program.use();
    gl.BindVertexArray(impl_->footprint_array.id());
    for (const FootprintDraw& record : batch.footprints) {
      upload(gl, impl_->footprint_rects, std::span(record.rects));
      upload(gl, impl_->footprint_block, std::span(&record.block, 1));
      gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, impl_->footprint_block.id());
      draw_rectangles(gl, record.rects.size());
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
