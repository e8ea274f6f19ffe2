// IES LM-63: the standard file of photometric data of North America.
#pragma once

#include <string>
#include <string_view>

#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {

PhotometricFile parse_ies(std::string_view bytes, const std::string& where, const ReadBeside& beside);
/// Name of the file that TILT= names; "" where none.
std::string ies_tilt_file(std::string_view bytes);

}  // namespace phos::inline scene
