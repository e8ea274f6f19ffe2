#include "study/results/results.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "study/results/pareto.h"
#include "study/results/runs.h"

namespace phos::inline study {

namespace {

using Result = std::optional<Judgement> RunResult::*;

std::optional<double> mean_of(const std::vector<const Judgement*>& runs,
                              std::optional<double> MeasuredError::*value) {
  double sum = 0, n = 0;
  for (const Judgement* run : runs)
    if (run->error.*value) sum += *(run->error.*value), ++n;
  return n > 0 ? std::optional(sum / n) : std::nullopt;
}

template <class Get>
std::vector<double> values_of(const std::vector<const Judgement*>& runs, const Get& get) {
  std::vector<double> values;
  for (const Judgement* run : runs) values.push_back(get(*run));
  return values;
}

Summary summary_of(const StudyFile& study, const std::vector<const Judgement*>& runs) {
  const double confidence = study.confidence;
  Summary s;
  s.owner = runs[0]->owner;
  s.unit = runs[0]->error.unit;
  s.noise = mean_of(runs, &MeasuredError::noise), s.resolution = mean_of(runs, &MeasuredError::resolution);
  s.stated = mean_of(runs, &MeasuredError::stated), s.inside = mean_of(runs, &MeasuredError::inside);
  s.psnr_db = mean_of(runs, &MeasuredError::psnr_db), s.ssim = mean_of(runs, &MeasuredError::ssim);
  const double of_error = mean_of(runs, &MeasuredError::rmse_stderr).value_or(0);
  const double of_bias = mean_of(runs, &MeasuredError::bias_stderr).value_or(0);
  s.error = mean_interval(values_of(runs, [](const Judgement& r) { return r.error.relative_rmse; }),
                          confidence, of_error);
  s.bias = mean_interval(values_of(runs, [](const Judgement& r) { return r.error.relative_bias; }),
                         confidence, of_bias);
  s.p99 = mean_interval(values_of(runs, [](const Judgement& r) { return r.error.relative_p99; }), confidence);
  s.seconds = mean_interval(values_of(runs, [](const Judgement& r) { return r.cost.wall_s; }), confidence);
  s.cpu_s = mean_interval(values_of(runs, [](const Judgement& r) { return r.cost.cpu_s; }), confidence);
  for (MeanInterval* i : {&s.error, &s.p99, &s.seconds, &s.cpu_s})
    if (std::isless(i->lo, 0)) i->lo = 0;
  s.time = study.by_cpu ? s.cpu_s : s.seconds;
  const auto n = static_cast<double>(runs.size());
  for (const Judgement* r : runs) {
    s.rmse += r->error.rmse / n, s.non_finite += r->error.non_finite;
    s.peak_bytes = std::max(s.peak_bytes, r->cost.peak_bytes), s.file_bytes += r->cost.file_bytes / n;
  }
  s.resolved = !s.resolution || s.error.mean > *s.resolution;
  return s;
}

/// Marks the fronts among the points of each scene and camera.
void mark_fronts(const StudyWork& work, std::vector<PointResult>& points,
                 std::optional<Summary> PointResult::*kind) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Summary*>> views;
  for (PointResult& p : points) {
    const Setting& s = work.settings[p.setting];
    if (p.own(kind)) views[{s.scene, s.camera}].push_back(&*(p.*kind));
  }
  const auto mark = [](const std::vector<Summary*>& all, const auto& cost, bool Summary::*best) {
    std::vector<CostAndError> points_of_view;
    for (const Summary* s : all) points_of_view.push_back({cost(*s), s->told_error()});
    for (const std::size_t i : pareto_front(points_of_view)) all[i]->*best = true;
  };
  for (const auto& [view, all] : views) {
    mark(
        all, [](const Summary& s) { return s.time.mean; }, &Summary::best_in_time);
    mark(
        all, [](const Summary& s) { return s.peak_bytes; }, &Summary::best_in_memory);
    mark(
        all, [](const Summary& s) { return s.file_bytes; }, &Summary::best_in_bytes);
  }
}

std::vector<FactorEffect> effects_of(const StudyFile& study, const StudyWork& work,
                                     const std::vector<RunResult>& runs, Result kind) {
  std::vector<Trial> trials;
  for (const RunResult& run : runs) {
    if (!(run.*kind) || (run.*kind)->owner != run.setting) continue;
    const Judgement& j = *(run.*kind);
    Trial trial{work.settings[run.setting].level, run.seed, j.error.relative_rmse,
                study.by_cpu ? j.cost.cpu_s : j.cost.wall_s, j.error.resolution.value_or(0)};
    trial.level.push_back(work.settings[run.setting].scene),
        trial.level.push_back(work.settings[run.setting].camera);
    trials.push_back(std::move(trial));
  }
  std::vector<FactorEffect> effects;
  if (trials.empty()) return effects;
  for (std::size_t f = 0; f < study.factors.size(); ++f) {
    FactorEffect effect{f, main_effect(trials, f, study.factors[f].words.size(), study.confidence)};
    std::size_t pairs = 0;  // but for the first level, which pairs with itself
    for (std::size_t i = 1; i < effect.levels.size(); ++i) pairs += effect.levels[i].pairs;
    if (pairs > 0) effects.push_back(std::move(effect));
  }
  return effects;
}

void doubt(const StudyResults& results, std::optional<Summary> PointResult::*kind, const char* name,
           std::vector<std::string>& sentences) {
  std::size_t faint = 0, all = 0, unknown = 0, broken = 0;
  double worst = 1;
  for (const PointResult& p : results.points) {
    if (!p.own(kind)) continue;
    const Summary& s = *p.own(kind);
    ++all;
    if (!s.resolution) ++unknown;
    if (s.non_finite > 0) ++broken;
    if (s.resolved) continue;
    ++faint;
    if (s.error.mean > 0) worst = std::max(worst, *s.resolution / s.error.mean);
  }
  if (unknown > 0)
    sentences.push_back(text(
        "the reference of ", name,
        " does not state its noise, and errors include this noise; give a second reference of another seed"));
  if (broken > 0)
    sentences.push_back(text("the ", name, " results of ", broken, " of ", all,
                             " settings have values that are not finite; they are left out of errors"));
  if (faint == 0) return;
  // Its variance falls as 1 / samples, and the resolution is the root of a deviation of a square.
  const double more = worst * worst;
  sentences.push_back(
      text("the reference cannot tell the ", name, " error of ", faint, " of ", all,
           " settings from none; give [reference] ",
           more > 1 ? text("at least ", std::ceil(more), " times as many samples") : "more samples"));
}

}  // namespace

