// Radiance records by drawing the scene over them (docs/methods.md#r2).
#pragma once

#include <cstdint>
#include <memory>

#include "estimate/estimator.h"
#include "estimate/gather_source.h"

namespace phos::inline estimate {
enum class RadianceGradient;
struct Hemisphere;
struct RecordOptions;
}  // namespace phos::inline estimate
namespace phos::inline scene {
class Luminaires;
class RayScene;
}  // namespace phos::inline scene

namespace phos::inline splat {

/// The pixels of RasterEstimator, projected onto harmonics by the solid angle that each stands for
/// (plane_pieces.h). Gradients as RadianceEstimator has them, hybrid with the borders between pixels. Without
/// noise but for the lamps' samples and the source: stderr_light holds the part of the source alone.
class RadianceRasterEstimator : public Estimator {
 public:
  /// Draws in the thread that calls this. Random numbers differ from the numbers of irradiance records with
  /// the same seed. Throws Error(bad_input) if no OpenGL context can be had, Error(usage) for an order
  /// outside 1 .. HshRotator::kMaxOrder or a plane of more pixels than OpenGL can draw.
  RadianceRasterEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                          const RecordOptions& resolved, int order, RadianceGradient gradient,
                          std::uint64_t seed);
  ~RadianceRasterEstimator() override;
  std::unique_ptr<Worker> make_worker() const override;
  /// The record at a site is Made::radiance, limited as RadianceEstimator's.
  Made make(const RecordSite& site, Worker& worker) const override;
  bool one_thread() const override { return true; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline splat
