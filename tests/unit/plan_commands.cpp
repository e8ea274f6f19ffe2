// The stages of a plan, and the command lines of their programs.
#include <gtest/gtest.h>

#include "plan/calibration.h"
#include "plan/film.h"
#include "support/synthetic_pilot.h"

namespace phos::test {
namespace {

TEST(StudyPlan, GlossByRecordsHasItsStages) {
  PlanTask task = picture();
  task.cached_gloss = true, task.gloss = true;
  Knobs k{};
  k.fill(16);
  const std::vector<PlanStage> stages = plan_stages(task, k, "s", "d", 3);
  ASSERT_EQ(stages.size(), 5u);
  EXPECT_EQ(shell_line(stages[1].command), "phos-brdf s --seed 3 -o d/light.brdf");
  EXPECT_EQ(shell_line(stages[2].command),
            "phos-radiance s d/light.brdf d/light.photons --place view --width 200 --height 150 --estimate "
            "gather --accuracy 16 --rays 16 --seed 3 -o d/light.radiance");
  EXPECT_EQ(shell_line(stages[3].command)
                .rfind("phos-irradiance s d/light.radiance d/light.brdf d/light.photons ", 0),
            0u)
      << shell_line(stages[3].command);
  EXPECT_EQ(shell_line(stages[4].command)
                .rfind("phos-splat s d/light.irradiance d/light.radiance d/light.brdf ", 0),
            0u);
}

TEST(StudyPlan, AFilmHasRecordsThatLive) {
  PlanTask task = picture();
  task.frames = FrameRange{2, 11}, task.temporal_accuracy = 0.02;
  Knobs k{};
  k.fill(16);
  const std::vector<PlanStage> stages = plan_stages(task, k, "s", "d", 0);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(shell_line(stages[0].command),
            "phos-temporal s --photons 16 --temporal-accuracy 0.02 --place view --width 200 --height 150 "
            "--frames 2:11 --estimate gather --accuracy 16 --rays 16 -o d/light.irradiance");
  EXPECT_NE(shell_line(stages[1].command).find("--frames 2:11"), std::string::npos);
  EXPECT_EQ(stages[1].command.output, "d/image-%04d.exr");
  task.cached_gloss = true;
  const std::vector<PlanStage> glossy = plan_stages(task, k, "s", "d", 0);
  ASSERT_EQ(glossy.size(), 4u);
  EXPECT_EQ(glossy[1].command.tool, "phos-temporal");
  EXPECT_NE(shell_line(glossy[1].command).find(" --kind radiance "), std::string::npos);

  // The pilot sees the first frame; its seconds are those of one frame.
  const PlanTask still = still_of(task);
  EXPECT_FALSE(still.frames);
  EXPECT_EQ(still.scene_words, (std::vector<std::string>{"--frame", "2"}));
  EXPECT_TRUE(still_of(picture()).scene_words.empty());
  const PlanModel one = synthetic_time();
  PlanModel film = one, none = one;
  stretch_to_film(film, task), stretch_to_film(none, picture());
  for (std::size_t part = 0; part < one.part.size(); ++part) {
    const double times = one.part[part].first == "picture" ? 10 : std::max(1.0, 10 * calibration::kFilmLight);
    EXPECT_DOUBLE_EQ(film.part[part].second.best(k), times * one.part[part].second.best(k));
    EXPECT_DOUBLE_EQ(none.part[part].second.best(k), one.part[part].second.best(k));
  }
}

/// Edge samples are counted in all by a plan, and beside the others by phos-splat, of which it asks for whole
/// pairs.
TEST(StudyPlan, ThePictureSharesShadowRaysAndSamplesEdges) {
  PlanTask task = picture();
  task.typical_m = 25;
  Knobs k{};
  k[at(K::pixel_samples)] = 4, k[at(K::edge_samples)] = 64, k[at(K::light_rays)] = 32;
  k[at(K::accuracy)] = 0.4, k[at(K::rays)] = 256;
  EXPECT_EQ(
      shell_line(picture_command(task, k, "s.glb", "c", "i.exr")),
      "phos-splat s.glb c --width 200 --height 150 --pixel-samples 4 --edge-samples 60 --direct interleaved "
      "--light-samples 32 -o i.exr");
  EXPECT_EQ(shell_line(indirect_picture_command(task, k, "s.glb", "c", "i.exr")),
            "phos-splat s.glb c --width 200 --height 150 --pixel-samples 4 --edge-samples 60 --direct none "
            "--gloss-samples 0 --layers indirect -o i.exr");
  k[at(K::pixel_samples)] = 1, k[at(K::edge_samples)] = 2;
  EXPECT_NE(shell_line(picture_command(task, k, "s.glb", "c", "i.exr")).find("--edge-samples 2 "),
            std::string::npos);
  k[at(K::pixel_samples)] = 4, k[at(K::edge_samples)] = 4;
  EXPECT_EQ(shell_line(picture_command(task, k, "s.glb", "c", "i.exr")).find("--edge-samples"),
            std::string::npos);
  for (const auto& [accuracy, least] : {std::pair{0.4, "--min-radius 1.25 "}, {0.2, "--min-radius 0.625 "}}) {
    k[at(K::accuracy)] = accuracy;
    const std::string records = shell_line(view_records_command(task, k, "s.glb", "p", "c"));
    EXPECT_NE(records.find(least), std::string::npos) << records;
  }
  task.cached_direct = true;  // whose zones are adaptive
  EXPECT_EQ(shell_line(view_records_command(task, k, "s.glb", "p", "c")).find("--min-radius"),
            std::string::npos);
}

/// The zones of the picture's records alone, which the processor draws faster than OpenGL.
TEST(StudyPlan, AdaptiveRecordsAreMadeAndDrawn) {
  PlanTask task = picture();
  task.typical_m = 25;
  Knobs k{};
  k.fill(16);
  k[at(K::accuracy)] = 0.4;
  for (const bool adaptive : {false, true}) {
    task.adaptive = adaptive;
    const auto has = [&](const Command& command, const char* words) {
      EXPECT_EQ(shell_line(command).find(words) != std::string::npos, adaptive) << shell_line(command);
    };
    has(view_records_command(task, k, "s", "p", "r"), " --footprint adaptive --min-radius 1.25 ");
    has(picture_command(task, k, "s", "r", "i"), " --splat cpu ");
    has(indirect_picture_command(task, k, "s", "r", "i"), " --splat cpu ");
    const std::vector<PlanStage> stages = plan_stages(task, k, "s", "d", 0);
    EXPECT_EQ(stages[1].what.find("adaptive") != std::string::npos, adaptive) << stages[1].what;
    EXPECT_EQ(shell_line(gloss_records_command(task, k, "s", "p", {"l", "g"})).find("--footprint"),
              std::string::npos);
  }
}

TEST(StudyPlan, LuxAndBoth) {
  PlanTask task = picture();
  task.lux = true, task.grid = {"--grid", "0.5", "--height", "0.8"};
  Knobs k{};
  k.fill(16);
  const auto both = plan_stages(task, k, "s", "d", 0);
  ASSERT_EQ(both.size(), 6u);
  EXPECT_EQ(shell_line(both[0].command),
            "phos-sense s --direct-only --light-samples 1 --grid 0.5 --height 0.8 -o d/sensors.csv");
  EXPECT_EQ(shell_line(both[3].command),
            "phos-irradiance s d/light.photons --at d/sensors.csv --place given --add-to d/light.irradiance "
            "-o d/light.irradiance");
  EXPECT_EQ(shell_line(both[5].command),
            "phos-sense s d/light.irradiance --points d/sensors.csv --light-samples 16 -o d/lux.csv");
  task.image = false, task.grid = {}, task.points = "p.csv";
  const auto lux = plan_stages(task, k, "s", "d", 3);
  ASSERT_EQ(lux.size(), 3u);
  EXPECT_EQ(shell_line(lux[1].command),
            "phos-irradiance s d/light.photons --at p.csv --place given --estimate gather --accuracy 16 "
            "--rays 16 --seed 3 -o d/light.irradiance");
}

}  // namespace
}  // namespace phos::test
