#include "stage/front/doctor.h"

#include <algorithm>
#include <iostream>

#include "core/json.h"
#include "core/options.h"
#include "stage/front/checks.h"

namespace phos::stage {
namespace {

std::string line(const MachineCheck& check) {
  constexpr std::size_t kColumn = 30;
  std::string left = check.ok ? "ok       " : "missing  ";
  left += check.name;
  std::string right = check.found;
  if (!check.ok) right += text("; ", check.required ? "required" : "not required", ": ", check.remedy);
  left.resize(std::max(left.size() + 1, kColumn), ' ');
  return left + right + "\n";
}

Json described(const std::vector<MachineCheck>& checks, bool ready) {
  Json::Array rows;
  for (const MachineCheck& check : checks) {
    Json row;
    row["name"] = check.name, row["ok"] = check.ok, row["required"] = check.required;
    row["found"] = check.found, row["remedy"] = check.remedy;
    rows.push_back(std::move(row));
  }
  Json all;
  all["version"] = version(), all["ready"] = ready, all["checks"] = std::move(rows);
  return all;
}

}  // namespace

ExitCode run_doctor(int argc, const char* const* argv) {
  bool json = false;
  Options options(
      "phos doctor", "checks that this machine has all that phos needs",
      "Checks the programs, OpenGL (by drawing a picture), threads, memory, the temporary folder, the other "
      "programs that pipelines use, and the locale. Each check prints one line: ok, or missing with the "
      "command that mends it. The exit code is 1 if a requirement is missing.");
  options.flag("json", json, "print JSON instead of text", Recorded::no);
  options.example("phos doctor", "all checks, one line each");
  if (!options.parse(argc, argv)) return ExitCode::done;
  const std::vector<MachineCheck> checks = check_machine();
  const bool ready =
      std::all_of(checks.begin(), checks.end(), [](const MachineCheck& c) { return c.ok || !c.required; });
  if (json)
    std::cout << described(checks, ready).dump(2) << '\n';
  else
    for (const MachineCheck& check : checks) std::cout << line(check);
  return ready ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace phos::stage
