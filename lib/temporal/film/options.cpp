#include "temporal/film/options.h"

#include "core/error.h"

namespace phos::inline temporal {

void declare_options(Options& options, FilmOptions& f) {
  options.section("Time");
  options.number(
      "temporal-accuracy", f.temporal_accuracy, "FRACTION",
      "relative change of light over time that may be missed; smaller: light is computed at more frames",
      {1e-6, 10});
  options.integer("max-life", f.max_life, "FRAMES",
                  "largest number of frames between two computations of the light at a place", {1, 1 << 20});
  options.choice<Lives>("lives", f.lives, {{"midpoint", Lives::midpoint}, {"rate", Lives::rate}},
                        "rule for the frames at which the light at a place is computed: midpoint: at the "
                        "ends of each --max-life, and in the middle of two such frames where interpolation "
                        "proves wrong; rate: as soon as the change that the next frame predicts adds up to "
                        "the accuracy (Gautron 2006; frame after frame, without looking back)");
  options.choice<TemporalGradients>(
      "temporal-gradients", f.gradients,
      {{"interpolated", TemporalGradients::interpolated},
       {"extrapolated", TemporalGradients::extrapolated},
       {"none", TemporalGradients::none}},
      "change of light from one record of a place to the next: interpolated: straight to the next record; "
      "extrapolated: as the first frame predicted (with --lives rate); none: no change");
  options.choice<LookAhead>(
      "look-ahead", f.look_ahead,
      {{"reproject", LookAhead::reproject}, {"trace", LookAhead::trace}, {"none", LookAhead::none}},
      "with --lives rate: method that predicts the light of the next frame: reproject: the hits of the rays, "
      "moved (photons are counted again instead); trace: the same rays, or the same drawing, in that frame "
      "(the default of --estimate raster); none: the light of this frame");
  options.integer("checks", f.checks, "N",
                  "with --lives midpoint: halvings of --max-life that are always made; 0: none. Radiance has "
                  "2 unless given, as its noise hides its changes",
                  {0, 20});
  options.integer("fade", f.fade, "FRAMES",
                  "number of frames over which the first record of a place fades in and the last one fades "
                  "out; 0: no fading",
                  {0, 1000});
  options.integer("photons", f.photons, "N",
                  "number of paths from the lights, each time that photons are traced", {0, 1e12});
  options.integer("source-life", f.source_life, "FRAMES",
                  "with --estimate gather or raster: frames from one tracing of photons to the next; light "
                  "of the photons is interpolated between",
                  {1, 1 << 20});
}

void FilmOptions::resolve(const Options& given, Estimate estimate, bool of_radiance) {
  const auto refuse = [](const char* option, const std::string& message) {
    throw Error(ExitCode::usage, option, message);
  };
  if (estimate == Estimate::raster && look_ahead == LookAhead::reproject) {
    if (given.given("look-ahead"))
      refuse("--look-ahead",
             "reproject moves what gathered rays saw, and --estimate raster sends none; give trace or none");
    look_ahead = LookAhead::trace;
  }
  if (lives == Lives::midpoint) {
    if (gradients == TemporalGradients::extrapolated)
      refuse("--temporal-gradients",
             "extrapolated needs --lives rate, which looks one frame ahead; add that option");
    if (gradients == TemporalGradients::none)
      refuse("--temporal-gradients",
             "none needs --lives rate, as --lives midpoint judges by interpolation; add --lives rate");
    if (given.given("look-ahead"))
      refuse("--look-ahead", "needs --lives rate; add that option, or leave this one out");
  } else if (given.given("checks")) {
    refuse("--checks", "needs --lives midpoint; leave it out");
  }
  if (gradients == TemporalGradients::extrapolated && look_ahead == LookAhead::none)
    refuse("--look-ahead",
           "none has no gradients to extrapolate; use reproject or trace, or --temporal-gradients none");
  if (of_radiance && !given.given("checks")) checks = 2;
}

}  // namespace phos::inline temporal
