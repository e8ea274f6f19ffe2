#include "study/spec/study_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "file/atomic_file.h"
#include "study/limits.h"
#include "study/spec/keys.h"
#include "study/spec/sections.h"
#include "study/spec/stages.h"

namespace phos::inline study {

namespace {

void read_own_section(const TomlFile& file, StudyFile& study) {
  StudyKeys keys(file, "study");
  for (const std::string& scene : keys.words("scenes"))
    study.scenes.push_back(existing_file(study, scene, keys.where("scenes")));
  if (study.scenes.empty()) keys.refuse("scenes", "is missing; name one or more: scenes = [\"room.glb\"]");
  study.cameras = keys.words("cameras");
  if (study.cameras.empty()) study.cameras = {""};
  study.seeds = keys.integers("seeds", 0);
  const auto repeats = keys.integer("repeats", 1);
  if (repeats && !study.seeds.empty())
    keys.refuse("repeats", "contradicts seeds, which is given too; leave one out");
  if (repeats && *repeats > kMostRepeats.most)
    keys.refuse("repeats", text("must be at most ", kMostRepeats.most));
  if (study.seeds.empty())
    for (std::int64_t i = 0; i < repeats.value_or(1); ++i) study.seeds.push_back(i);
  if (const auto sensors = keys.word("sensors"))
    study.sensors = existing_file(study, *sensors, keys.where("sensors"));
  study.layer = keys.word("layer").value_or(study.layer);
  study.ignore_lamps = keys.flag("ignore_lamps").value_or(study.ignore_lamps);
  study.threads = keys.integer("threads", 0).value_or(study.threads);
  if (const auto time = keys.word("time")) {
    if (*time != "wall" && *time != "cpu") keys.refuse("time", "is neither \"wall\" nor \"cpu\"");
    study.by_cpu = *time == "cpu";
  }
  study.width = keys.integer("width", 1), study.height = keys.integer("height", 1);
  study.confidence = keys.number("confidence").value_or(study.confidence);
  if (!(study.confidence > 0 && study.confidence < 1))
    keys.refuse("confidence", "must lie above 0 and below 1");
  keys.finish();
}

std::vector<std::string> existing_files(StudyFile& study, const std::vector<std::string>& names,
                                        const std::string& where) {
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(existing_file(study, name, where));
  return paths;
}

/// [[reference.given]], one for each scene and camera; or `files` and `lux` in [reference] where there is
/// one.
void read_given(const TomlFile& file, StudyFile& study, StudyKeys& keys) {
  GivenReference only;
  only.where = keys.where("files");
  only.pictures = existing_files(study, keys.words("files"), keys.where("files"));
  only.lux = existing_files(study, keys.words("lux"), keys.where("lux"));
  if (!only.pictures.empty() && study.scenes.size() * study.cameras.size() > 1)
    keys.refuse("files",
                "is of one scene and camera; give each its own: [[reference.given]] scene = .., camera = .., "
                "files = [..]");
  if (!only.lux.empty() && study.scenes.size() > 1)
    keys.refuse("lux", "is of one scene; give each its own: [[reference.given]] scene = .., lux = [..]");
  if (!only.pictures.empty() || !only.lux.empty()) study.given.push_back(only);
  const Json* given = keys.take("given");
  if (!given) return;
  if (!given->is_array()) keys.refuse("given", "is a list of tables: [[reference.given]]");
  for (const Json& item : given->as_array()) {
    TomlFile one;
    one.path = file.path, one.root["reference.given"] = item;
    one.line["reference.given"] = file.line.contains("reference.given") ? file.line.at("reference.given") : 1;
    StudyKeys inner(one, "reference.given");
    GivenReference g;
    g.where = keys.where("given");
    if (const auto scene = inner.word("scene")) g.scene = existing_file(study, *scene, g.where);
    g.camera = inner.word("camera").value_or("");
    g.pictures = existing_files(study, inner.words("files"), g.where);
    g.lux = existing_files(study, inner.words("lux"), g.where);
    inner.finish();
    if (!g.scene.empty() &&
        std::find(study.scenes.begin(), study.scenes.end(), g.scene) == study.scenes.end())
      throw Error(ExitCode::usage, g.where,
                  text("a reference is given for ", g.scene, ", which is not among the scenes"));
    if (!g.camera.empty() &&
        std::find(study.cameras.begin(), study.cameras.end(), g.camera) == study.cameras.end())
      throw Error(
          ExitCode::usage, g.where,
          text("a reference is given for the camera \"", g.camera, "\", which is not among the cameras"));
    study.given.push_back(std::move(g));
  }
}

void check_pairs(const StudyFile& study) {
  for (const GivenReference& g : study.given)
    for (const auto* files : {&g.pictures, &g.lux})
      if (files->size() > 2)
        throw Error(ExitCode::usage, g.where, "a reference is one file, or two of different seeds");
}

void read_reference(const TomlFile& file, StudyFile& study, const CommandRunner& runner) {
  StudyKeys keys(file, "reference");
  if (const auto seeds = keys.integers("seeds", 0); !seeds.empty()) study.reference_seeds = seeds;
  if (study.reference_seeds.size() > 2)
    keys.refuse("seeds", "are two at most: one reference, and another to tell its noise");
  study.sensor_samples = keys.integer("sensor_samples", 2);
  read_given(file, study, keys);
  check_pairs(study);
  read_reference_options(keys, study, runner);
}

void require_something(const TomlFile& file, const StudyFile& study) {
  const auto has = [&](const char* section) { return study.sections.contains(section); };
  const auto refuse = [&](const std::string& section, const std::string& why) {
    throw Error(ExitCode::usage, file.where(section), why);
  };
  if (!study.makes_pictures() && !study.reads_sensors())
    refuse("study", "asks for nothing: add [splat] for pictures, or name sensors in [study] for lux");
  if (has("sense") && !study.reads_sensors())
    refuse("sense", "[sense] needs points: name them in [study], sensors = \"points.csv\"");
  if (has("temporal") && has("irradiance"))
    refuse("temporal", "[temporal] and [irradiance] make the same records; leave one out");
  if (has("temporal") && has("photons"))
    refuse("photons", "[temporal] traces its own photons; leave [photons] out");
  if (has("photons") && !has("irradiance") && !has("radiance"))
    refuse("photons", "[photons] feeds nothing: add [irradiance] (it may be empty)");
  const bool caches = has("irradiance") || has("temporal") || has("radiance");
  if (study.makes_pictures() && !caches)
    refuse("splat", "[splat] has no records to draw: add [irradiance] (it may be empty)");
}

}  // namespace

std::string existing_file(StudyFile& study, const std::string& name, const std::string& where) {
  const std::string path = (std::filesystem::path(study.folder) / name).lexically_normal().string();
  std::error_code too_long;
  if (!std::filesystem::is_regular_file(path, too_long))
    throw Error(ExitCode::bad_input, where,
                text("there is no file ", path, " (paths begin at the folder of the study file)"));
  study.files.insert(path);
  return path;
}

StudyFile read_study(const std::string& path, const CommandRunner& runner) {
  const TomlFile file = parse_toml(read_text(path), path);
  StudyFile study;
  study.path = path;
  study.folder = std::filesystem::path(path).parent_path().string();
  read_own_section(file, study);
  read_sections(file, study, runner);
  require_something(file, study);
  read_reference(file, study, runner);
  return study;
}

}  // namespace phos::inline study
