// Records as dense as their light is uneven (docs/methods.md#h7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimate/record_options.h"
#include "place/growth.h"
#include "place/parallel_maker.h"

namespace phos::inline place {

/// How much records of one kind scatter, as pairs of records at the same places tell.
struct RecordNoise {
  double irradiance = 0;  ///< standard error of irradiance, of the irradiance E
  double gradient = 0;    ///< standard error of a component of the translation gradient, of E / distance_m
  double stated = 0;      ///< standard error of irradiance, of the stated one; 0: none is stated

  /// Standard error of a record's luminance, lx: its stated one, by how far those are true; where none is
  /// stated, all are taken for equally noisy. Rays that find a bright spot make more noise than those beside.
  double error_lx(const IrradianceRecord& record) const;
};
/// From pairs of independent records, one a place. Zero for none.
RecordNoise noise_of(std::span<const Made> first, std::span<const Made> second);

/// Judges records by those about them: a plane through at most ten neighbours foretells each one's irradiance
/// (docs/methods.md#h7, "judge"). Where that fails by more than the tolerance and the noise, over a record
/// and its neighbours together, the record comes to reach less far. Noise of single records does not shrink
/// them. Light that nothing about a record hints at is not found.
class Refinement {
 public:
  /// `growth` must grow by error. `target`: root mean square error aimed at, of the mean irradiance over the
  /// surfaces, > 0. Holds references.
  Refinement(Growth& growth, ParallelMaker& maker, const RecordOptions& resolved, double target);

  /// Judges the records so far. Returns how many have been shrunk, down to a half each; places that they
  /// covered may be open. The first call makes up to 32 records again, with other rays, to know their noise.
  std::size_t refine();

  /// Gradients along the surface that fit the neighbours' irradiance as well as their own noise lets them
  /// (docs/methods.md#h7, "fit"), of the new records, which are the last of `records`: all of the cache's.
  void fit_gradients(std::vector<IrradianceRecord>& records, std::size_t first_new) const;

  const RecordNoise& noise() const { return noise_; }

 private:
  void measure_noise();
  Growth& growth_;
  ParallelMaker& maker_;
  float accuracy_;
  double target_;
  bool measured_ = false;
  RecordNoise noise_;
};

}  // namespace phos::inline place
