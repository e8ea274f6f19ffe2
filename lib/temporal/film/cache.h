// Records that live for some frames of a film, their file, and the cache that they are at one frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "radiance/cache.h"
#include "record/irradiance_cache.h"
#include "scene/motion/anchor.h"
#include "scene/motion/film.h"

namespace phos::inline temporal {

/// How records change between the frames at which they were computed.
enum class TemporalGradients {
  none,          ///< not at all
  extrapolated,  ///< as the frame after their birth says (docs/methods.md#f5)
  interpolated,  ///< straight to the record that follows at the same place (docs/methods.md#f5)
};
const char* name_of(TemporalGradients gradients);

/// When a record is used, where, and its successor.
struct Life {
  std::int32_t birth = 0, end = 0;  ///< frames: used at birth <= t < end
  std::uint32_t chain = 0;          ///< the records of one place, one after another; numbered from 0
  float rate = 0;                   ///< relative change per frame that was expected (docs/methods.md#f2)
  Anchor anchor;                    ///< no triangle: it stays where it was born
  glm::quat turn{1, 0, 0, 0};       ///< of the anchor's triangle at birth
};

/// Change per frame. Vectors are in the axes of the record's birth: the change by the surface's own
/// turn is taken out.
struct IrradianceChange {
  Rgb irradiance{0};
  Vec3 rotation[3]{Vec3(0), Vec3(0), Vec3(0)}, translation[3]{Vec3(0), Vec3(0), Vec3(0)};
  float radius_m = 0;
  /// Of a record with a footprint: the change of each of its axes' numbers (docs/methods.md#f8). Null: none.
  std::shared_ptr<const AdaptiveFootprint::Axes> footprint{};
};
/// Coefficients are in the record's frame, which turns with the surface. Empty: no change.
struct RadianceChange {
  std::vector<float> light, gradient_x, gradient_y;
  float radius_m = 0;
  /// Of a record with a footprint: the change of the lengths of its axes (docs/methods.md#f8). None: they
  /// stay.
  std::optional<AdaptiveFootprint::Lengths> footprint_m{};
};

struct FilmRecord {
  using Change = IrradianceChange;
  IrradianceRecord record;  ///< as it was born
  Life life;
  IrradianceChange change;
};
struct FilmRadianceRecord {
  using Change = RadianceChange;
  RadianceRecord record;
  Life life;
  RadianceChange change;
};

/// What irradiance and radiance films have in common.
struct FilmInfo {
  FrameRange frames;
  double accuracy = 0.2;            ///< a that placed the records
  double temporal_accuracy = 0.05;  ///< a_t: relative change that a record may miss
  std::int64_t max_life = 20;       ///< frames
  TemporalGradients gradients = TemporalGradients::interpolated;
  std::int64_t fade = 0;  ///< frames in which a place's first record fades in and its last one out
  std::vector<std::string> scene_hash;  ///< of each frame
};
struct Film {
  FilmInfo info;
  Quantity quantity = Quantity::indirect;  ///< as IrradianceCache::quantity
  std::vector<FilmRecord> records;         ///< by (chain, birth)
};
struct RadianceFilm {
  FilmInfo info;
  std::vector<FilmRadianceRecord> records;  ///< by (chain, birth)
};

/// Does the zone that a record serves change with its light?
enum class Reach {
  changes,  ///< to the zone of the next record
  stays,    ///< neighbours and bounds do not change the zone: light alone does
};
/// The change from one record to the next at the same place, per frame (docs/methods.md#f5, interpolated;
/// footprints: #f8). Births must differ; both records have a footprint, or none has.
IrradianceChange change_between(const FilmRecord& from, const FilmRecord& to, Reach reach = Reach::changes);
RadianceChange change_between(const FilmRadianceRecord& from, const FilmRadianceRecord& to,
                              Reach reach = Reach::changes);

/// A record as it is at a frame of its life, before it is moved with its surface: irradiance is at least 0
/// (docs/methods.md#f5), a radius stays positive.
IrradianceRecord changed(const FilmRecord& film, std::int64_t frame);
RadianceRecord changed(const FilmRadianceRecord& film, std::int64_t frame);

/// Each record that is alive at `frame`, moved with its surface and changed by t - birth frames.
/// Those whose surface has no area then are left out.
/// Weights: max(0, 1 - rate (t - birth) / a_t) (docs/methods.md#f1), at least a hundredth, except with
/// interpolated gradients, times the fade. `scene` is the scene at that frame.
IrradianceCache cache_at(const Film& film, std::int64_t frame, const Scene& scene);
RadianceCache cache_at(const RadianceFilm& film, std::int64_t frame, const Scene& scene);

}  // namespace phos::inline temporal
