// Follows photons from a light to their end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/random.h"
#include "photon/caustic_aim.h"
#include "photon/emission.h"
#include "photon/flight.h"
#include "photon/portal_split.h"
#include "scene/material/bsdf.h"
#include "scene/rays.h"

namespace phos::inline photon {

/// Const and usable from any thread; holds references.
class PathTracer {
 public:
  /// `aim` null: no path is aimed. `aimed_paths` are all of them.
  PathTracer(const RayScene& rays, const Emitter& emitter, const CausticAim* aim, std::uint64_t paths,
             std::uint64_t aimed_paths, std::uint64_t seed, bool log);

  /// A path, and the aimed paths that go with it: all of them are dealt out in order.
  void trace(std::uint64_t path, PathPart& part) const;
  /// Numbers of those aimed paths: the first, and the one behind the last.
  std::pair<std::uint64_t, std::uint64_t> aimed_with(std::uint64_t path) const;

  // The steps of a path, for those that advance many side by side: where there are neither panes nor portals.

  bool steps_alike() const { return !rays_.has_panes() && !split_; }
  const RayScene& rays() const { return rays_; }

  RandomStream stream(std::uint64_t path) const { return {seed_, Stage::photon_path, path}; }
  RandomStream aimed_stream(std::uint64_t number) const {
    return {seed_, Stage::photon_path, kAimedItems + number};
  }
  /// Sets a flight off from its light. False: it is none.
  bool start(std::uint64_t path, RandomStream& random, Flight& flight, PathPart& part) const;
  bool start_aimed(std::uint64_t number, RandomStream& random, Flight& flight, PathPart& part) const;

  static bool carries_light(const Flight& flight) {
    return std::max(flight.flux_lm.x, std::max(flight.flux_lm.y, flight.flux_lm.z)) > 0;
  }

  /// What the next surface is sampled with: drawn before the ray is traced, so that the processor can work it
  /// out in the waits of the traversal.
  struct Draws {
    float lobe;
    Vec2 direction;
  };
  Draws depart(Flight& flight, RandomStream& random, PathPart& part) const;

  enum class After : std::uint8_t { ended, scattered, passed };
  /// The flight has met a surface: stores it there, and sends it on.
  After land(const SurfacePoint& point, const Bsdf& bsdf, const Draws& draws, Flight& flight,
             RandomStream& random, PathPart& part) const;
  /// The flight has met nothing.
  void escape(const Flight& flight, PathPart& part) const;

 private:
  static constexpr std::uint64_t kAimedItems = std::uint64_t{1} << 63;  // random streams: + number

  static PathSums& sums(const Flight& flight, PathPart& part) {
    return flight.keep == Flight::Keep::caustics ? part.aimed : part.sums;
  }
  FluxSum units(const Rgb& flux_lm) const { return FluxSum::of(flux_lm, units_per_lm_); }
  void follow(Flight& flight, RandomStream& random, PathPart& part) const;
  bool step(Flight& flight, RandomStream& random, PathPart& part) const;
  bool is_of_image(const Light& light, const Vec3& direction) const;
  After scatter(const Bsdf& bsdf, const SurfacePoint& point, const Draws& draws, Flight& flight,
                RandomStream& random, PathPart& part) const;
  void send_through_portals(const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo, const Flight& parent,
                            PathPart& part) const;

  const RayScene& rays_;
  const Emitter& emitter_;
  const MirrorPlanes& mirrors_;
  const CausticAim* aim_;
  std::optional<PortalSplit> split_;
  std::uint64_t paths_, aimed_paths_;
  std::uint64_t seed_;
  bool log_;
  double units_per_lm_;
};

}  // namespace phos::inline photon
