// The limits of all modules, in groups.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/facts/limit.h"

namespace phos::stage {

struct LimitGroup {
  std::string_view title;
  std::span<const Limit* const> limits;
};

std::span<const LimitGroup> all_limits();

/// The table of docs/reference/limits.md, in Markdown.
std::string limit_table();

}  // namespace phos::stage
