#include "study/results/runs.h"

#include <algorithm>
#include <map>

#include "core/interrupt.h"
#include "core/progress.h"
#include "image/image.h"
#include "study/measure_lux.h"

namespace phos::inline study {

namespace {

ChainCost cost_of(const StudyWork& work, const StudyJournal& journal, std::size_t last) {
  ChainCost sum;
  for (const std::size_t i : work.stages.chain(last)) {
    const CommandCost& one = *journal.find(work.stages[i].id);
    sum.wall_s += one.wall_s, sum.cpu_s += one.cpu_s;
    sum.peak_bytes = std::max(sum.peak_bytes, static_cast<double>(one.peak_bytes));
    if (i != last) sum.file_bytes += static_cast<double>(one.file_bytes);
  }
  return sum;
}

/// One or two references of a kind (Image, LuxTable).
template <class T>
struct Pair {
  T first;
  std::optional<T> second;
  const T* other() const { return second ? &*second : nullptr; }
};
template <class T, class Read>
Pair<T> read_pair(const std::vector<std::string>& files, const Read& read) {
  Pair<T> pair{read(files[0]), std::nullopt};
  if (files.size() > 1) pair.second = read(files[1]);
  return pair;
}

}  // namespace

std::vector<RunResult> measure_runs(const StudyFile& study, const StudyWork& work,
                                    const StudyJournal& journal, const Failures& failures) {
  std::vector<RunResult> runs;
  for (const Job& job : work.jobs) {
    runs.push_back({job.setting, job.seed, {}, {}, ""});
    for (const auto& last : {job.picture, job.lux})
      if (last && failures.contains(*last)) runs.back().failed = failures.at(*last);
  }
  // References are large: one at a time.
  const auto measure = [&](const std::vector<ReferenceWork>& references,
                           std::optional<std::size_t> Job::*last, std::optional<Judgement> RunResult::*result,
                           const auto& index, const auto& judge_by) {
    std::map<std::size_t, std::size_t> owner;
    for (const Job& job : work.jobs)
      if (job.*last) {
        const auto known = owner.emplace(*(job.*last), job.setting).first;
        known->second = std::min(known->second, job.setting);
      }
    std::map<std::size_t, MeasuredError> measured;
    Progress progress("measure", owner.size(), "results");
    for (std::size_t r = 0; r < references.size(); ++r) {
      const auto judge = judge_by(references[r].files);
      for (std::size_t j = 0; j < work.jobs.size(); ++j) {
        const Job& job = work.jobs[j];
        if (!(job.*last) || index(work.settings[job.setting]) != r || failures.contains(*(job.*last)))
          continue;
        const std::size_t stage = *(job.*last);
        if (!measured.contains(stage)) {
          throw_if_interrupted();
          measured.emplace(stage, judge(work.stages[stage].command.output));
          progress.advance();
        }
        runs[j].*result = Judgement{measured.at(stage), cost_of(work, journal, stage), owner.at(stage)};
      }
    }
  };
  measure(
      work.pictures, &Job::picture, &RunResult::picture,
      [&](const Setting& s) { return s.scene * study.cameras.size() + s.camera; },
      [&](const std::vector<std::string>& files) {
        return [&study, pair = read_pair<Image>(files, read_image)](const std::string& path) {
          return measure_picture(read_image(path), pair.first, pair.other(),
                                 {study.layer, study.ignore_lamps});
        };
      });
  measure(
      work.lux, &Job::lux, &RunResult::lux, [](const Setting& s) { return s.scene; },
      [&](const std::vector<std::string>& files) {
        return [pair = read_pair<LuxTable>(files, read_lux)](const std::string& path) {
          return measure_lux(read_lux(path), pair.first, pair.other());
        };
      });
  std::stable_sort(runs.begin(), runs.end(), [](const RunResult& a, const RunResult& b) {
    return a.setting != b.setting ? a.setting < b.setting : a.seed < b.seed;
  });
  return runs;
}

}  // namespace phos::inline study
