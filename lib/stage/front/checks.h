// The requirements that programs of phos have of a machine, checked one by one.
#pragma once

#include <string>
#include <vector>

namespace phos::stage {

struct MachineCheck {
  std::string name;
  bool ok = false;
  bool required = false;  ///< a default setting of some program fails without it
  std::string found;      ///< where not ok: the fault, and the uses that fail by it
  std::string remedy;     ///< where not ok: a command, or words
};

/// Every check, in the order in which they are printed. Starts programs and, in processes of their own,
/// OSMesa and EGL. Call it while this process has one thread.
std::vector<MachineCheck> check_machine();

}  // namespace phos::stage
