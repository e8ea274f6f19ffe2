// EULUMDAT: the standard file of photometric data of Europe.
#pragma once

#include <string>
#include <string_view>

#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {

PhotometricFile parse_eulumdat(std::string_view bytes, const std::string& where);

}  // namespace phos::inline scene
