#include "core/facts/exit_codes.h"

#include "core/text/markdown.h"

namespace phos {
namespace {

constexpr ExitMeaning kMeanings[] = {
    {ExitCode::done, "done", "", ""},
    {ExitCode::check_failed, "a comparison or check failed",
     "a difference beyond a limit of `phos-compare`; a plan of `phos-plan --run` that does not meet its "
     "error; an error among the findings of `phos-scene --strict`; a requirement that the machine does not "
     "meet (`phos doctor`)",
     "the message names the limit"},
    {ExitCode::usage, "the command line is wrong",
     "an unknown option; an option that another option excludes; an output that is also an input",
     "read `--help`"},
    {ExitCode::bad_input, "an input is unreadable, malformed or damaged, or the output cannot be written",
     "a truncated cache; a texture that is no picture; a full disk; with `--strict`, a scene with parts that "
     "phos leaves out or replaces",
     "make the input again, or choose another place for the output"},
    {ExitCode::mismatch, "inputs do not belong together",
     "a cache made from another version of the scene, or for another sky, frame or triplet; a cache made "
     "with an "
     "environment map, luminaires or spectra that the command does not give",
     "run the earlier stage again, or pass `--allow-mismatch` where the difference does not matter"},
    {ExitCode::numerical, "a numerical guard tripped more often than it may",
     "with `--strict`, light that an estimator is known to leave out",
     "the message names the lamp, the way of its light and the remedy, or it names the event (`phos help "
     "events`)"},
    {ExitCode::no_memory, "memory ran out; the former output is unchanged", "too many photons or pixels",
     "ask for fewer photons or pixels, or use `--shard`"},
    {ExitCode::interrupted, "interrupted (Ctrl-C, SIGTERM, SIGHUP); the former output is unchanged", "",
     "run it again"},
};

}  // namespace

std::span<const ExitMeaning> exit_meanings() { return kMeanings; }

std::string exit_code_table() {
  std::vector<std::vector<std::string>> rows;
  for (const ExitMeaning& row : kMeanings)
    rows.push_back({std::to_string(static_cast<int>(row.code)), std::string(row.meaning),
                    std::string(row.cause), std::string(row.remedy)});
  return markdown_table({"code", "meaning", "usual cause", "remedy"}, rows);
}

}  // namespace phos
