// What a scene stands under (sky, sun, environment, luminaires, bands, portals, lamps, time), taken from the
// caches where the command does not say.
#pragma once

#include <string>
#include <vector>

#include "core/options.h"
#include "file/container.h"
#include "file/tool.h"

namespace phos::stage {

/// Whether all files hold the light of the same lamps (--lamps), or each of lamps of its own, which then stay
/// as the command line says.
enum class LampsOf { all_files, each_file };

/// Sets the options of SceneOptions that were not given to the values that the first of these files records,
/// and returns one line for each file that lists the values taken. Files of lobes are passed over: they are
/// of materials alone. --time and --frame are left where a sequence is made. Throws Error(mismatch), unless
/// `allow_mismatch`, for an option that was given and contradicts a file, and for a file that was made with
/// an environment map, luminaires or spectra where none are given: their paths are not recorded. What the
/// scene hash tells better (another map, other bands) is left to require_together().
std::vector<std::string> adopt_site(Options& options, const std::vector<Container>& files,
                                    bool allow_mismatch, LampsOf lamps = LampsOf::all_files);

/// The same for a program, which says the lines. Paths that are "" or no phos files are passed over. Call
/// before inputs are added.
void take_site(Tool& tool, const std::vector<std::string>& paths, bool allow_mismatch,
               LampsOf lamps = LampsOf::all_files);

}  // namespace phos::stage
