// What phos-temporal tells of a film.
#pragma once

#include "file/tool.h"
#include "temporal/make_film.h"

namespace phos::inline temporal {

/// Before the work: frames, cuts, moving parts; or that nothing changes.
void tell_of_film(Tool& tool, const FilmJob& job);
/// After it: records, lives, cost; also as figures for --stats.
void tell_of_records(Tool& tool, const FilmJob& job, const FilmReport& report);

}  // namespace phos::inline temporal
