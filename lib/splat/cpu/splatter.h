// Drawing irradiance records over a G-buffer (radiance cache splatting), on the CPU.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "record/irradiance_cache.h"
#include "splat/gbuffer.h"

namespace phos::inline splat {

/// What blending leaves per pixel, before normalisation.
struct SplatBuffer {
  std::vector<Vec4> light;  ///< rgb = sum w E (lx), w = sum w
  std::vector<Vec4> error;  ///< rgb = sum w stderr (lx), w = number of records
  /// x = sum w^2, y = sum w IrradianceRecord::shared, z = sum w (luminance of E / unit_lx)^2, w = 0.
  std::vector<Vec4> spread;
  float unit_lx = 1;

  /// E of a pixel and its standard error (blended_error), lx. Of no record: 0.
  Interpolated at(std::size_t pixel) const;
};

/// The unit that keeps squares of the records' irradiance within the range of floats: the largest irradiance.
float splat_unit_lx(std::span<const IrradianceRecord> records);

/// Every record's weight (record_weight at `accuracy`) and extrapolated irradiance, summed. Tiled,
/// vectorised, same bytes for any number of threads. The oracle for OpenGL.
SplatBuffer splat_on_cpu(std::span<const IrradianceRecord> records, double accuracy, const GBuffer& gbuffer,
                         const Camera& camera);

}  // namespace phos::inline splat
