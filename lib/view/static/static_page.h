// The page of a walk as one file that needs no server and no network.
#pragma once

#include <string>

#include "core/json.h"
#include "view/page_files.h"

namespace phos::inline view {

/// HTML that a browser opens from disk. Style and scripts stand in it as text, every other file deflated, in
/// base64; messages are packed first (view/static/packed_message.h), which costs precision. A policy forbids
/// the page to ask any machine for anything. `provenance` is how the page was made; it stands in an element
/// of that name. Throws Error(usage) for a page of more than kMostStaticBytes.
std::string static_page(const PageFiles& files, const Json& provenance);

}  // namespace phos::inline view
