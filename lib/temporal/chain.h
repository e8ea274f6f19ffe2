// A place of a film and its light at some frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "estimate/estimator.h"
#include "place/growth.h"
#include "scene/motion/anchor.h"
#include "temporal/film/cache.h"
#include "temporal/survey.h"

namespace phos::inline temporal {

/// What was found at one frame.
struct Key {
  std::int64_t frame = 0;
  /// The frame up to which this key and the next give the light there; `frame` itself: this key
  /// only ends the span before.
  std::int64_t until = 0;
  IrradianceRecord record;  ///< radius settled
  std::shared_ptr<const RadianceRecord> radiance;
  Pose pose;
  /// One frame on, as it was expected (with Lives::rate), the pose there, and the relative change to it.
  std::shared_ptr<const Ahead> ahead{};
  Pose ahead_pose{};
  double rate = 0;
  bool jumps = false;  ///< the light at `until` comes after a jump: nothing is interpolated to it
};

struct Chain {
  std::uint32_t number = 0;  ///< its rays' random numbers, at every frame
  Anchor anchor;             ///< no triangle: it never moves
  float share = 1;           ///< of its own radius that its first neighbours left it
  float least_radius_m = 0, most_radius_m = kInfinity;  ///< its place's own bounds
  std::vector<Key> keys;                                ///< by frame

  const Key* at(std::int64_t frame) const;
};

/// Random streams of chains: kFilmItems + number.
inline constexpr std::uint64_t kFilmItems = std::uint64_t{1} << 43;

/// Where the chain is at a frame: nothing if its surface has no area then.
std::optional<RecordSite> site_of(const Chain& chain, const Scene& scene, Pose& pose);

/// Adds the record of a chain's last key, where its surface is in `scene`; false if that has no area there.
bool add_as_it_was(const Chain& chain, const Scene& scene, IrradianceCache& to);

/// The key that an estimate at `site` gives, the radius within the chain's share and bounds. A record that
/// photons drew aside is taken back to the site along its gradient.
Key key_of(const Chain& chain, const Made& made, const RadiusBounds& bounds, std::int64_t frame,
           const RecordSite& site, const Pose& pose);

/// A new chain from a record that placement has settled. Its surface's triangle is remembered if that moves
/// at any frame of the film.
Chain chain_of(const Made& made, const IrradianceRecord& settled, const RadianceRecord* radiance,
               const RayScene& rays, std::int64_t frame, const FilmSurvey& survey);

/// The records that chains stand for: each key until the next, changed as info.gradients says (where
/// nothing follows, not at all). What ends at the last frame of a shot lives for that frame. `quantity`: as
/// IrradianceCache::quantity.
Film film_of(std::span<const Chain> chains, const FilmInfo& info, Quantity quantity);
RadianceFilm radiance_film_of(std::span<const Chain> chains, const FilmInfo& info);

}  // namespace phos::inline temporal
