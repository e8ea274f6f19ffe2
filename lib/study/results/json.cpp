#include "study/results/json.h"

#include "core/options.h"
#include "study/results/results.h"
#include "study/results/runs.h"

namespace phos::inline study {

namespace {

Json to_json(const MeanInterval& i) {
  Json j;
  j["mean"] = i.mean, j["lo"] = i.lo, j["hi"] = i.hi, j["n"] = i.n;
  return j;
}

Json to_json(const Summary& s) {
  Json j;
  j["error"] = to_json(s.error), j["bias"] = to_json(s.bias), j["p99"] = to_json(s.p99);
  j["rmse"] = s.rmse, j["unit"] = s.unit, j["resolved"] = s.resolved, j["non_finite"] = s.non_finite;
  for (const auto& [name, value] : {std::pair{"reference_noise", s.noise},
                                    {"resolution", s.resolution},
                                    {"stated", s.stated},
                                    {"inside", s.inside},
                                    {"psnr_db", s.psnr_db},
                                    {"ssim", s.ssim}})
    if (value) j[name] = *value;
  j["seconds"] = to_json(s.seconds), j["cpu_s"] = to_json(s.cpu_s);
  j["peak_bytes"] = s.peak_bytes, j["file_bytes"] = s.file_bytes;
  j["best_in_time"] = s.best_in_time, j["best_in_memory"] = s.best_in_memory,
  j["best_in_bytes"] = s.best_in_bytes;
  return j;
}

Json to_json(const StudyFile& study, const std::vector<FactorEffect>& effects) {
  Json all = Json::Array{};
  for (const FactorEffect& e : effects) {
    Json factor;
    factor["factor"] = study.factors[e.factor].name();
    Json levels = Json::Array{};
    for (std::size_t i = 0; i < e.levels.size(); ++i) {
      const LevelEffect& l = e.levels[i];
      Json level;
      level["value"] = study.factors[e.factor].labels[i];
      level["error_ratio"] = to_json(l.error), level["seconds_ratio"] = to_json(l.seconds);
      level["pairs"] = l.pairs, level["faint"] = l.faint, level["left_out"] = l.left_out;
      levels.push_back(std::move(level));
    }
    factor["levels"] = std::move(levels);
    all.push_back(std::move(factor));
  }
  return all;
}

Json commands(const StudyWork& work, const StudyJournal& journal, std::size_t last) {
  Json all = Json::Array{};
  for (const std::size_t i : work.stages.chain(last)) {
    const StageRun& stage = work.stages[i];
    Json one;
    one["stage"] = stage.section, one["command"] = shell_line(stage.command);
    if (const CommandCost* cost = journal.find(stage.id)) {
      one["wall_s"] = cost->wall_s, one["cpu_s"] = cost->cpu_s;
      one["peak_bytes"] = cost->peak_bytes, one["file_bytes"] = cost->file_bytes;
    }
    all.push_back(std::move(one));
  }
  return all;
}

Json setting_json(const StudyFile& study, const Setting& s) {
  Json j;
  j["scene"] = study.scenes[s.scene], j["camera"] = study.cameras[s.camera];
  for (std::size_t i = 0; i < study.factors.size(); ++i)
    j["values"][study.factors[i].name()] = study.factors[i].labels[s.level[i]];
  return j;
}

Json references_json(const StudyWork& work, const StudyJournal& journal,
                     const std::vector<ReferenceWork>& references) {
  Json all = Json::Array{};
  for (const ReferenceWork& r : references) {
    Json one;
    Json files = Json::Array{}, made = Json::Array{};
    for (const std::string& file : r.files) files.push_back(file);
    for (const std::size_t i : r.stages) {
      const Json lines = commands(work, journal, i);
      for (const Json& line : lines.as_array()) made.push_back(line);
    }
    one["files"] = std::move(files), one["commands"] = std::move(made);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

Json results_json(const StudyFile& study, const StudyWork& work, const StudyJournal& journal,
                  const StudyResults& results) {
  Json j;
  j["version"] = version(), j["study"] = study.path, j["confidence"] = study.confidence;
  j["time"] = study.by_cpu ? "cpu" : "wall";
  j["layer"] = study.layer, j["ignore_lamps"] = study.ignore_lamps, j["threads"] = study.threads;
  j["method"] =
      "error: root mean square difference over the mean of the reference, without the reference's noise; "
      "intervals: Student's t over seeds, with the "
      "reference's standard error in quadrature; effects: ratios of trials that are alike but for one "
      "factor, averaged by seed, Student's t over "
      "seeds; seconds: wall time of every stage, each once";
  Json seeds = Json::Array{};
  for (const std::int64_t s : study.seeds) seeds.push_back(s);
  j["seeds"] = std::move(seeds);
  j["references"]["picture"] = references_json(work, journal, work.pictures);
  j["references"]["lux"] = references_json(work, journal, work.lux);
  Json points = Json::Array{};
  for (const PointResult& p : results.points) {
    Json point = setting_json(study, work.settings[p.setting]);
    point["point"] = p.setting;
    if (p.picture) point["picture"] = to_json(*p.picture);
    if (p.lux) point["lux"] = to_json(*p.lux);
    if (!p.failed.empty()) point["failed"] = p.failed;
    points.push_back(std::move(point));
  }
  j["points"] = std::move(points);
  Json runs = Json::Array{};
  for (const RunResult& r : results.runs) {
    Json run;
    run["point"] = r.setting, run["seed"] = study.seeds[r.seed];
    if (r.picture) run["picture"] = to_json(r.picture->error);
    if (r.lux) run["lux"] = to_json(r.lux->error);
    for (const Job& job : work.jobs) {
      if (job.setting != r.setting || job.seed != r.seed) continue;
      if (job.picture) run["picture_commands"] = commands(work, journal, *job.picture);
      if (job.lux) run["lux_commands"] = commands(work, journal, *job.lux);
    }
    runs.push_back(std::move(run));
  }
  j["runs"] = std::move(runs);
  j["effects"]["picture"] = to_json(study, results.picture_effects);
  j["effects"]["lux"] = to_json(study, results.lux_effects);
  Json sentences = Json::Array{};
  for (const std::string& s : doubts(results)) sentences.push_back(s);
  j["doubts"] = std::move(sentences);
  return j;
}

}  // namespace phos::inline study
