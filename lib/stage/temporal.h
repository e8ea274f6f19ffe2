// phos-temporal: an animated scene -> records that live through its frames.
#pragma once

#include <string>
#include <vector>

#include "file/tool.h"
#include "radiance/gloss_tables.h"
#include "scene/load.h"
#include "splat/gl/kinds.h"
#include "temporal/make_film.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kTemporalAlgorithm = 24;

enum class RecordKind { irradiance, radiance };

struct TemporalCommand {
  TemporalCommand() { job.light.records.estimate = Estimate::gather, job.placement.place = Place::view; }
  std::vector<std::string> inputs;
  std::string frames, isa;
  GlBy gl = GlBy::osmesa;
  SceneOptions scene;
  FilmJob job;
  RecordKind kind = RecordKind::irradiance;
  GlossBy gloss = GlossBy::automatic;
  Store store = Store::compact;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set, and gets
/// the values that were left to it.
void run(Tool& tool, TemporalCommand& asked);

}  // namespace phos::stage
