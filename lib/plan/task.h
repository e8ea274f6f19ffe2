// What a plan is asked for, and the commands that make it with given settings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "file/frames.h"
#include "plan/model.h"
#include "study/command.h"

namespace phos::inline plan {

/// The scene, and the quantities that are wanted.
struct PlanTask {
  std::string scene;                     ///< path
  std::vector<std::string> scene_words;  ///< options that every stage needs: "--environment", "sky.hdr"
  std::string camera;                    ///< "": the scene's first
  std::int64_t width = 0, height = 0;    ///< of the picture, pixels, both resolved
  float typical_m = 0;         ///< typical_distance_m() of the visible places; 0: radii are the usual ones
  double pixels_of_final = 1;  ///< the same pixel of the picture that is meant, in pixels of this one
  bool image = true, lux = false;
  std::string points;             ///< CSV of the sensors
  std::vector<std::string> grid;  ///< or the options of phos-sense that set them out; empty: there is a CSV
  bool gloss = false;             ///< something glossy is traced: --gloss-samples counts
  bool specular = false;          ///< mirrors or smooth glass are
  bool by_photons = false;        ///< records are made of photons alone (hull), not by gathered rays
  bool adaptive = false;          ///< the picture's records have adaptive zones (docs/methods.md#e)
  bool cached_direct = false;     ///< the picture's records hold light straight from the lamps too
  bool cached_gloss = false;      ///< radiance records show the gloss that harmonics hold
  std::optional<FrameRange> frames{};  ///< of a film; none: one picture
  double temporal_accuracy = 0.05;     ///< relative change of light that records of a film may miss

  /// Do the records hold light that references do not call indirect?
  bool records_hold_more() const { return cached_direct || cached_gloss; }
  /// Have the picture's records adaptive zones? Zones that hold direct light have them in any case.
  bool adaptive_zones() const { return adaptive || cached_direct; }
};

/// The files of gloss by records; empty names: gloss is traced.
struct GlossFiles {
  std::string lobes, records;
  bool empty() const { return records.empty(); }
};

/// One line of the pipeline.
struct PlanStage {
  std::string name;  ///< "photons"
  std::string what;  ///< its purpose, for people
  Command command;
};

/// Names of the files in the folder of a plan.
inline constexpr const char *kPlanPhotons = "light.photons", *kPlanRecords = "light.irradiance",
                            *kPlanLobes = "light.brdf", *kPlanGloss = "light.radiance",
                            *kPlanPicture = "image.exr", *kPlanFrames = "image-%04d.exr",
                            *kPlanPoints = "sensors.csv", *kPlanLux = "lux.csv";

/// The pipeline (of a film: records that live through its frames, by phos-temporal, and pictures of all
/// frames): photons, records (with cached_gloss also lobes and radiance records), and the picture or the
/// table of lux or both. `scene` stands in for the path of the task's, `folder` before every file that is
/// written; `seed` is given to each stage that draws.
std::vector<PlanStage> plan_stages(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                                   const std::string& folder, std::uint64_t seed);

// The single commands.
Command photons_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                        const std::string& out);
/// The lobes of glossy materials as harmonics.
Command lobes_command(const PlanTask& task, const std::string& scene, const std::string& out);
/// Radiance records on the gloss that the camera sees, with the accuracy and the rays of the other records.
Command gloss_records_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                              const std::string& photons, const GlossFiles& files);
/// Records where the camera looks, except on surfaces that radiance records cover.
Command view_records_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                             const std::string& photons, const std::string& out,
                             const GlossFiles& gloss = {});
/// Records where sensors are, added to the records of a file unless `add_to` is empty.
Command sensor_records_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                               const std::string& photons, const std::string& points,
                               const std::string& add_to, const std::string& out);
Command picture_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                        const std::string& cache, const std::string& out, const GlossFiles& gloss = {});
/// The same with indirect light alone.
Command indirect_picture_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                                 const std::string& cache, const std::string& out,
                                 const GlossFiles& gloss = {});
Command sense_command(const PlanTask& task, const Knobs& knobs, const std::string& scene,
                      const std::string& cache, const std::string& points, const std::string& out);
/// A table that sets out a grid's points: their places, and direct light with a ray to each lamp.
Command points_command(const PlanTask& task, const std::string& scene, const std::string& out);
Command reference_picture_command(const PlanTask& task, std::int64_t samples, const std::string& out);
Command reference_points_command(const PlanTask& task, std::int64_t samples, const std::string& points,
                                 const std::string& out);
/// The command with --seed.
Command seeded(Command command, std::uint64_t seed);

/// "100000", "0.4": a knob's value as an option has it.
std::string knob_word(const Knobs& knobs, Knob knob);

}  // namespace phos::inline plan
