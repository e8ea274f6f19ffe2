#include "study/spec/stages.h"

#include <algorithm>
#include <set>

#include "file/hash.h"
#include "scene/load.h"

namespace phos::inline study {

std::span<const StageKind> stage_kinds() {
  static const std::vector<StageKind> kinds{
      {"photons", "phos-photons", ".photons", {}},
      {"brdf", "phos-brdf", ".brdf", {}},
      {"radiance", "phos-radiance", ".radiance", {"photons", "brdf"}},
      {"irradiance", "phos-irradiance", ".irradiance", {"photons", "radiance", "brdf"}},
      {"temporal", "phos-temporal", ".irradiance", {"brdf"}},
      {"splat", "phos-splat", ".exr", {"irradiance", "temporal", "radiance", "brdf"}},
      {"sense", "phos-sense", ".csv", {"irradiance", "temporal", "radiance"}},
  };
  return kinds;
}

const StageKind* find_stage(const std::string& section) {
  for (const StageKind& kind : stage_kinds())
    if (section == kind.section) return &kind;
  return nullptr;
}

Stages::Stages(const StudyFile& study, const CommandRunner& runner, std::string folder)
    : study_(study), programs_(runner.folder()), folder_(std::move(folder)) {}

const std::string& Stages::hash_of(const std::string& path) {
  std::string& hash = hashes_[path];
  if (hash.empty()) hash = hash_file(path).hex();
  return hash;
}

std::size_t Stages::add(const std::string& section, const std::string& tool, const std::string& extension,
                        const std::string& scene, std::vector<std::size_t> inputs,
                        std::vector<std::string> words) {
  Hasher hasher;
  hasher.add(tool);
  hasher.add(hash_of(programs_ + "/" + tool));
  hasher.add(study_.threads);
  for (const std::string& path : scene_files(scene)) hasher.add(hash_of(path));
  for (const std::size_t i : inputs) hasher.add(runs_[i].id);
  for (const std::string& word : words) hasher.add(study_.files.contains(word) ? hash_of(word) : word);
  StageRun run{section, {tool, {scene}, ""}, std::move(inputs), hasher.finish().hex()};
  const auto [found, fresh] = by_id_.emplace(run.id, runs_.size());
  if (!fresh) return found->second;
  for (const std::size_t i : run.inputs) run.command.arguments.push_back(runs_[i].command.output);
  run.command.arguments.insert(run.command.arguments.end(), words.begin(), words.end());
  run.command.output = folder_ + "/" + run.id + extension;
  runs_.push_back(std::move(run));
  return runs_.size() - 1;
}

std::vector<std::size_t> Stages::chain(std::size_t last) const {
  std::set<std::size_t> needed{last};
  for (auto i = needed.rbegin(); i != needed.rend(); ++i)  // inputs lie before their readers
    needed.insert(runs_[*i].inputs.begin(), runs_[*i].inputs.end());
  return {needed.begin(), needed.end()};
}

std::vector<std::string> Stages::shell_lines(std::size_t last, const std::string& name) const {
  std::map<std::string, std::string> names;
  std::vector<std::string> lines;
  for (const std::size_t i : chain(last)) {
    Command command = runs_[i].command;
    for (std::string& word : command.arguments)
      if (const auto found = names.find(word); found != names.end()) word = found->second;
    const std::string extension = command.output.substr(command.output.rfind('.'));
    names[command.output] = name + extension;
    command.output = name + extension;
    lines.push_back(shell_line(command));
  }
  return lines;
}

}  // namespace phos::inline study
