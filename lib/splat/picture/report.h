// What phos-splat tells of a picture that it made.
#pragma once

#include "file/tool.h"
#include "splat/picture/gloss.h"
#include "splat/picture/noise_target.h"
#include "splat/picture/render.h"

namespace phos::inline splat {

/// Times, counts and events for --stats; on stderr what is missing, where `misses` and `gloss_misses` (paths
/// of --misses and --gloss-misses, "" where not given) do not hold it; and the meaning of an overlay.
void report_picture(Tool& tool, const RenderOptions& render, const Rendering& rendering,
                    const PictureGloss& gloss, const std::string& misses, const std::string& gloss_misses);

/// How many rays an asked noise takes, and whether that is too many; nothing where none was asked.
void report_noise(Tool& tool, const RenderOptions& render, const NoiseTarget& target);

}  // namespace phos::inline splat
