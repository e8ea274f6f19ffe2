// The topics that `phos help` explains besides programs.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace phos::stage {

struct HelpTopic {
  std::string_view name, summary;
  std::string (*text)();
};

std::span<const HelpTopic> help_topics();
/// The topic of that name; null where there is none.
const HelpTopic* find_topic(std::string_view name);

/// The table of docs/reference/events.md, in Markdown.
std::string event_table();

}  // namespace phos::stage
