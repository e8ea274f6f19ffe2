#include "plan/pilot/runs.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/csv.h"
#include "file/write_text.h"
#include "plan/calibration.h"
#include "plan/plan.h"

namespace phos::inline plan {
namespace {

constexpr std::uint64_t kPipelineSeed = 1, kReferenceSeed = 101, kCountSeed = 11;

/// Standard deviation of one time, s.
double doubt_of_time(double seconds) {
  return calibration::kRunTimeDoubt * seconds + calibration::kRunTimeLeast;
}

std::vector<std::string> quiet(std::vector<std::string> words) {
  words.insert(words.end(), {"--quiet", "--progress", "never"});
  return words;
}

double number(const Json& stats, const char* key) {
  const Json* v = stats.find(key);
  return v && v->is_number() ? v->as_number() : 0;
}

std::vector<double> less(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

}  // namespace

PilotRuns::PilotRuns(const PlanTask& task, const PilotOptions& options)
    : task_(task),
      small_(task),
      options_(options),
      runner_(quiet(options.common)),
      judges_(options.references) {
  const double pixels = static_cast<double>(task.width) * static_cast<double>(task.height);
  const double scale = std::min(1.0, std::sqrt(kPilotPixels / std::max(pixels, 1.0)));
  small_.width = std::max<std::int64_t>(1, std::llround(scale * static_cast<double>(task.width)));
  small_.height = std::max<std::int64_t>(1, std::llround(scale * static_cast<double>(task.height)));
  small_.pixels_of_final = scale;
  if (task.lux) set_out_sensors();
}

void PilotRuns::set_out_sensors() {
  PlanTask all = task_;
  if (all.grid.empty()) all.grid = {"--points", task_.points};
  require(points_command(all, task_.scene, folder_.file("all.csv")));
  const std::string all_path = folder_.file("all.csv");
  write_text(folder_.file("some.csv"),
             thinned_rows(read_text(all_path), all_path, kSensorColumns, kPilotSensors, &sensors_));
  if (sensors_ == 0)
    throw Error(ExitCode::bad_input, task_.points.empty() ? "--grid" : task_.points,
                "there is no sensor; give other points, or a finer grid");
}

Knobs PilotRuns::sized(Knobs knobs) const {
  knobs[at(Knob::pixels)] = pixels_of(small_);
  return knobs;
}

std::string PilotRuns::name(const char* kind, std::size_t which) const {
  return folder_.file(text(kind, which));
}

CommandRun PilotRuns::require(const Command& command) const {
  CommandRun run = runner_.require(command);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  if (seconds > options_.most_seconds.value_or(HUGE_VAL)) throw PilotTooLong{seconds};
  options_.say(text(shell_line(command), ": ", duration(run.wall_s)));
  return run;
}

CommandRun PilotRuns::timed(const std::string& part, const Knobs& knobs, const Command& command) {
  CommandRun run = require(command);
  times_[part].push_back({knobs, run.wall_s, doubt_of_time(run.wall_s)});
  return run;
}

double PilotRuns::records_run(const std::string& part, Knob count, const Knobs& knobs,
                              const Command& command) {
  const CommandRun run = require(command);
  Knobs k = knobs;
  k[at(count)] = number(run.stats, "records_made");
  const double coarse = number(run.stats, "seconds.coarse records"), rest = run.wall_s - coarse;
  times_["coarse records"].push_back({k, coarse, doubt_of_time(coarse)});
  times_[part].push_back({k, rest, doubt_of_time(rest)});
  return k[at(count)];
}

GlossFiles PilotRuns::gloss_files(const std::string& records) const {
  return task_.cached_gloss ? GlossFiles{folder_.file("lobes"), records + "-gloss"} : GlossFiles{};
}

double PilotRuns::gloss_records_run(const PlanTask& task, const Knobs& knobs, const std::string& photons,
                                    const GlossFiles& files, std::uint64_t seed) {
  if (files.empty()) return 0;
  if (times_["lobes"].empty()) timed("lobes", knobs, lobes_command(task, task.scene, files.lobes));
  return records_run("gloss records", Knob::gloss_records, knobs,
                     seeded(gloss_records_command(task, knobs, task.scene, photons, files), seed));
}

ReferenceRun PilotRuns::references(bool lux, double samples) {
  ReferenceRun out;
  Json stats[2];
  const auto n = static_cast<std::int64_t>(samples);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string path = name(lux ? "reference-lux" : "reference", i);
    const Command command = lux ? reference_points_command(small_, n, folder_.file("some.csv"), path)
                                : reference_picture_command(small_, n, path);
    const CommandRun run = require(seeded(command, options_.seed + kReferenceSeed + i));
    out.seconds += 0.5 * run.wall_s;
    stats[i] = run.stats;
    if (lux)
      judges_->illuminance_lx[i] = lux_of(path, "illuminance_lx");
    else
      judges_->picture[i] = read_image(path);
  }
  const auto values = [&](std::size_t i) {
    return lux ? judges_->illuminance_lx[i] : tiled_values(judges_->picture[i], "", judges_->picture[0]);
  };
  const std::vector<double> a = values(0), b = values(1);
  double& mean = judges_->of(lux).mean;
  mean = mean_magnitude(a, b);
  if (!(mean > 0))
    throw Error(
        ExitCode::bad_input, task_.scene,
        lux ? "no light reaches any sensor; turn them, or look at the lamps with phos-scene"
            : "nothing that the camera sees is lit; choose another --camera, or look at the lamps with "
              "phos-scene");
  const std::size_t components = lux ? 1 : 3;
  out.places = static_cast<double>(a.size() / components);
  const double all = lux ? out.places : pixels_of(small_);
  for (const Json& of_one : stats) out.doubts.add(of_one, all);
  // The mean of d^2 / 2 deviates by the root of twice the mean of products of the two errors: see
  // ReferenceCost.
  out.variance = separate(a, b, a, b, components).over(mean).noise2_sigma * std::sqrt(out.places / 2);
  return out;
}

void PilotRuns::make_caches(const Knobs& knobs) {
  made_ = sized(knobs);
  const bool traced = !traced_.emplace(knobs[at(Knob::photons)], true).second;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::uint64_t seed = options_.seed + kPipelineSeed + i;
    const std::string photons = name("photons-", i) + "-" + knob_word(knobs, Knob::photons);
    if (!traced) timed("photons", made_, seeded(photons_command(small_, knobs, small_.scene, photons), seed));
    if (task_.image) {
      const GlossFiles gloss = gloss_files(name("view-", i));
      gloss_records_run(small_, made_, photons, gloss, seed);
      records_run(
          "records", Knob::records, made_,
          seeded(view_records_command(small_, knobs, small_.scene, photons, name("view-", i), gloss), seed));
    }
    if (!task_.lux) continue;
    Knobs k = made_;
    k[at(Knob::pixels)] = 0;
    const Command at_sensors =
        seeded(sensor_records_command(small_, knobs, small_.scene, photons, folder_.file("some.csv"), "",
                                      name("sensors-", i)),
               seed);
    // With a picture these are added to its records: their coarse cache is the picture's, made anew.
    records_run("records", Knob::records, k, at_sensors);
  }
}

