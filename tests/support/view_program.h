// A phos-view that serves, on a port of its own.
#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "support/run.h"

namespace phos::test {

class ViewProgram {
 public:
  explicit ViewProgram(std::vector<std::string> inputs) : process_(arguments(std::move(inputs))) {
    for (int tries = 0; tries < 6000 && url().empty(); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ~ViewProgram() {
    if (!ended_) process_.signal(SIGKILL), process_.wait();
  }
  ViewProgram(const ViewProgram&) = delete;
  ViewProgram& operator=(const ViewProgram&) = delete;

  /// "http://127.0.0.1:PORT/"; "" if it did not come.
  std::string url() const {
    const std::string out = process_.out();
    return out.ends_with("/\n") ? out.substr(0, out.size() - 1) : "";
  }
  unsigned port() const {
    const std::string url = this->url();
    return url.empty() ? 0 : static_cast<unsigned>(std::stoul(url.substr(url.rfind(':') + 1)));
  }
  /// By Ctrl-C.
  Run end() {
    process_.signal(SIGINT);
    ended_ = true;
    return process_.wait();
  }

 private:
  static std::vector<std::string> arguments(std::vector<std::string> inputs) {
    inputs.insert(inputs.begin(), "view");
    inputs.insert(inputs.end(), {"--port", "0"});
    return inputs;
  }
  Process process_;
  bool ended_ = false;
};

}  // namespace phos::test
