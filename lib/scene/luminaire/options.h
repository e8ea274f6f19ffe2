// Options by which lights of a scene get measured distributions.
#pragma once

#include <string>
#include <vector>

#include "core/options.h"

namespace phos::inline scene {

/// What shines: the luminous opening that the file states, or a point always.
enum class LuminairesAs { openings, points };

struct LuminaireOptions {
  std::vector<std::string> of_lights;  ///< NAME=FILE
  LuminairesAs as = LuminairesAs::openings;
};
void declare_options(Options& options, LuminaireOptions& luminaires);
/// Files that the options name, and those that these name, as far as they exist.
std::vector<std::string> luminaire_files(const LuminaireOptions& options);
/// The words of a command line that mean the same.
std::vector<std::string> luminaire_words(const LuminaireOptions& options);

}  // namespace phos::inline scene