SeparatedLayers PilotRuns::pictures(const Knobs& knobs, bool direct) {
  Image made[2];
  const bool whole = direct || task_.records_hold_more();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto draw = whole ? picture_command : indirect_picture_command;
    const Command command = seeded(draw(small_, knobs, small_.scene, name("view-", i), name("picture-", i),
                                        gloss_files(name("view-", i))),
                                   options_.seed + kPipelineSeed + i);
    if (direct)
      timed("picture", sized(knobs), command);
    else
      require(command);
    made[i] = read_image(command.output);
  }
  const auto layer = [&](const Image& image, const char* name) {
    return tiled_values(image, name, judges_->picture[0]);
  };
  const auto judged = [&](auto&& values) {
    return separate(values(made[0]), values(made[1]), values(judges_->picture[0]),
                    values(judges_->picture[1]), kTileValues)
        .over(judges_->image.mean);
  };
  SeparatedLayers out;
  out.indirect = judged([&](const Image& image) { return layer(image, "indirect"); });
  if (!whole) return out;
  out.whole = judged([&](const Image& image) { return layer(image, ""); });
  out.direct = judged([&](const Image& image) { return layer(image, "direct"); });
  out.gloss = judged([&](const Image& image) {
    return less(less(layer(image, ""), layer(image, "indirect")), layer(image, "direct"));
  });
  if (!task_.records_hold_more()) return out;
  // Records hold more than the reference calls indirect: bias is of all light, and put down to them.
  const Separated noise = out.indirect;
  out.indirect = out.whole;
  out.indirect.noise2 = noise.noise2, out.indirect.noise2_sigma = noise.noise2_sigma;
  return out;
}

