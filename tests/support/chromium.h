// One Chromium without a screen, driven by the DevTools protocol: pages are done when they say so.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/json.h"
#include "file/json_parse.h"
#include "support/run.h"

namespace phos::test {

struct Shown {
  std::string page;     ///< its text at the end, without its scripts
  std::string console;  ///< what it said
};

class Chromium {
 public:
  /// With these words more on its command line.
  explicit Chromium(const std::vector<std::string>& more = {}) : folder_(scratch("chromium")) {
    std::vector<std::string> words = {"chromium",
                                      "--headless=new",
                                      "--no-sandbox",
                                      "--use-angle=swiftshader",
                                      "--enable-unsafe-swiftshader",
                                      "--disable-dev-shm-usage",
                                      "--disable-background-networking",
                                      "--disable-background-timer-throttling",
                                      "--disable-backgrounding-occluded-windows",
                                      "--disable-renderer-backgrounding",
                                      "--disable-component-update",
                                      "--disable-sync",
                                      "--no-first-run",
                                      "--window-size=480,360",
                                      "--user-data-dir=" + folder_ + "/profile",
                                      "--remote-debugging-pipe"};
    words.insert(words.end(), more.begin(), more.end());
    int ends[2] = {-1, -1};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    // Beyond the numbers that the browser takes.
    const int its = fcntl(ends[1], F_DUPFD_CLOEXEC, 10);
    socket_ = ends[0];
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      const int log = ::open((folder_ + "/log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      dup2(log, 1), dup2(log, 2);
      dup2(its, 3), dup2(its, 4);
      execvp(argv[0], argv.data());
      _exit(127);
    }
    close(its), close(ends[1]);
    reader_ = std::thread([this] { read(); });
  }
  ~Chromium() {
    {
      const std::lock_guard lock(mutex_);
      send(R"({"id":0,"method":"Browser.close"})");
    }
    int tries = 0;
    while (waitpid(pid_, nullptr, WNOHANG) == 0) {
      if (++tries == 1000) kill(pid_, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    shutdown(socket_, SHUT_RDWR);
    reader_.join();
    close(socket_);
    std::error_code ignored;  // a last process may be writing its profile
    std::filesystem::remove_all(folder_, ignored);
  }
  Chromium(const Chromium&) = delete;
  Chromium& operator=(const Chromium&) = delete;

  /// The page at an address, once the promise of an expression, awaited in the page, is kept. Several threads
  /// may open pages at once; none of these knows of another.
  Shown open(const std::string& url, const std::string& promise) {
    const std::string own = text_at(call("Target.createBrowserContext", {}), {"browserContextId"});
    const std::string target = text_at(
        call("Target.createTarget", {{"url", "about:blank"}, {"browserContextId", own}, {"newWindow", true}}),
        {"targetId"});
    const std::string session =
        text_at(call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}}), {"sessionId"});
    for (const char* domain : {"Runtime.enable", "Log.enable", "Page.enable"}) call(domain, {}, session);
    call("Page.setLifecycleEventsEnabled", {{"enabled", true}}, session);
    const Json navigated = call("Page.navigate", {{"url", url}}, session);
    EXPECT_EQ(text_at(navigated, {"errorText"}), "") << url;
    const std::string loader = text_at(navigated, {"loaderId"});
    EXPECT_TRUE(wait([&] { return loaded_.contains(loader); })) << url << " does not load";
    call("Runtime.evaluate", {{"expression", promise}, {"awaitPromise", true}}, session);
    const Json whole =
        call("Runtime.evaluate",
             {{"expression",
               "(() => { const all = document.documentElement.cloneNode(true);"
               " all.querySelectorAll('script').forEach((s) => s.remove()); return all.outerHTML; })()"},
              {"returnByValue", true}},
             session);
    Shown shown{text_at(whole, {"result", "value"}), ""};
    {
      const std::lock_guard lock(mutex_);
      shown.console = said_[session];
    }
    call("Target.disposeBrowserContext", {{"browserContextId", own}});
    return shown;
  }

 private:
  static constexpr std::chrono::seconds kPatience{180};

  /// "" where there is no such text.
  static std::string text_at(const Json& json, const std::vector<std::string>& names) {
    const Json* at = &json;
    for (const std::string& name : names)
      if ((at = at->find(name)) == nullptr) return "";
    return at->is_string() ? at->as_string() : "";
  }

  template <class Condition>
  bool wait(Condition condition) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return ended_ || condition(); }) && !ended_;
  }
  /// The result of a method; null, and a failure, where there is none.
  Json call(const std::string& method, const Json::Object& parameters, const std::string& session = "") {
    Json question = Json::Object{};
    std::int64_t id = 0;
    {
      const std::lock_guard lock(mutex_);
      id = ++last_;
      question["id"] = id, question["method"] = method, question["params"] = parameters;
      if (!session.empty()) question["sessionId"] = session;
      send(question.dump());
    }
    if (!wait([&] { return answers_.contains(id); })) {
      ADD_FAILURE() << method << " has no answer; the browser said: " << slurp(folder_ + "/log");
      return {};
    }
    const std::lock_guard lock(mutex_);
    const Json answer = std::move(answers_.extract(id).mapped());
    if (const Json* result = answer.find("result")) return *result;
    ADD_FAILURE() << method << ": " << answer.dump();
    return {};
  }
  void send(const std::string& message) const {
    const std::size_t size = message.size() + 1;  // a zero byte ends it
    for (std::size_t done = 0; done < size;) {
      const ssize_t n = ::send(socket_, message.c_str() + done, size - done, MSG_NOSIGNAL);
      if (n <= 0) return;
      done += static_cast<std::size_t>(n);
    }
  }
  void read() {
    std::string bytes;
    std::vector<char> part(1 << 16);
    for (ssize_t n = 0; (n = recv(socket_, part.data(), part.size(), 0)) > 0;) {
      std::size_t from = bytes.size();
      bytes.append(part.data(), static_cast<std::size_t>(n));
      for (std::size_t end = 0; (end = bytes.find('\0', from)) != std::string::npos; from = 0) {
        take(parse_json(std::string_view(bytes).substr(0, end), "DevTools"));
        bytes.erase(0, end + 1);
      }
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  void take(Json message) {
    const std::lock_guard lock(mutex_);
    const std::string method = text_at(message, {"method"}), session = text_at(message, {"sessionId"});
    if (const Json* id = message.find("id"))
      answers_[id->as_integer()] = std::move(message);
    else if (method == "Page.lifecycleEvent" && text_at(message, {"params", "name"}) == "load")
      loaded_.insert(text_at(message, {"params", "loaderId"}));
    else if (method == "Runtime.consoleAPICalled" || method == "Runtime.exceptionThrown" ||
             method == "Log.entryAdded") {
      // Chromium's own advice on speed ("GPU stall due to ReadPixels") is none of the page's words.
      const std::string words = message.dump();
      if (words.find("GL Driver Message") == std::string::npos) said_[session] += words + "\n";
    }
    changed_.notify_all();
  }

  std::string folder_;
  int socket_ = -1;
  pid_t pid_ = -1;
  std::thread reader_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t last_ = 0;
  std::map<std::int64_t, Json> answers_;
  std::set<std::string> loaded_;             ///< documents, by their loaders
  std::map<std::string, std::string> said_;  ///< by sessions
  bool ended_ = false;
};

}  // namespace phos::test
