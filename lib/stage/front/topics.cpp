#include "stage/front/topics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/events.h"
#include "core/facts/exit_codes.h"
#include "core/facts/programs.h"
#include "core/text/markdown.h"
#include "core/text/wrap.h"
// The events of these headers are all events that programs declare.
#include "estimate/events.h"
#include "file/tool.h"
#include "image/events.h"
#include "photon/events.h"
#include "place/events.h"
#include "radiance/events.h"
#include "reference/events.h"
#include "splat/events.h"
#include "stage/front/limits.h"
#include "temporal/events.h"

namespace phos::stage {
namespace {

std::string exit_codes() {
  std::string s = "Every program ends with one of these codes; an error is one line on standard error.\n\n";
  for (const ExitMeaning& row : exit_meanings()) {
    std::string words(row.meaning);
    if (!row.cause.empty()) words += text(". Usual cause: ", row.cause);
    if (!row.remedy.empty()) words += text(". Remedy: ", row.remedy);
    s += list_entry(std::to_string(static_cast<int>(row.code)), without_markdown(words), 8);
  }
  return s;
}

std::string limits() {
  std::string s = "Limits at which programs stop. The --help of a program has the range of each option.\n";
  std::string_view title;
  for (const LimitGroup& group : all_limits()) {
    if (group.title != title) s += text('\n', title = group.title, ":\n");
    for (const Limit* limit : group.limits)
      s += list_entry(written(*limit), without_markdown(text(limit->of, ". Beyond: ", limit->beyond)), 14);
  }
  return s;
}

/// "any number of photons", "1 of 10^6 photons"
std::string allowed(const Event& event) {
  if (event.share == 1) return text("any number of ", event.trials);
  return text("1 of 10^", std::lround(-std::log10(event.share)), ' ', event.trials);
}

std::string events() {
  std::string s =
      wrap(
          "Numerical events are counted; the counts stand in the file (phos-info) and in --stats. A program "
          "ends with code 5 if an event comes more often than chance allows for its share.",
          0) +
      "\n\n";
  for (const Event* event : all_events()) {
    std::string words = allowed(*event);
    if (!event->remedy.empty()) words += text("; else ", event->remedy);
    s += list_entry(std::string(event->name), words, 52);
  }
  return s;
}

std::string units() {
  std::string s;
  for (const auto& [quantity, words] : {
           std::pair{"lengths", "metres"},
           {"angles", "degrees, unless a name says otherwise"},
           {"times", "seconds; frames are counted from 0"},
           {"axes", "+Y is up, as in glTF; north is -Z unless --north turns it"},
           {"flux of lamps, photons", "lumens (lm)"},
           {"intensity", "candela (cd)"},
           {"illuminance, irradiance", "lux (lx)"},
           {"luminance, radiance", "cd/m2"},
           {"colours", "linear Rec.709, with Y = 0.2126 R + 0.7152 G + 0.0722 B in the unit of the quantity"},
           {"Radiance .hdr files", "W/(m2 sr), read and written with 179 lm/W"},
           {"errors",
            "standard errors (one sigma) in the unit of the quantity; relative errors as fractions"},
           {"memory", "MiB and GiB, powers of 1024"},
       })
    s += list_entry(quantity, words, 28);
  return s;
}

struct FileKind {
  std::string_view ending, holds;
};

constexpr FileKind kFileKinds[] = {
    {".photons", "photons where they landed, and a kd-tree over them"},
    {".irradiance", "irradiance records with gradients and errors, of a scene or of a film"},
    {".radiance", "radiance records: light by direction, on glossy surfaces"},
    {".brdf", "glossy lobes as hemispherical harmonics"},
    {".exr", "pictures with layers"},
    {".csv", "sensors, points, tables"},
};

std::string files() {
  std::string s =
      wrap(
          "Names are free: programs find out the kind of a file from its content. The first four kinds are "
          "containers in the safetensors layout; phos-info shows their tensors.",
          0) +
      "\n\n";
  for (const FileKind& kind : kFileKinds) {
    std::string makers;
    for (const Program& program : all_programs())
      if (program.makes.find(kind.ending) != std::string_view::npos)
        makers += text(makers.empty() ? "" : ", ", program.name);
    s += list_entry(std::string(kind.ending), text(kind.holds, "; by ", makers), 16);
  }
  return s;
}

/// The common options, cut out of a program's help.
std::string options() {
  Tool tool("phos-X", "", "", 1, Tool::Output::optional);
  tool.declare_common();
  const std::string help = tool.options().help();
  const std::size_t from = help.find("Common options:"), to = help.find("\nExit codes:");
  PHOS_CHECK(from != std::string::npos && to != std::string::npos, help);
  return "Options that programs share; the --help of a program has all its options.\n\n" +
         help.substr(from, to - from);
}

constexpr HelpTopic kTopics[] = {
    {"options", "options that programs share", options},
    {"files", "kinds of files", files},
    {"units", "units of numbers, in and out", units},
    {"exit-codes", "codes with which programs end", exit_codes},
    {"events", "numerical events that are counted", events},
    {"limits", "limits at which programs stop", limits},
};

}  // namespace

std::span<const HelpTopic> help_topics() { return kTopics; }

const HelpTopic* find_topic(std::string_view name) {
  const auto* found = std::find_if(std::begin(kTopics), std::end(kTopics),
                                   [&](const HelpTopic& topic) { return topic.name == name; });
  return found == std::end(kTopics) ? nullptr : found;
}

std::string event_table() {
  std::vector<std::vector<std::string>> rows;
  for (const Event* event : all_events())
    rows.push_back({std::string(event->name), allowed(*event), std::string(event->remedy)});
  return markdown_table({"event", "allowed", "remedy"}, rows);
}

}  // namespace phos::stage