double PilotRuns::time_pictures(const Knobs& few, const Knobs& more) {
  Image full[2], small[2];
  for (std::size_t i = 0; i < 2; ++i) {
    Knobs k = i == 0 ? few : more;
    k[at(Knob::pixels)] = pixels_of(task_);
    const auto drawn = [&](auto&& draw, const PlanTask& task) {
      return seeded(
          draw(task, k, task.scene, name("count-", 0), name("picture-", i), gloss_files(name("count-", 0))),
          options_.seed);
    };
    const Command command = drawn(picture_command, task_);
    timed("picture", k, command);
    full[i] = read_image(command.output);
    require(drawn(indirect_picture_command, small_));
    small[i] = read_image(command.output);
  }
  const double of_full = differs_within_pixels(full[0], full[1], "indirect"),
               of_small = differs_within_pixels(small[0], small[1], "indirect");
  if (!(growth() > 1) || !(of_full > 0) || !(of_small > 0)) return 1;
  return std::log(of_small / of_full) / std::log(growth());
}

std::vector<double> PilotRuns::lux_of(const std::string& path, const char* column) const {
  const CsvTable table = parse_csv(read_text(path), path);
  const std::size_t c = table.column(column, path);
  std::vector<double> out;
  for (std::size_t i = 0; i < table.rows.size(); ++i) out.push_back(table.number(i, c));
  return out;
}

SeparatedLayers PilotRuns::lux_tables(const Knobs& knobs) {
  std::vector<double> all[2], indirect[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const Command command = seeded(sense_command(small_, knobs, small_.scene, name("sensors-", i),
                                                 folder_.file("some.csv"), name("lux-", i)),
                                   options_.seed + kPipelineSeed + i);
    timed("lux", knobs, command);
    all[i] = lux_of(command.output, "E_lx"), indirect[i] = lux_of(command.output, "indirect_lx");
  }
  // The reference does not tell direct from indirect light: bias is of both, and put down to the latter.
  SeparatedLayers out;
  const std::vector<double>*p = &judges_->illuminance_lx[0], *q = &judges_->illuminance_lx[1];
  out.whole = separate(all[0], all[1], *p, *q, 1).over(judges_->lux.mean);
  out.indirect = out.whole;
  out.indirect.noise2 = separate(indirect[0], indirect[1], *p, *q, 1).over(judges_->lux.mean).noise2;
  out.direct =
      separate(less(all[0], indirect[0]), less(all[1], indirect[1]), *p, *q, 1).over(judges_->lux.mean);
  return out;
}

std::vector<PilotRuns::Counted> PilotRuns::count_records(double photons_count,
                                                         const std::vector<double>& accuracies, double rays) {
  std::vector<Counted> counts;
  for (const double a : accuracies) {
    Knobs k = made_;
    Counted count;
    k[at(Knob::photons)] = photons_count, k[at(Knob::accuracy)] = a, k[at(Knob::rays)] = rays;
    const std::string photons = name("photons-", 0) + "-" + knob_word(k, Knob::photons);
    if (task_.image) {
      k[at(Knob::pixels)] = pixels_of(task_);
      const GlossFiles gloss = gloss_files(name("count-", 0));
      const std::uint64_t seed = options_.seed + kCountSeed;
      count.gloss_records = gloss_records_run(task_, k, photons, gloss, seed);
      count.records += records_run(
          "records", Knob::records, k,
          seeded(view_records_command(task_, k, task_.scene, photons, name("count-", 0), gloss), seed));
    }
    if (task_.lux) {
      k[at(Knob::pixels)] = 0;
      count.records +=
          records_run("records", Knob::records, k,
                      seeded(sensor_records_command(task_, k, task_.scene, photons, folder_.file("all.csv"),
                                                    "", name("count-", 1)),
                             options_.seed + kCountSeed));
    }
    counts.push_back(count);
  }
  return counts;
}

}  // namespace phos::inline plan
