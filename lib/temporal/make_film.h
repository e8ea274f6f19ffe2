// From a scene and options to the records of a film.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "radiance/brdf/table.h"
#include "radiance/gloss_tables.h"
#include "temporal/film/maker.h"

namespace phos::inline temporal {

/// What a film is made from.
struct FilmJob {
  FilmSurvey survey;
  FilmOptions options;
  LightOptions light;  ///< resolved
  PlacementOptions placement;
  GlossTables gloss;         ///< lobes that radiance records serve
  bool of_radiance = false;  ///< make radiance records, where gloss wants them; else irradiance records
  EstimateJournal* journal = nullptr;  ///< of FilmTask
  bool covered_by_radiance = false;    ///< places that radiance records serve get no irradiance records
};

/// What gathered rays read where they land: coarse records from photons traced every source_life frames.
Film make_source(const FilmJob& job, FrameScenes& scenes, Counters& counters);
/// Do gathered rays read one?
bool needs_source(const FilmJob& job);

/// The chains of a film, and the cost of making them.
struct FilmChains {
  std::vector<Chain> chains;
  FilmReport report;
};
/// `source` may be null where none is needed.
FilmChains make_chains(const FilmJob& job, FrameScenes& scenes, const Film* source, Counters& counters);

/// For a film in which no light changes: the records of its first frame that all of its frames need.
std::vector<Key> make_still(const FilmJob& job, FrameScenes& scenes, const Film* source, Counters& counters,
                            FilmReport& report);

/// They as a cache.
IrradianceCache still_irradiance(const FilmJob& job, std::span<const Key> keys);
RadianceCache still_radiance(const FilmJob& job, std::span<const Key> keys);

/// How a radiance film's records are made: as phos-radiance makes them, but for the options given.
RadianceOptions radiance_options(const RecordOptions& given, const Options& options);
/// Fills in places that come from the scene itself (view, photons or surface) for records of this accuracy.
/// Throws Error(usage) for others.
void resolve_film_places(PlacementOptions& placement, const Scene& scene, double accuracy);

/// The facts of the film for its file.
FilmInfo info_of(const FilmJob& job);

}  // namespace phos::inline temporal
