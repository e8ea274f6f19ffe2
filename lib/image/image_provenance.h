// How an image was made, kept in the text attributes of its OpenEXR file.
#pragma once

#include <optional>
#include <string>

#include "file/container.h"
#include "image/image.h"

namespace phos::inline image {

/// Stores it as attributes "phos.tool", "phos.command", ...
void set_provenance(Image& image, const Provenance& provenance);
/// From an OpenEXR file's header alone (milliseconds); nothing if it was not made by phos. Throws
/// Error(bad_input).
std::optional<Provenance> read_image_provenance(const std::string& path);

}  // namespace phos::inline image
