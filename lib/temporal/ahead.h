// What a record will be one frame on, estimated when it is made (docs/methods.md#f6).
#pragma once

#include <cstdint>
#include <memory>

#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "scene/lamp/luminaires.h"
#include "scene/motion/film.h"
#include "scene/rays.h"
#include "temporal/film/options.h"

namespace phos::inline temporal {

/// With LookAhead::none, Made::ahead is null. Reprojection is for estimators that sample hemispheres; others
/// make the next frame's record in full.
struct AheadOptions {
  LookAhead look = LookAhead::reproject;
  double share = 0.125;      ///< the greatest share of hits at which the lamps are asked again; in (0, 1]
  double most_holes = 0.03;  ///< of the hemisphere; above it the next frame is traced (docs/methods.md#f6)
  /// The record ahead has gradients and a radius of its own. Else, by reprojection, it is the record as it
  /// is, at its place one frame on, but for its irradiance, and without a footprint: a third of the cost. (Of radiance records all is
  /// always had.)
  bool whole = true;
};

/// A frame, and the estimator of its records.
struct FrameEstimator {
  const Estimator& estimator;
  const RayScene& rays;
  const Luminaires& lights;
};

/// The estimator of one frame that looks one frame ahead. Records are those of `now`, bit for bit; in
/// Made::ahead is the same place, moved with its surface, at `next`, whose estimator should have the same
/// seed (and photons the same paths), so that only changes differ. Where a place's surface is no more,
/// Made::ahead is null.
///
/// By reprojection, light is taken as follows. Where lamps and materials stay, light straight from a lamp
/// stays too, but where a moving surface crosses its way (looked at again) or is the hit itself. Light at
/// surfaces that moved, or all light where lamps change, is computed again with the lamps and surfaces of
/// both frames, the same random numbers, and for a share of the hits, each of which speaks for its
/// neighbours: unbiased, and exactly nothing where nothing changes. All other light stays with the surface
/// that sends it, which a frame later is nearly right, and free of the noise of another frame's photons.
/// Where nothing at all changes the record ahead is the record itself: its expected rate is exactly 0.
class AheadEstimator : public Estimator {
 public:
  /// Holds references. `changes` are those between the two frames; `resolved` and `seed` as of `now`.
  AheadEstimator(const FrameEstimator& now, const FrameEstimator& next, const Changes& changes,
                 const RecordOptions& resolved, std::uint64_t seed, const AheadOptions& options);
  ~AheadEstimator() override;
  std::unique_ptr<Estimator::Worker> make_worker() const override;
  Made make(const RecordSite& site, Estimator::Worker& worker) const override;
  bool one_thread() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline temporal
