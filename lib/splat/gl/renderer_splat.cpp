// Splatting by OpenGL: each record is an instanced rectangle, or a few that cover the tiles where it can
// weigh something, added to the picture by 32-bit float blending.
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

struct Attribute {
  GLuint location;
  GLint size;
  std::size_t offset;
};
constexpr std::size_t kRecord = offsetof(SplatInstance, record);
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

}  // namespace

void GlRenderer::Impl::prepare_splat() {
  if (splat_program) return;
  const Gl& gl = context.gl();
  const std::string fragment = text("#version 450 core\n", shaders::record_weight, shaders::splat_fragment);
  splat_program = GlProgram(gl, "splat", shaders::splat_vertex, fragment.c_str());
  splat_instances = make_buffer(gl);
  splat_array = make_vertex_array(gl);
  const GLuint array = splat_array.id();
  gl.VertexArrayVertexBuffer(array, 0, splat_instances.id(), 0, sizeof(SplatInstance));
  gl.VertexArrayBindingDivisor(array, 0, 1);
  for (const Attribute& attribute : kAttributes) {
    gl.EnableVertexArrayAttrib(array, attribute.location);
    gl.VertexArrayAttribFormat(array, attribute.location, attribute.size, GL_FLOAT, GL_FALSE,
                               static_cast<GLuint>(attribute.offset));
    gl.VertexArrayAttribBinding(array, attribute.location, 0);
  }
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
  impl_->splat_program.set("rule", Vec4(1 / a, kLeastWeight, kGrowthLimit, 1 / buffer.unit_lx));
  impl_->splat_program.use();
  impl_->bind_for_sum(target, true);
  gl.BindVertexArray(impl_->splat_array.id());

  const TileGrid grid(gbuffer, kSplatTile);
  const std::vector<PixelRect> bounds =
      record_bounds(records, accuracy, camera, gbuffer.width, gbuffer.height);
  const auto instances_of = [&](std::size_t begin, std::size_t end, std::vector<SplatInstance>& batch) {
    std::vector<PixelRect> rects;
    batch.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (bounds[i].empty()) continue;
      grid.cut(records[i], a, bounds[i], rects);
      if (rects.empty()) continue;
      const PackedRecord packed = pack_record(records[i]);
      for (const PixelRect& rect : rects)
        batch.push_back({in_viewport(rect, gbuffer.width, gbuffer.height), packed});
    }
  };
  // All threads make the instances of a wave; one draws them in order.
  std::vector<std::vector<SplatInstance>> wave(kWave);
  for (std::size_t first = 0; first < records.size(); first += kWave * kBatch) {
    const std::size_t count = std::min(kWave * kBatch, records.size() - first);
    parallel_chunks(count, kBatch, [&](std::size_t begin, std::size_t end) {
      instances_of(first + begin, first + end, wave[begin / kBatch]);
    });
    for (std::size_t k = 0; k * kBatch < count; ++k) {
      if (wave[k].empty()) continue;
      gl.NamedBufferData(impl_->splat_instances.id(),
                         static_cast<GLsizeiptr>(wave[k].size() * sizeof(SplatInstance)), wave[k].data(),
                         GL_STREAM_DRAW);
      gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(wave[k].size()));
    }
    throw_if_interrupted();
  }
  impl_->read(target.light, buffer.light);
  impl_->read(target.error, buffer.error);
  impl_->read(target.spread, buffer.spread);
  impl_->context.check("splatting");
  return buffer;
}

}  // namespace phos::inline splat
