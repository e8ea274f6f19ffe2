// The pictures of a study's page.
#pragma once

#include <string>

#include "study/html/page.h"

namespace phos::inline study {

/// Of one view (scene x cameras + camera): the reference and points, two at a time under a slider, and all
/// of them with their differences. Empty where no point has a picture.
std::string pictures_section(const PageInput& input, std::size_t view);

}  // namespace phos::inline study
