#include "scene/note.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "file/tool.h"
#include "scene/scene.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kShown = 3;

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

std::string line_of(const Note& note, const std::vector<std::string>& names) {
  if (note.kind.empty()) return note.message;
  const bool missing = note.code == kTextureNotFound;
  if (names.size() == 1 && missing) return text("texture not found: ", names[0], " ", note.message);
  if (names.size() == 1) return text(note.kind, " ", quoted(names[0]), ": ", note.message);
  std::string list;
  std::size_t shown = 0, told = 0;
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size() && shown < kShown; ++i, ++told) {
    if (!known.insert(names[i]).second) continue;  // exporters give many the same
    list.append(shown++ > 0 ? ", " : "").append(quoted(names[i]));
  }
  if (names.size() > told) list += text(" and ", names.size() - told, " more");
  return text(names.size(), " ", note.kind, missing ? "s not found (" : "s (", list, "): ", note.message);
}

}  // namespace

std::string Note::line() const { return line_of(*this, {name}); }

std::vector<Note> merged(const std::vector<Note>& notes) {
  struct Group {
    const Note* first;
    std::vector<std::string> names;
  };
  std::vector<Group> groups;
  std::map<std::tuple<Note::Level, std::string, std::string, std::string>, std::size_t> known;
  for (const Note& note : notes) {
    const auto [at, fresh] =
        known.try_emplace({note.level, note.code, note.kind, note.message}, groups.size());
    if (fresh) groups.push_back({&note, {}});
    groups[at->second].names.push_back(note.name);
  }
  std::vector<Note> out;
  for (const Group& group : groups)
    out.emplace_back(group.first->level, group.first->code, "", "", line_of(*group.first, group.names));
  return out;
}

std::vector<Note> losses(const Scene& scene) {
  std::vector<Note> out = merged(scene.warnings);
  std::erase_if(out, [](const Note& n) { return n.level != Note::Level::warning; });
  return out;
}

bool refused(const std::vector<Note>& told) {
  return std::any_of(told.begin(), told.end(), [](const Note& n) { return n.code != kMetalByDefault; });
}

void tell_losses(Tool& tool, const Scene& scene) {
  const std::vector<Note> told = losses(scene);
  for (const Note& note : told) tool.warn(note.line());
  if (tool.strict() && refused(told)) throw Error(ExitCode::bad_input, scene.path, kRefusedForLosses);
}

}  // namespace phos::inline scene
