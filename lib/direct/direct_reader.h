// Direct light at a point, by as many shadow rays as a stated error takes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "direct/direct_light.h"
#include "direct/light_cut.h"

namespace phos::inline direct {

/// How well direct light is to be known.
struct DirectTarget {
  double relative_error = 0.01;  ///< standard error over the illuminance of all light there
  double known_lx = 0;           ///< illuminance that the caches tell, lx
  bool holds_direct = false;     ///< known_lx holds the direct light; else the direct light is added to it
};

struct DirectReading {
  Rgb irradiance{0};  ///< lx
  Rgb stderr_lx{0};
  std::uint64_t rays = 0;  ///< sent, the pilot's included
  bool met = true;         ///< the stated error is at most the one asked for
};

/// Reads direct light. Const, usable from any thread; holds references.
class DirectReader {
 public:
  DirectReader(const RayScene& rays, const Luminaires& lights);

  /// By `samples` shadow rays to each lamp of an extent (direct_irradiance()); `item` is of the random
  /// numbers.
  DirectReading read(const SurfacePoint& at, int samples, std::uint64_t seed, std::uint64_t item) const;

  /// By as many rays as the target takes: their number follows from a pilot of other random numbers whose
  /// rays are thrown away, so that the estimate is unbiased and its error its own (docs/methods.md#t4). At
  /// most kMostRays to each lamp: the target may then be missed.
  DirectReading read(const SurfacePoint& at, const DirectTarget& target, std::uint64_t seed,
                     std::uint64_t item) const;

  static constexpr int kMostRays = 4096;

  /// Are lamps so many (more than 1000 that stand somewhere, and no mirror) that the target is met by a cut
  /// through their hierarchy (light_by_cut())?
  bool by_cut() const { return tree_.has_value(); }

 private:
  struct Pilot;
  CutLight read_cut(const SurfacePoint& at, double stderr_lx, const CutLight& pilot,
                    RandomStream& random) const;
  Pilot send_pilot(const SurfacePoint& at, std::uint64_t seed, std::uint64_t item) const;

  const RayScene& rays_;
  const Luminaires& lights_;
  std::optional<LightTree> tree_;
  std::vector<std::uint32_t> aimed_;  // lights that are no part of the tree
};

}  // namespace phos::inline direct
