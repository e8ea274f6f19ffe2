#include "plan/requirements.h"

#include <algorithm>

#include "core/error.h"

namespace phos::inline plan {
namespace {

/// "wall and floor", "wall, floor and 3 more"
std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string out;
  const std::size_t shown = std::min(kShown, names.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == names.size() && i > 0;
    out.append(i == 0 ? ""
               : last ? " and "
                      : ", ")
        .append(names[i].empty() ? "a nameless material" : names[i]);
  }
  if (names.size() > kShown) out += text(" and ", names.size() - kShown, " more");
  return out;
}

bool has(const std::vector<Requirement>& list, const char* what) {
  return std::any_of(list.begin(), list.end(), [&](const Requirement& r) { return r.what == what; });
}

/// The gloss that harmonics hold, or the reason why there is none.
void tell_of_gloss(const Json& gloss, Needs& needs) {
  std::vector<std::string> recorded, sharp;
  std::int64_t least = 0, most = 0;
  for (const Json& choice : gloss.as_array()) {
    const std::int64_t order = choice.find("order")->as_integer();
    (order > 0 ? recorded : sharp).push_back(choice.find("material")->as_string());
    if (order == 0) continue;
    least = least == 0 ? order : std::min(least, order);
    most = std::max(most, order);
  }
  if (!recorded.empty()) {
    needs.held_gloss = text("harmonics of order ", least);
    if (most > least) needs.held_gloss += text(" to ", most);
    needs.held_gloss += " hold the lobes of " + list_of(recorded);
  }
  const std::string too_sharp =
      sharp.empty() ? "" : text("the lobes of ", list_of(sharp), " are too sharp for harmonics");
  if (!recorded.empty() && !sharp.empty()) needs.held_gloss += " (" + too_sharp + ")";
  if (recorded.empty())
    needs.unwanted.push_back({"radiance records", sharp.empty() ? "nothing is glossy" : too_sharp});
}

}  // namespace

Needs plan_needs(const Scene& scene, const Json& gloss, bool film) {
  Needs needs;
  needs.lit = !scene.light.empty();
  needs.animated = !scene.animation.empty();
  needs.frames = scene.frames;
  for (const Requirement& r : scene_requirements(scene)) {
    if (r.what == "gloss") {
      needs.wanted.push_back({"traced gloss", r.why});
      needs.gloss = true;
    } else if (r.what == "temporal data" && !film) {
      needs.unwanted.push_back(
          {"temporal data", text(r.why, ", and this plan is for one of them; for all: --frames 0:",
                                 std::max<std::int64_t>(scene.frames, 1) - 1)});
    } else {
      if (r.what == "specular tracing") needs.gloss = needs.specular = true;
      needs.wanted.push_back(r);
    }
  }
  if (has(needs.wanted, kCausticPhotons))
    needs.ways = light_ways(RayScene(scene), Luminaires(scene));
  else
    needs.unwanted.push_back(
        {kCausticPhotons, "no lamp's light reaches surfaces by way of mirrors, curved glass or sharp gloss"});
  if (!has(needs.wanted, "specular tracing"))
    needs.unwanted.push_back({"specular tracing", "nothing is a mirror or smooth glass"});
  tell_of_gloss(gloss, needs);
  if (!needs.animated) needs.unwanted.push_back({"temporal data", "nothing moves and no light changes"});
  return needs;
}

Json to_json(const Needs& needs) {
  const auto list = [](const std::vector<Requirement>& items) {
    Json out = Json::Array{};
    for (const Requirement& r : items) {
      Json item;
      item["what"] = r.what, item["why"] = r.why;
      out.push_back(item);
    }
    return out;
  };
  Json out;
  out["wanted"] = list(needs.wanted);
  out["not_wanted"] = list(needs.unwanted);
  out["animated"] = needs.animated;
  out["frames"] = needs.frames;
  return out;
}

}  // namespace phos::inline plan
