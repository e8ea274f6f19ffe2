#include "stage/front/front.h"

#include <algorithm>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/facts/programs.h"
#include "core/last_words.h"
#include "core/options.h"
#include "core/text/likeness.h"
#include "core/text/standard_streams.h"
#include "core/text/wrap.h"
#include "stage/front/doctor.h"
#include "stage/front/launch.h"
#include "stage/front/topics.h"

namespace phos::stage {
namespace {

constexpr const char* kName = "phos";
constexpr const char* kSummary = "runs the programs of phos, explains them, and checks the machine";
constexpr const char *kHelp = "help", *kDoctor = "doctor";

std::string short_name(const Program& program) { return std::string(program.name).substr(5); }

/// "scene, caches -> .exr"
std::string passes(const Program& program) { return text(program.reads, " -> ", program.makes); }

std::string overview() {
  std::size_t width = 0;
  for (const Program& program : all_programs()) width = std::max(width, passes(program).size());
  std::string s =
      text(kName, ' ', version(), " - ", kSummary,
           "\n\nUsage: phos PROGRAM [ARGUMENT]...     phos splat is phos-splat"
           "\n       phos help [PROGRAM | TOPIC]"
           "\n       phos doctor [--json]            checks that this machine has all that phos needs"
           "\n\nPrograms, in the order of a study, with their inputs and outputs:\n");
  for (const Program& program : all_programs()) {
    std::string line = "  " + short_name(program);
    line.resize(14, ' ');
    line += passes(program);
    line.resize(14 + width + 2, ' ');
    s += text(line, program.summary, '\n');
  }
  s += "\nTopics of phos help:\n";
  for (const HelpTopic& topic : help_topics())
    s += list_entry(std::string(topic.name), std::string(topic.summary), 14);
  return s;
}

/// Parses --help, --man and the options of phos itself.
void parse_own(int argc, const char* const* argv) {
  std::string names;
  for (const Program& program : all_programs()) names += text(names.empty() ? "" : ", ", short_name(program));
  Options options(kName, kSummary,
                  text("phos PROGRAM runs phos-PROGRAM with all further arguments, and ends with its exit "
                       "code. The program is looked for beside phos, then on PATH. Programs: ",
                       names,
                       ". phos help lists the programs with their inputs and outputs, and explains a program "
                       "or a topic. phos doctor checks that this machine has all that phos needs."));
  std::vector<std::string> words;
  options.inputs("COMMAND", words, "a program, help or doctor, and its arguments", false);
  options.example("phos splat room.glb room.irradiance -o room.exr", "runs phos-splat");
  options.example("phos help exit-codes", "the meaning of exit codes");
  options.example("phos doctor", "checks this machine, one line a check");
  options.parse(argc, argv);
}

/// Throws Error(usage) for a name that is neither a program nor one of `more`.
[[noreturn]] void refuse(const std::string& word, const char* what, std::vector<std::string> more) {
  for (const Program& program : all_programs()) more.push_back(short_name(program));
  throw Error(ExitCode::usage, word,
              text("no such ", what, did_you_mean(word, more), "; phos help lists all"));
}

void help(const std::vector<std::string>& words) {
  if (words.size() > 1) throw Error(ExitCode::usage, words[1], "phos help explains one name at a time");
  if (words.empty()) {
    std::cout << overview();
  } else if (const HelpTopic* topic = find_topic(words[0])) {
    std::cout << topic->text();
  } else if (const Program* program = find_program(words[0])) {
    launch(std::string(program->name), {"--help"});
  } else if (words[0] == kDoctor) {
    const char* const arguments[] = {kDoctor, "--help"};
    run_doctor(2, arguments);
  } else if (words[0] == kHelp || words[0] == kName) {
    const char* const arguments[] = {kName, "--help"};
    parse_own(2, arguments);
  } else {
    std::vector<std::string> names{kHelp, kDoctor};
    for (const HelpTopic& each : help_topics()) names.emplace_back(each.name);
    refuse(words[0], "program or topic", std::move(names));
  }
}

ExitCode run(int argc, const char* const* argv) {
  const std::string command = argc > 1 ? argv[1] : kHelp;
  const std::vector<std::string> rest(argv + std::min(argc, 2), argv + argc);
  if (command.starts_with('-')) {
    parse_own(argc, argv);
  } else if (command == kHelp) {
    help(rest);
  } else if (command == kDoctor) {
    return run_doctor(argc - 1, argv + 1);
  } else if (const Program* program = find_program(command)) {
    launch(std::string(program->name), rest);
  } else {
    refuse(command, "program", {kHelp, kDoctor});
  }
  return ExitCode::done;
}

int report(const std::string& where, const std::string& message, ExitCode code) {
  std::cout.flush();
  print_line(text(kName, ": ", where, where.empty() ? "" : ": ", message));
  return static_cast<int>(code);
}

}  // namespace

int run_front(int argc, const char* const* argv) {
  occupy_standard_streams();
  set_program_name(kName);
  install_last_words();
  try {
    const ExitCode code = run(argc, argv);
    finish_stdout();
    return static_cast<int>(code);
  } catch (const Error& e) {
    return report(e.where(), e.what(), e.code());
  } catch (const std::bad_alloc&) {
    return report("", "out of memory; end other programs, or raise ulimit -v", ExitCode::no_memory);
  }
}

}  // namespace phos::stage
