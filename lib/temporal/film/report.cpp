#include "temporal/film/report.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline temporal {
namespace {

/// Of the frames that records live through: from this share that was computed on, a film is hardly worth it.
constexpr double kHardlyWorth = 1. / 3;

double rounded(double v) { return std::round(100 * v) / 100; }

}  // namespace

void tell_of_film(Tool& tool, const FilmJob& job) {
  const FilmSurvey& film = job.survey;
  tool.stat("frames", film.frames.count());
  if (!film.light_changes) {
    tool.say(text("no light changes from frame ", film.frames.first, " to ", film.frames.last,
                  ": an ordinary cache will do, without temporal data"));
    return;
  }
  const auto moving = std::count(film.moved.begin(), film.moved.end(), true);
  std::string cuts;
  for (std::size_t i = 1; i < film.shots.size(); ++i)
    cuts += text(cuts.empty() ? "" : ", ", film.shots[i].first);
  tool.say(text(film.frames.count(), " frames, ", moving, " of ", film.moved.size(), " instances move",
                cuts.empty() ? "" : "; light jumps at frame " + cuts + ", and is not interpolated there"));
  tool.stat("moving_instances", moving);
  Json jumps = Json::Array{};
  for (std::size_t i = 1; i < film.shots.size(); ++i) jumps.push_back(film.shots[i].first);
  tool.stat("jumps", jumps);
}

void tell_of_records(Tool& tool, const FilmJob& job, const FilmReport& r) {
  tool.stat("chains", r.chains);
  tool.stat("records", r.records);
  tool.stat("estimates", r.estimates);
  tool.stat("frames_with_light", r.frames_with_light.size());
  tool.stat("places_given_up", r.deleted);
  double frames = 0;
  Json lives = Json::Object{};
  for (const auto& [life, count] : r.lives) {
    frames += static_cast<double>(life) * static_cast<double>(count);
    lives[text(life)] = count;
  }
  tool.stat("lives", lives);
  const double mean = r.records > 0 ? frames / static_cast<double>(r.records) : 0;
  if (r.estimates > 0) tool.stat("ms_per_record", 1e3 * r.making_s / static_cast<double>(r.estimates));
  if (!job.survey.light_changes) {
    tool.say(text(r.records, " records"));
  } else {
    tool.say(text(
        r.records, " records at ", r.chains, " places, living ", rounded(mean), " frames on the mean; ",
        r.estimates, " estimates at ", r.frames_with_light.size(), " frames",
        r.estimates > 0 ? text(", ", rounded(1e3 * r.making_s / static_cast<double>(r.estimates)), " ms each")
                        : ""));
    const double computed = frames > 0 ? static_cast<double>(r.estimates) / frames : 0;
    tool.stat("computed_share", computed);
    if (computed > kHardlyWorth)
      tool.say(text("at most places light changes from frame to frame: ", std::round(100 * computed),
                    " % of all frames were computed, and a cache for each may be as fast; raise "
                    "--temporal-accuracy or --max-life to compute fewer"));
  }
  if (r.records == 0)
    tool.warn("no place needs a record (see --place, --camera): the file is empty");
  else if (r.uncovered > 0)
    tool.say(text(r.uncovered, " places are left uncovered by neighbour clamping; raise --passes"));
}

}  // namespace phos::inline temporal
