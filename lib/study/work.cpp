#include "study/work.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "image/image.h"
#include "study/spec/check.h"

namespace phos::inline study {

namespace {

constexpr std::int64_t kUsualWidth = 400;

using Words = std::vector<std::string>;

void append(Words& to, const Words& words) { to.insert(to.end(), words.begin(), words.end()); }

/// Do these options place records for a view, and leave its size to the study?
bool places_for_picture(const Words& words) {
  const auto has = [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const auto place = std::find(words.begin(), words.end(), "--place");
  return place != words.end() && place + 1 != words.end() && place[1] == "view" && !has("--width") &&
         !has("--height");
}

/// Adds commands to a study's stages.
class Planner {
 public:
  Planner(const StudyFile& study, StudyWork& work) : study_(study), work_(work) {
    for (const std::string& scene : study.scenes)
      for (const std::string& camera : study.cameras)
        for (Words& size = sizes_.emplace_back(); const auto& [name, pixels] : size_of(scene, camera))
          append(size, {name, std::to_string(pixels)});
  }

  void references() {
    if (study_.makes_pictures())
      for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const std::string& scene = study_.scenes[i / study_.cameras.size()];
        const std::string& camera = study_.cameras[i % study_.cameras.size()];
        Words words = study_.reference;
        append(words, sizes_[i]), append(words, camera_words(camera));
        work_.pictures.push_back(
            reference(scene, given(study_, scene, camera, &GivenReference::pictures), words, ".exr"));
      }
    if (study_.reads_sensors())
      for (const std::string& scene : study_.scenes) {
        Words words = study_.reference;
        if (study_.sensor_samples) append(words, {"--samples", std::to_string(*study_.sensor_samples)});
        append(words, {"--points", study_.sensors});
        work_.lux.push_back(reference(scene, given(study_, scene, "", &GivenReference::lux), words, ".csv"));
      }
  }

  Job job(std::size_t setting, std::size_t seed) {
    Job job{setting, seed, {}, {}};
    std::map<std::string, std::size_t> made;
    const Setting& s = work_.settings[setting];
    for (const StageKind& kind : stage_kinds()) {
      if (!study_.sections.contains(kind.section)) continue;
      const std::size_t stage = add(kind, s, seed, made);
      made[kind.section] = stage;
      if (kind.section == std::string("splat")) job.picture = stage;
      if (kind.section == std::string("sense")) job.lux = stage;
    }
    return job;
  }

 private:
  std::vector<std::pair<std::string, std::int64_t>> size_of(const std::string& scene,
                                                            const std::string& camera) const {
    const Words& files = given(study_, scene, camera, &GivenReference::pictures);
    if (!files.empty()) {
      const Image image = read_image(files[0]);
      return {{"--width", image.width()}, {"--height", image.height()}};
    }
    if (!study_.height) return {{"--width", study_.width.value_or(kUsualWidth)}};
    if (!study_.width) return {{"--height", *study_.height}};
    return {{"--width", *study_.width}, {"--height", *study_.height}};
  }

  static Words camera_words(const std::string& camera) {
    return camera.empty() ? Words{} : Words{"--camera", camera};
  }

  ReferenceWork reference(const std::string& scene, const Words& files, const Words& words,
                          const char* extension) {
    if (!files.empty()) return {files, {}};
    ReferenceWork made;
    for (const std::int64_t seed : study_.reference_seeds) {
      Words all = words;
      append(all, {"--seed", std::to_string(seed)});
      made.stages.push_back(work_.stages.add("reference", "phos-reference", extension, scene, {}, all));
      made.files.push_back(work_.stages[made.stages.back()].command.output);
    }
    return made;
  }

  std::size_t add(const StageKind& kind, const Setting& s, std::size_t seed,
                  const std::map<std::string, std::size_t>& made) {
    const std::string section = kind.section, &camera = study_.cameras[s.camera];
    Words words = study_.fixed.at(section);
    for (std::size_t i = 0; i < study_.factors.size(); ++i)
      if (study_.factors[i].section == section) append(words, study_.factors[i].words[s.level[i]]);
    for (auto word = words.begin(); word != words.end();) {
      if (*word != kEachCamera)
        ++word;
      else if (camera.empty())
        word = words.erase(word - 1, word + 1);  // --camera and its value: programs take the first
      else
        *word++ = camera;
    }
    const bool picture = section == "splat";
    if (picture || places_for_picture(words))
      append(words, sizes_[s.scene * study_.cameras.size() + s.camera]);
    if (picture) append(words, camera_words(camera));
    if (section == "sense") append(words, {"--points", study_.sensors});
    append(words, {"--seed", std::to_string(study_.seeds[seed])});
    std::vector<std::size_t> inputs;
    for (const char* read : kind.reads)
      if (const auto found = made.find(read); found != made.end()) inputs.push_back(found->second);
    return work_.stages.add(section, kind.tool, kind.extension, study_.scenes[s.scene], inputs, words);
  }

  const StudyFile& study_;
  StudyWork& work_;
  std::vector<Words> sizes_;
};

}  // namespace

std::vector<std::size_t> StudyWork::order() const {
  std::vector<std::size_t> order;
  std::set<std::size_t> there;
  const auto add = [&](std::size_t last) {
    for (const std::size_t i : stages.chain(last))
      if (there.insert(i).second) order.push_back(i);
  };
  for (const auto* references : {&pictures, &lux})
    for (const ReferenceWork& r : *references)
      for (const std::size_t i : r.stages) add(i);
  for (const Job& job : jobs) {
    if (job.picture) add(*job.picture);
    if (job.lux) add(*job.lux);
  }
  return order;
}

StudyWork plan_work(const StudyFile& study, const CommandRunner& runner, const std::string& folder) {
  std::vector<SceneLoss> losses = check_against_scenes(study);
  StudyWork work{expand_settings(study), Stages(study, runner, folder), {}, {}, {}, std::move(losses)};
  Planner planner(study, work);
  planner.references();
  const std::size_t n = work.settings.size();
  for (std::size_t seed = 0; seed < study.seeds.size(); ++seed)
    for (std::size_t i = 0; i < n; ++i) work.jobs.push_back(planner.job(seed % 2 == 0 ? i : n - 1 - i, seed));
  return work;
}

}  // namespace phos::inline study
