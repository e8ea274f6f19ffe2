// Lists in words.
#pragma once

#include <string>
#include <string_view>

namespace phos {

/// Adds an item to a list, after a separator unless the list is empty.
void append_item(std::string& list, std::string_view item, std::string_view separator = ", ");

}  // namespace phos
