// Runs the shell scripts of pipelines/ with the built programs first on PATH.
#pragma once

#include <cstdlib>

#include "support/run.h"

namespace phos::test {

inline std::string quoted(const std::string& word) {
  std::string s(1, '\'');
  for (const char c : word) {
    if (c == '\'') s += "'\\'";  // leaves the quotes, a quote, and the one below enters them again
    s += c;
  }
  s += '\'';
  return s;
}

/// `words` as one command of bash, in `folder`.
inline Run run_shell(const std::vector<std::string>& words, const std::string& folder) {
  std::string command("cd ");
  command.append(quoted(folder)).append(" && PATH=").append(quoted(PHOS_TOOLS));
  command.append(":\"$PATH\" MESA_SHADER_CACHE_DISABLE=true");
  for (const std::string& word : words) command.append(" ").append(quoted(word));
  command.append(" >.out 2>.err </dev/null");
  const int status = std::system(command.c_str());
  Run run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = slurp(folder + "/.out"), run.err = slurp(folder + "/.err");
  return run;
}

/// pipelines/<name> with arguments.
inline Run run_script(const std::string& name, const std::vector<std::string>& arguments,
                      const std::string& folder) {
  std::vector<std::string> words = {"bash", std::string(PHOS_SOURCE) + "/pipelines/" + name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_shell(words, folder);
}

}  // namespace phos::test
