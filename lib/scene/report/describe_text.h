// The description of a scene as text for people.
#pragma once

#include <string>

#include "core/json.h"

namespace phos::inline scene {

/// The answer of describe_scene() as text for people.
std::string describe_text(const Json& description);

}  // namespace phos::inline scene
