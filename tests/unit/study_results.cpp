// What a study makes of its measurements, by hand.
#include "core/text/base64.h"
#include "core/text/markup.h"
#include "study/results/results.h"

#include <gtest/gtest.h>

#include <cmath>

#include "file/csv.h"
#include "study/html/text.h"
#include "study/results/csv.h"
#include "study/results/plots.h"
#include "study/results/runs.h"

namespace phos {
namespace {

/// Two values of photons and two of pixel samples, two seeds; errors and times as given for each setting.
struct Made {
  StudyFile study;
  CommandRunner runner{{}, "/nowhere"};
  StudyWork work;
  std::vector<RunResult> runs;

  static StudyFile make_study() {
    StudyFile s;
    s.scenes = {"a, b.glb"}, s.cameras = {""}, s.seeds = {5, 6}, s.sections = {"photons", "splat"};
    s.factors = {{"photons", "photons", {"10", "1000"}, {{"10"}, {"1000"}}, 0},
                 {"splat", "pixel-samples", {"1", "4"}, {{"1"}, {"4"}}, 0}};
    return s;
  }
  Made() : study(make_study()), work{expand_settings(study), Stages(study, runner, ""), {}, {}, {}} {}

  void add(std::size_t setting, std::size_t seed, double error, double seconds, double resolution = 0.01) {
    RunResult run{setting, seed, Judgement{}, {}, ""};
    MeasuredError& e = run.picture->error;
    e.quantity = "beauty", e.unit = "cd/m2", e.magnitude = 10, e.rmse = 10 * error, e.relative_rmse = error;
    e.relative_bias = -error / 2, e.relative_p99 = 3 * error, e.noise = resolution, e.resolution = resolution;
    run.picture->cost = {seconds, 2 * seconds, 1000 * seconds, 100};
    run.picture->owner = setting;
    runs.push_back(run);
  }
  StudyResults results() const { return summarise(study, work, runs); }
};

Made grid() {
  Made m;
  // Errors 0.4, 0.2 | 0.1, 0.2 and times 1, 4 | 2, 8, a tenth more or less with the seed.
  const double error[] = {0.4, 0.2, 0.1, 0.2}, seconds[] = {1, 4, 2, 8};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t seed = 0; seed < 2; ++seed)
      m.add(i, seed, error[i] * (seed == 0 ? 0.9 : 1.1), seconds[i] * (seed == 0 ? 1 : 1.2));
  return m;
}

TEST(StudyResults, MeansOverSeeds) {
  const StudyResults r = grid().results();
  ASSERT_EQ(r.points.size(), 4u);
  const Summary& s = *r.points[0].picture;
  EXPECT_NEAR(s.error.mean, 0.4, 1e-12);
  EXPECT_NEAR(s.seconds.mean, 1.1, 1e-12);
  EXPECT_NEAR(s.bias.mean, -0.2, 1e-12);
  EXPECT_NEAR(s.p99.mean, 1.2, 1e-12);
  EXPECT_NEAR(s.peak_bytes, 1200, 1e-9);
  // 0.36 and 0.44: t of one degree times 0.04, no error below 0.
  EXPECT_EQ(s.error.lo, 0);
  EXPECT_NEAR(s.error.hi, 0.4 + 12.7062 * 0.04, 1e-4);
}

TEST(StudyResults, FrontsOfTimeMemoryAndBytes) {
  const StudyResults r = grid().results();
  // (1.1, 0.4), (4.4, 0.2), (2.2, 0.1), (8.8, 0.2): the third beats the second and the fourth.
  const bool best[] = {true, false, true, false};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(r.points[i].picture->best_in_time, best[i]) << i;
    EXPECT_EQ(r.points[i].picture->best_in_memory, best[i]) << i;
    EXPECT_EQ(r.points[i].picture->best_in_bytes, i == 2) << i << ": all take the same";
  }
}

TEST(StudyResults, TimeMayBeTheProcessors) {
  Made m = grid();
  m.study.by_cpu = true;
  for (RunResult& run : m.runs) run.picture->cost.cpu_s = run.setting == 1 ? 0.5 : 2;
  const StudyResults r = m.results();
  EXPECT_TRUE(r.points[1].picture->best_in_time);
  EXPECT_FALSE(r.points[0].picture->best_in_time);
  // 2 -> 0.5 and 2 -> 2.
  EXPECT_NEAR(r.picture_effects[1].levels[1].seconds.mean, 0.5, 1e-12);
  EXPECT_EQ(r.points[1].picture->time.mean, 0.5);
}

TEST(StudyResults, EffectsAreRatios) {
  const StudyResults r = grid().results();
  ASSERT_EQ(r.picture_effects.size(), 2u);
  // Photons: 0.4 -> 0.1 and 0.2 -> 0.2; times two. Samples: 0.4 -> 0.2, 0.1 -> 0.2; times four.
  EXPECT_NEAR(r.picture_effects[0].levels[1].error.mean, 0.5, 1e-12);
  EXPECT_NEAR(r.picture_effects[0].levels[1].seconds.mean, 2, 1e-12);
  EXPECT_NEAR(r.picture_effects[1].levels[1].error.mean, 1, 1e-12);
  EXPECT_NEAR(r.picture_effects[1].levels[1].seconds.mean, 4, 1e-12);
  EXPECT_TRUE(r.lux_effects.empty());
}

