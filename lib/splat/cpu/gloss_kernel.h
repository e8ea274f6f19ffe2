// The inner loops of the gloss splatter, over the pixels of a group side by side: plain arrays only, because
// they are compiled twice (for x86-64-v3, and for any machine) and share no inline function with the rest.
// Both give the same bits: no contraction, no reassociation.
#pragma once

#include <cstddef>

namespace phos::inline splat {

inline constexpr int kGlossLanes = 8;

/// Numbers of the pixels of a group: one per pixel. (A type of the compiler's: left to find vectors by
/// itself, it keeps sums in memory.) Aligned alike on all machines.
struct alignas(kGlossLanes * sizeof(float)) GlossLane {
  using Numbers __attribute__((vector_size(kGlossLanes * sizeof(float)))) = float;
  Numbers of;
};

/// A group of pixels of one class, and the sums of GlossBuffer and of irradiance. Lanes without a pixel have
/// a zero normal.
struct GlossGroup {
  GlossLane px, py, pz, nx, ny, nz;
  int order;              ///< bands of their lobes
  GlossLane* lobe;        ///< [order^2][3], 1/sqrt(sr)
  GlossLane* band_error;  ///< [order][3] sums of w stderr
  GlossLane light[4], error[4], irradiance[3];
  GlossLane spread[3];  ///< as SplatBuffer::spread, of light in units of 1 / per_unit
  float per_unit;
};

/// A RadianceRecord as the loops want it. front_limit_m = -tolerance * radius; over_limit_m is the limit of
/// record_apart(). Of its footprint, whose axes are in its frame: 1 / length of each axis and of the
/// shortest, and the longest axis / radius; all 0: a disc.
struct GlossSplat {
  static constexpr int kAxes = 8;
  float position[3], inverse_radius, normal[3], front_limit_m, over_limit_m;
  float x[3], y[3];      ///< axes of its frame
  float weight, shared;  ///< its own
  float inverse[kAxes], inverse_shortest, per_radius;
  float steepness_per_m;  ///< steps by more than 1/this are shortened to that; 0: no steps at all
  const float *light, *gradient_x, *gradient_y, *stderr_light;
  float irradiance[3], irradiance_x[3], irradiance_y[3];  ///< of the former three
};

/// The weights of a record at the pixels; 0 where it is not valid.
using GlossWeights = void(const GlossGroup& group, const GlossSplat& record, float inverse_accuracy,
                          float least_weight, GlossLane& weight);
/// Adds the light that a record sends through the pixels' lobes.
using GlossAdd = void(GlossGroup& group, const GlossSplat& record, const GlossLane& weight);
/// Makes the sums of errors out of the sums of bands: independent from band to band.
using GlossFinish = void(GlossGroup& group);

struct GlossKernel {
  GlossWeights* weights;
  GlossAdd* add;
  GlossFinish* finish;
};
extern const GlossKernel gloss_kernel_plain;
#ifdef PHOS_SPLAT_AVX2
extern const GlossKernel gloss_kernel_avx2;
#endif
/// The fastest one that this machine can run.
const GlossKernel& best_gloss_kernel();

}  // namespace phos::inline splat