StudyResults summarise(const StudyFile& study, const StudyWork& work, std::vector<RunResult> runs) {
  StudyResults results;
  results.runs = std::move(runs);
  const auto summary = [&](std::size_t setting, Result kind) -> std::optional<Summary> {
    std::vector<const Judgement*> found;
    for (const RunResult& run : results.runs)
      if (run.setting == setting && run.*kind) found.push_back(&*(run.*kind));
    if (found.empty()) return std::nullopt;
    return summary_of(study, found);
  };
  for (std::size_t i = 0; i < work.settings.size(); ++i) {
    PointResult point{i, summary(i, &RunResult::picture), summary(i, &RunResult::lux), ""};
    for (const RunResult& run : results.runs)
      if (run.setting == i && !run.failed.empty()) point.failed = run.failed;
    results.points.push_back(std::move(point));
  }
  mark_fronts(work, results.points, &PointResult::picture);
  mark_fronts(work, results.points, &PointResult::lux);
  results.picture_effects = effects_of(study, work, results.runs, &RunResult::picture);
  results.lux_effects = effects_of(study, work, results.runs, &RunResult::lux);
  return results;
}

std::vector<std::string> doubts(const StudyResults& results) {
  std::vector<std::string> sentences;
  doubt(results, &PointResult::picture, "picture", sentences);
  doubt(results, &PointResult::lux, "lux", sentences);
  return sentences;
}

}  // namespace phos::inline study
