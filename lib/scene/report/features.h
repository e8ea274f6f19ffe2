// The statements of scene files, and how phos treats them: one row each, for findings and for docs/scenes.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/note.h"

namespace phos::inline scene {

struct Feature {
  enum class Group : std::uint8_t { property, extension, obj, mtl };
  enum class State : std::uint8_t {
    modelled,
    in_part,    ///< told where the missing part is used
    told,       ///< not modelled
    no_effect,  ///< on light, geometry and pictures
  };
  Group group;
  std::string_view name;
  State state;
  std::string_view sentence;  ///< the treatment; of in_part and told it follows the name: "is ignored"
  /// Of a finding: info where light and geometry are as the file says.
  Note::Level level = Note::Level::warning;
  /// Extensions: the members, with commas between, of which one at least must be there and not 0 for a
  /// finding; "": none need be; "-": the reader of the extension tells itself.
  std::string_view when = "-";
  bool may_be_required = false;  ///< told, and yet a scene that requires it is read
};

/// All rows, group by group.
std::span<const Feature> scene_features();
/// Null: not known.
const Feature* find_extension(std::string_view name);
/// Is a scene that requires the extension read?
bool can_be_required(std::string_view extension);
/// 'KHR_materials_unlit is ignored: it is lit like others'
std::string told(const Feature& feature);

/// The tables of docs/scenes.md, in Markdown.
std::string feature_tables();

}  // namespace phos::inline scene
