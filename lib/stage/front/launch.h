// Programs beside this one, and on PATH.
#pragma once

#include <string>
#include <vector>

namespace phos::stage {

/// The file that PATH gives for the command `name` (without "/"); "" if there is none.
std::string path_of(const std::string& name);
/// The file of a program of phos: beside this program, else on PATH.
std::string path_of_phos(const std::string& name);

/// Replaces this process by the program of phos of that name. Throws Error(bad_input) where it is not
/// installed, or cannot be started.
[[noreturn]] void launch(const std::string& name, const std::vector<std::string>& arguments);
/// Replaces this process by the program in that file, with the name `name`. Returns where this fails, with
/// errno set.
void replace_by(const std::string& path, const std::string& name, const std::vector<std::string>& arguments);

}  // namespace phos::stage
