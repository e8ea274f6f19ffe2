// What a loader lost, ignored or put in place of something.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace phos::inline file {
class Tool;
}

namespace phos::inline scene {

struct Scene;

struct Note {
  /// warning: light or geometry is other than the file says. info: it is as the file says, but somebody may
  /// want to know.
  enum class Level : std::uint8_t { info, warning };
  Level level = Level::warning;
  std::string code = "loader";  ///< stable, for scripts
  std::string kind;             ///< "material", "node", "light"; "" for the scene as a whole
  std::string name;             ///< of that material, node or light
  std::string message;          ///< the same for all of a kind that it happens to

  Note(Level the_level, std::string the_code, std::string the_kind, std::string the_name,
       std::string the_message)
      : level(the_level),
        code(std::move(the_code)),
        kind(std::move(the_kind)),
        name(std::move(the_name)),
        message(std::move(the_message)) {}
  /// A warning about the scene as a whole.
  Note(std::string the_message) : message(std::move(the_message)) {}
  Note(const char* the_message) : message(the_message) {}

  /// 'material "oak": KHR_materials_unlit is ignored', or the message alone.
  std::string line() const;
};

/// Codes that lint and tests look for.
inline constexpr const char* kTextureNotFound = "texture-not-found";
inline constexpr const char* kLightIgnored = "light-ignored";
inline constexpr const char* kLightTooFaint = "light-too-faint";
inline constexpr const char* kSunTooBright = "sun-too-bright";
inline constexpr const char* kMetalByDefault = "metal-by-default";
inline constexpr const char* kExtension = "extension";
/// A fact that lint_scene() reports itself, from the scene.
inline constexpr const char* kSaidByLint = "said-by-lint";

/// One note for all that differ in their names alone, in the order of the first of each: its name lists a few
/// of them ('12 materials ("a", "b", "c" and 9 more): ...'), its kind is empty.
std::vector<Note> merged(const std::vector<Note>& notes);

/// The merged warnings of a scene.
std::vector<Note> losses(const Scene& scene);
/// Does --strict refuse a scene for them? Not for a metal that is as the file says, likely by mistake.
bool refused(const std::vector<Note>& losses);
/// Says them on standard error, a line for each kind; with --strict, which the tool takes, Error(bad_input)
/// then. For every program that computes light from a scene, once it is loaded.
void tell_losses(Tool& tool, const Scene& scene);
inline constexpr const char* kRefusedForLosses =
    "not all of it is modelled as it says; mend the scene, or leave --strict out";

}  // namespace phos::inline scene