TEST(StudyResults, WhatTheReferenceCannotTellIsSaid) {
  Made m;
  for (std::size_t i = 0; i < 4; ++i) m.add(i, 0, i < 2 ? 0.2 : 0.025, static_cast<double>(i + 1), 0.05);
  const StudyResults r = m.results();
  EXPECT_TRUE(r.points[1].picture->resolved);
  EXPECT_FALSE(r.points[3].picture->resolved);
  EXPECT_EQ(r.points[3].picture->told_error(), 0.05);
  const std::vector<std::string> said = doubts(r);
  ASSERT_EQ(said.size(), 1u);
  // To tell half the error the reference needs 4 times the samples.
  EXPECT_NE(said[0].find("2 of 4 settings"), std::string::npos) << said[0];
  EXPECT_NE(said[0].find("4 times as many samples"), std::string::npos) << said[0];
  // Of two that cannot be told apart from none, the cheaper one is on the front.
  EXPECT_TRUE(r.points[2].picture->best_in_time);
  EXPECT_FALSE(r.points[3].picture->best_in_time);
  EXPECT_TRUE(doubts(grid().results()).empty());
}

TEST(StudyResults, WhatIsNotFiniteIsSaid) {
  Made m = grid();
  m.runs[3].picture->error.non_finite = 7;
  const StudyResults r = m.results();
  EXPECT_EQ(r.points[1].picture->non_finite, 7u);
  ASSERT_EQ(doubts(r).size(), 1u);
  EXPECT_NE(doubts(r)[0].find("1 of 4 settings"), std::string::npos);
}

TEST(StudyResults, ASharedResultStandsOnce) {
  Made m = grid();
  for (RunResult& run : m.runs) run.picture->owner = run.setting - run.setting % 2;  // samples do not matter
  const StudyResults r = m.results();
  EXPECT_TRUE(r.points[0].own(&PointResult::picture));
  EXPECT_FALSE(r.points[1].own(&PointResult::picture));
  EXPECT_TRUE(r.points[1].picture);
  ASSERT_EQ(r.picture_effects.size(), 1u);
  EXPECT_EQ(r.picture_effects[0].factor, 0u);
}

TEST(StudyResults, TableHoldsARowForEachSetting) {
  Made m = grid();
  m.runs.pop_back(), m.runs.pop_back();
  m.runs.push_back({3, 0, {}, {}, "phos-photons: \"no\", it said"});
  const CsvTable table = parse_csv(results_csv(m.study, m.work, m.results()), "results.csv");
  ASSERT_EQ(table.rows.size(), 4u);
  const auto cell = [&](std::size_t row, const char* name) {
    return table.rows[row][table.column(name, "")];
  };
  EXPECT_EQ(cell(0, "scene"), "a, b.glb");
  EXPECT_EQ(cell(2, "photons.photons"), "1000");
  EXPECT_EQ(cell(2, "splat.pixel-samples"), "1");
  EXPECT_NEAR(table.number(2, table.column("picture_error", "")), 0.1, 1e-12);
  EXPECT_EQ(cell(2, "picture_best_in_time"), "1");
  EXPECT_EQ(cell(3, "picture_error"), "");
  EXPECT_EQ(cell(3, "failed"), "phos-photons: \"no\", it said");
}

TEST(StudyResults, PlotsShowPointsFrontAndEffects) {
  const Made m = grid();
  const std::vector<NamedPlot> plots = plots_of(m.study, m.work, m.results());
  ASSERT_EQ(plots.size(), 5u);
  EXPECT_EQ(plots[0].name, "picture-error-time");
  const Plot& p = plots[0].plot;
  ASSERT_EQ(p.lines.size(), 3u);
  EXPECT_EQ(p.lines[0].name, "front");
  EXPECT_EQ(p.lines[0].points.size(), 2u);
  EXPECT_EQ(p.lines[2].name, "photons 1000");
  EXPECT_FALSE(p.lines[2].joined);
  EXPECT_EQ(p.lines[2].points.size(), 2u);
  EXPECT_EQ(plots[3].name, "picture-effect-photons-photons");
}

TEST(StudyPage, PiecesOfHtml) {
  EXPECT_EQ(markup_text("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
  // RFC 4648, section 10.
  const char* const known[][2] = {{"", ""},
                                  {"f", "Zg=="},
                                  {"fo", "Zm8="},
                                  {"foo", "Zm9v"},
                                  {"foob", "Zm9vYg=="},
                                  {"fooba", "Zm9vYmE="},
                                  {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : known) EXPECT_EQ(base64(plain), coded);
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
  EXPECT_EQ(bytes_text(1536), "1.5 KiB");
  EXPECT_EQ(interval_text({0.5, 0.25, 0.75, 3}, 100), "50 (25 .. 75)");
  EXPECT_EQ(interval_text({0.5, NAN, NAN, 1}), "0.5");
  EXPECT_EQ(number_cell(NAN, "-"), "<td data-v=\"\">-</td>");
}

}  // namespace
}  // namespace phos
