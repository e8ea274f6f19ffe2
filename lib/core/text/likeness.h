// Which of some names was meant.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace phos {

/// Letters to change, add or take away (V. I. Levenshtein 1966).
std::size_t edit_distance(const std::string& a, const std::string& b);

/// `; did you mean "rays"?`: the name nearest by that, the first of several; "" where none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

}  // namespace phos
