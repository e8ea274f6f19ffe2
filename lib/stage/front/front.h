// phos: runs programs by name, explains them, and checks the machine.
#pragma once

namespace phos::stage {

/// The whole program. Returns its exit code, or becomes another program.
int run_front(int argc, const char* const* argv);

}  // namespace phos::stage
