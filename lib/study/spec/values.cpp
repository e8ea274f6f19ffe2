#include "study/spec/values.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"

namespace phos::inline study {

namespace {

double six_digits(double v) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.6g", v);
  return std::strtod(digits, nullptr);
}

struct Ends {
  double from = 0, to = 0;
  std::int64_t steps = 0;
  bool logarithmic = false;
};

Ends ends_of(const ToolOption& option, const Json& table, const std::string& where) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::usage, where, text("the range of ", option.name, " ", why));
  };
  if (option.kind != "number" && option.kind != "integer")
    refuse(text("makes no sense: it is a ", option.kind, "; list its values: [.., ..]"));
  for (const auto& [key, value] : table.as_object())
    if (key != "from" && key != "to" && key != "steps" && key != "scale")
      refuse(text("has \"", key, "\"; it takes from, to, steps and scale"));
  const auto number = [&](const char* key) {
    const Json* v = table.find(key);
    if (!v || !v->is_number() || !std::isfinite(v->as_number()))
      refuse(text("needs a number ", key, ": { from = 0.1, to = 1, steps = 4, scale = \"log\" }"));
    return v->as_number();
  };
  Ends ends{number("from"), number("to"), 0, false};
  const Json* steps = table.find("steps");
  if (!steps || !steps->is_integer() || steps->as_integer() < 2 || steps->as_integer() > 10000)
    refuse("needs a whole number of steps, from 2 to 10000");
  ends.steps = steps->as_integer();
  if (const Json* scale = table.find("scale")) {
    if (*scale != Json("linear") && *scale != Json("log"))
      refuse("has a scale that is neither \"linear\" nor \"log\"");
    ends.logarithmic = *scale == Json("log");
  }
  if (!(ends.from < ends.to))
    refuse(text("runs from ", shortest(ends.from), " to ", shortest(ends.to),
                "; the end must lie above the start"));
  if (ends.logarithmic && !(ends.from > 0)) refuse("is logarithmic and does not start above 0");
  if (option.kind == "integer" && ends.to - ends.from < static_cast<double>(ends.steps - 1))
    refuse(text("has ", ends.steps, " steps, more than there are whole numbers in it"));
  return ends;
}

std::vector<Json> range_of(const ToolOption& option, const Json& table, const std::string& where) {
  const Ends ends = ends_of(option, table, where);
  std::vector<Json> values;
  for (std::int64_t i = 0; i < ends.steps; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(ends.steps - 1);
    double v = ends.logarithmic ? ends.from * std::pow(ends.to / ends.from, t)
                                : ends.from + t * (ends.to - ends.from);
    if (i == 0) v = ends.from;
    if (i == ends.steps - 1) v = ends.to;
    values.push_back(option.kind == "integer" ? std::round(v) : six_digits(v));
  }
  // Rounded, the first of a logarithmic range may meet.
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

std::vector<Json> values_of(const ToolOption& option, const Json& asked, const std::string& where) {
  if (asked.is_object()) return range_of(option, asked, where);
  if (!asked.is_array()) return {asked};
  const std::vector<Json>& list = asked.as_array();
  if (list.empty())
    throw Error(ExitCode::usage, where,
                text(option.name, " has no value: the list is empty; fill it or leave it out"));
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (list[i] == list[j] ||
          (list[i].is_number() && list[j].is_number() && list[i].as_number() == list[j].as_number()))
        throw Error(ExitCode::usage, where,
                    text(option.name, ": ", list[i].dump(), " is in the list twice; leave one out"));
  return list;
}

}  // namespace phos::inline study
