// Changes in JSON that leave it JSON: readers behind the parser see every one.
#pragma once

#include "core/json.h"
#include "random_choice.h"

namespace phos::fuzz {

/// One change: a value replaced by another, or by one from elsewhere in the document; a member or an element
/// taken away, doubled or put elsewhere.
Json mutated(const Json& document, Choice& choice);

}  // namespace phos::fuzz
