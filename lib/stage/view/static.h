// phos-view --static: scene, caches -> one page that needs no server.
#pragma once

#include <string>

#include "file/tool.h"
#include "scene/scene.h"
#include "stage/view/view.h"
#include "view/page_files.h"

namespace phos::stage {

/// Throws Error(usage) for options of the server with --static, and for options of --static without it;
/// Error(bad_input) where nothing could be written at the path of --static.
void require_static_options(Tool& tool, const ViewCommand& asked);

/// The greatest errors of rounding in the page, of places and of the light of records, for its notes.
std::string precision_note(const Scene& scene);

/// Writes the page, whole or not at all.
void write_static_page(Tool& tool, const ViewCommand& asked, const Scene& scene, const PageFiles& files);

}  // namespace phos::stage
