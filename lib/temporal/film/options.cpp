#include "temporal/film/options.h"

#include "core/error.h"

namespace phos::inline temporal {

void declare_options(Options& options, FilmOptions& f) {
  options.section("Time");
  options.number(
      "temporal-accuracy", f.temporal_accuracy, "FRACTION",
      "relative change of a place's light over time that may be missed; smaller computes it at more frames",
      {1e-6, 10});
  options.integer("max-life", f.max_life, "FRAMES",
                  "frames after which a place's light is computed anew at the latest", {1, 1 << 20});
  options.choice<Lives>(
      "lives", f.lives, {{"midpoint", Lives::midpoint}, {"rate", Lives::rate}},
      "what decides when a place's light is computed anew: midpoint: at the ends of each --max-life, and in "
      "the middle of "
      "any two such frames where what is interpolated proves wrong; rate: as soon as the change that the "
      "next frame "
      "promises adds up to the accuracy (Gautron 2006; frame after frame, without looking back)");
  options.choice<TemporalGradients>("temporal-gradients", f.gradients,
                                    {{"interpolated", TemporalGradients::interpolated},
                                     {"extrapolated", TemporalGradients::extrapolated},
                                     {"none", TemporalGradients::none}},
                                    "how light changes from one record of a place to the next: straight to "
                                    "that one; as the first frame promised (with "
                                    "--lives rate); or not at all");
  options.choice<LookAhead>(
      "look-ahead", f.look_ahead,
      {{"reproject", LookAhead::reproject}, {"trace", LookAhead::trace}, {"none", LookAhead::none}},
      "with --lives rate: how the next frame's light is expected: what rays saw, moved (photons are counted "
      "again instead); by the same rays, or the same drawing, in that frame (the default of --estimate "
      "raster); or as it is");
  options.integer(
      "checks", f.checks, "N",
      "with --lives midpoint: halvings of --max-life that are made whatever they show; of radiance, "
      "whose noise hides its changes, 2 unless given",
      {0, 20});
  options.integer("fade", f.fade, "FRAMES",
                  "in which the first record of a place fades in and the last one out", {0, 1000});
  options.integer("photons", f.photons, "N", "paths from the lights, wherever photons are traced", {0, 1e12});
  options.integer("source-life", f.source_life, "FRAMES",
                  "with --estimate gather and raster: frames between those at which photons are traced; "
                  "between them, what they show is interpolated",
                  {1, 1 << 20});
}

void FilmOptions::resolve(const Options& given, Estimate estimate, bool of_radiance) {
  const auto refuse = [](const char* option, const std::string& message) {
    throw Error(ExitCode::usage, option, message);
  };
  if (estimate == Estimate::raster) {
    if (of_radiance)
      refuse("--estimate", "raster makes irradiance records alone; leave --kind radiance out, or give --estimate gather or hull");
    if (look_ahead == LookAhead::reproject) {
      if (given.given("look-ahead"))
        refuse(
            "--look-ahead",
            "reproject moves what gathered rays saw, and --estimate raster sends none; give trace or none");
      look_ahead = LookAhead::trace;
    }
  }
  if (lives == Lives::midpoint) {
    if (gradients == TemporalGradients::extrapolated)
      refuse("--temporal-gradients",
             "extrapolated goes with --lives rate, which looks one frame ahead; add that");
    if (gradients == TemporalGradients::none)
      refuse("--temporal-gradients",
             "none goes with --lives rate: midpoints are judged by what is interpolated; add that");
    if (given.given("look-ahead"))
      refuse("--look-ahead", "goes with --lives rate alone; add that, or leave it out");
  } else if (given.given("checks")) {
    refuse("--checks", "goes with --lives midpoint alone; leave it out");
  }
  if (gradients == TemporalGradients::extrapolated && look_ahead == LookAhead::none)
    refuse("--look-ahead", "none knows no gradients; use reproject or trace, or --temporal-gradients none");
  if (of_radiance && !given.given("checks")) checks = 2;
}

}  // namespace phos::inline temporal
