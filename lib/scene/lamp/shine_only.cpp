#include "scene/lamp/shine_only.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/text/comma_list.h"
#include "core/text/likeness.h"

namespace phos::inline scene {
namespace {

constexpr const char* kEnvironment = "environment";  // as finalize() names its light

bool emits(const Scene& scene, const Instance& instance) {
  return instance.fitting >= 0 || scene.material[instance.material].emits();
}

std::set<std::string> chosen(const Scene& scene, const std::string& names) {
  const std::vector<std::string> known = lamp_names(scene);
  const auto is_known = [&](const std::string& name) {
    return std::binary_search(known.begin(), known.end(), name);
  };
  std::set<std::string> found;
  for (const std::string& name : split_known_names(names, is_known)) {
    if (!is_known(name)) {
      std::string all;
      for (const std::string& lamp : known) all += (all.empty() ? "\"" : ", \"") + lamp + "\"";
      throw Error(ExitCode::usage, "--lamps",
                  text("there is no lamp \"", name, "\"", did_you_mean(name, known), "; ",
                       all.empty() ? "the scene has none" : "the scene has " + all));
    }
    found.insert(name);
  }
  return found;
}

}  // namespace

std::vector<std::string> lamp_names(const Scene& scene) {
  std::set<std::string> names;
  for (const Light& light : scene.light) names.insert(light.name);
  for (const Instance& instance : scene.instance)
    if (emits(scene, instance)) names.insert(instance.node);
  if (scene.environment) names.insert(kEnvironment);
  return {names.begin(), names.end()};
}

void shine_only(Scene& scene, const std::string& names) {
  const std::set<std::string> lit = chosen(scene, names);
  std::erase_if(scene.light, [&](const Light& light) { return !lit.contains(light.name); });
  if (!lit.contains(kEnvironment)) scene.environment = nullptr;
  std::map<std::uint32_t, std::uint32_t> dark;
  for (Instance& instance : scene.instance) {
    if (!emits(scene, instance) || lit.contains(instance.node)) continue;
    const auto [copy, first] =
        dark.emplace(instance.material, static_cast<std::uint32_t>(scene.material.size()));
    if (first) {
      Material material = scene.material[instance.material];
      material.emission = Rgb(0), material.emissive = {};
      scene.material.push_back(std::move(material));
    }
    instance.material = copy->second, instance.fitting = -1;
  }
}

std::vector<std::uint32_t> lamps_named(const Scene& scene, const std::string& names) {
  const std::vector<std::string> known = lamp_names(scene);
  const std::vector<std::string> lit = split_known_names(
      names, [&](const std::string& name) { return std::binary_search(known.begin(), known.end(), name); });
  std::vector<std::uint32_t> lamps;
  for (std::uint32_t i = 0; i < scene.light.size(); ++i)
    if (names.empty() || std::find(lit.begin(), lit.end(), scene.light[i].name) != lit.end())
      lamps.push_back(i);
  return lamps;
}

}  // namespace phos::inline scene
