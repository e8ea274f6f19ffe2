#include "plan/text.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline plan {

const char* const kErrorMeaning =
    "Error of an image: root mean square error of the beauty layer, without pixels that show a lamp, over "
    "the mean of "
    "the converged picture. Of lux: root mean square error over the sensors, over their mean. The noise of "
    "references is "
    "taken out (phos-compare --ignore-emission --second-reference).";

namespace {

constexpr std::size_t kLine = 110;  ///< characters of a line of comment

/// Words in lines that start with "# "; later lines are indented.
std::string comment(const std::string& words, const std::string& indent = "") {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // for want of memory
  std::size_t width = 1;
  out << '#';
  for (std::size_t start = 0; start <= words.size();) {
    const std::size_t end = std::min(words.find(' ', start), words.size());
    if (start > 0 && width + 1 + end - start > kLine) {
      out << "\n# " << indent;
      width = 2 + indent.size();
    } else {
      out << ' ';
      ++width;
    }
    out.write(words.data() + start, static_cast<std::streamsize>(end - start));
    width += end - start;
    start = end + 1;
  }
  out << '\n';
  return out.str();
}

std::string between(const Interval& i, std::string (*say)(double)) {
  return text(say(i.value), " (", say(i.low), " to ", say(i.high), ")");
}

/// A word of a command whose paths are variables of the script.
std::string script_word(const std::string& word) {
  if (!word.starts_with("$scene") && !word.starts_with("$out")) return shell_word(word);
  return std::string("\"").append(word).append("\"");
}

std::string script_line(const Command& command) {
  constexpr const char* kNext = " \\\n  ";
  std::string out, line = command.tool;
  std::vector<std::string> words;
  for (const std::string& w : command.arguments) {
    const bool value = !words.empty() && words.back().starts_with("--") &&
                       words.back().find(' ') == std::string::npos && !w.starts_with("--");
    if (value)
      words.back().append(" ").append(script_word(w));
    else
      words.push_back(script_word(w));
  }
  words.push_back(std::string("-o ").append(script_word(command.output)));
  for (const std::string& w : words) {
    if (line.size() + 1 + w.size() > kLine) {
      out += line + kNext;
      line = w;
    } else {
      line.append(" ").append(w);
    }
  }
  return out + line + "\n";
}

std::string alternatives(const Plan& plan) {
  std::string out;
  for (const auto& [error, p] : plan.others) {
    if (p)
      out += comment(text("  ", percent(error), ": ", duration(p->seconds.value)), "  ");
    else
      out += comment(text("  ", percent(error), ": out of reach"), "  ");
  }
  return out;
}

/// The error at each place and its causes: the larger parts of the mean square.
std::string largest_parts(const PlanModel& model, const Knobs& knobs) {
  std::vector<std::pair<double, std::string>> parts;
  double sum = 0;
  for (const auto& [name, p] : model.part) {
    const std::vector<double> values = p.parts(knobs);
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += values[i];
      const bool bare = p.terms()[i].what.starts_with("what no");
      parts.emplace_back(values[i], bare ? text("what no setting mends in ", name.substr(0, name.find(',')))
                                         : p.terms()[i].what);
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  constexpr std::size_t kShown = 3;
  std::string out;
  for (std::size_t i = 0; i < std::min(kShown, parts.size()); ++i)
    if (sum > 0 && parts[i].first > 0.05 * sum)
      out += text(out.empty() ? "" : ", ", parts[i].second, " ", percent(parts[i].first / sum));
  return out;
}

}  // namespace

std::string goal_line(const PlanTask& task, const PlanGoal& goal) {
  std::string out;
  if (task.frames) out += text("film of frames ", task.frames->first, " to ", task.frames->last, ", ");
  if (task.image) out += text("image of ", task.width, " x ", task.height);
  if (task.image && !task.camera.empty()) out += " from camera " + task.camera;
  if (task.lux)
    out += text(task.image ? " and lux" : "lux",
                task.grid.empty() ? " at the points of " + task.points : " on a grid");
  if (goal.error) out += ", error at most " + percent(*goal.error);
  if (goal.seconds) out += ", within " + duration(*goal.seconds);
  return out;
}

std::string prediction_line(const Prediction& p) {
  std::string out;
  if (p.image) out += "error of the image " + between(*p.image, percent);
  if (p.lux) out += text(p.image ? ", of lux " : "error of lux ", between(*p.lux, percent));
  return out + " in " + between(p.seconds, duration);
}

std::string plan_script(const PlanTask& task, const Needs& needs, const Pilot& pilot, const PlanGoal& goal,
                        const Plan& plan, std::uint64_t seed, const std::string& measured) {
  std::string out = "#!/usr/bin/env bash\n";
  out += comment(text("Asked for: ", goal_line(task, goal)), "  ");
  const bool promised = pilot.doubts.empty();
  if (plan.predicted)
    out +=
        comment(text(promised ? "Predicted: " : "Not promised, only guessed: ", prediction_line(plan.chosen),
                     promised ? ", 9 of 10 times" : "", ", with as many threads on this machine"),
                "  ");
  if (!measured.empty()) out += comment("Measured: " + measured, "  ");
  if (pilot.image_error)
    out += comment("  the image's error comes from " + largest_parts(*pilot.image_error, plan.chosen.knobs),
                   "  ");
  if (pilot.lux_error)
    out += comment("  that of lux comes from " + largest_parts(*pilot.lux_error, plan.chosen.knobs), "  ");
  for (const std::string& warning : plan.warnings) out += comment("Note: " + warning, "  ");
  out += comment(kErrorMeaning, "  ");
  out += "#\n# The scene requires\n";
  for (const Requirement& r : needs.wanted) out += comment(text("  ", r.what, ": ", r.why), "    ");
  out += "# and not\n";
  for (const Requirement& r : needs.unwanted) out += comment(text("  ", r.what, ": ", r.why), "    ");
  if (plan.predicted) out += "#\n# Time for other errors\n" + alternatives(plan);
  out += "#\n";
  out += comment("Usage: give a folder for the files; phos programs must be on PATH");
  out += text("set -euo pipefail\nout=${1:-plan}\nscene=", shell_word(task.scene), "\nmkdir -p \"$out\"\n");
  for (const PlanStage& stage : plan_stages(task, plan.chosen.knobs, "$scene", "$out", seed))
    out += text("\n", comment(stage.what), script_line(stage.command));
  return out;
}

}  // namespace phos::inline plan
