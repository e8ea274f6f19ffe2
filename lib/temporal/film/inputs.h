// Caches and films alike, as caches at the time of a scene.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "file/container.h"
#include "file/provenance.h"
#include "radiance/cache.h"
#include "record/irradiance_cache.h"
#include "scene/scene.h"
#include "sense/sensors.h"
#include "temporal/film/cache.h"
#include "temporal/survey.h"

namespace phos::inline temporal {

/// The frame that a scene was loaded at: the nearest to its time.
std::int64_t frame_of(const Scene& scene);

/// Throws Error(mismatch) where a file was made from another scene; of a film, where it does not have the
/// scene's frame or that was another.
void require_same_scene(const Container& file, const std::string& scene_path, const Scene& scene);

/// Throws Error(mismatch) where a file does not hold the frames of a film: another scene's, too few of them,
/// or frames of one time where light changes.
void require_same_film(const Container& file, const FilmSurvey& survey);

/// Of a film, the records of the scene's frame; throws Error(mismatch) where it has no such frame.
IrradianceCache read_irradiance_at(const Container& file, const Scene& scene);
RadianceCache read_radiance_at(const Container& file, const Scene& scene);
/// Files of irradiance and radiance, all looked up together. Throws as the two and SensorCaches do.
SensorCaches sensor_caches_at(std::span<const Container> files, const Scene& scene,
                              const RayScene* leak_test);

}  // namespace phos::inline temporal
