#include "file/tool.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>

#include "core/facts/limit.h"
#include "core/interrupt.h"
#include "core/last_words.h"
#include "core/parallel.h"
#include "core/text/standard_streams.h"
#include "file/atomic_file.h"
#include "file/hash.h"
#include "file/mapped_file.h"
#include "file/reuse.h"

namespace phos::inline file {

namespace {

/// Buffers of pictures and photons come and go; pages that the system takes back in between it must clear
/// again, a sixth of a picture's time.
void keep_freed_memory() {
  constexpr int kAll = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, kAll);
  ::mallopt(M_TRIM_THRESHOLD, kAll);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

Tool::Tool(const std::string& name, const std::string& summary, const std::string& description, int algorithm,
           Output output)
    : name_(name),
      options_(name, summary, description),
      algorithm_(algorithm),
      wants_output_(output),
      stats_(Json::Object{}) {
  keep_freed_memory();
  set_program_name(name_);
  install_last_words();
}

Tool::Tool(const Program& program, const std::string& description, int algorithm, Output output)
    : Tool(std::string(program.name), std::string(program.summary), description, algorithm, output) {}

void Tool::declare_common() {
  options_.section("Common options");
  if (wants_output_ != Output::none)
    options_.file("output,o", output_, "file for the result; it appears whole or not at all",
                  FileUse::written, wants_output_ == Output::required);
  options_.integer("threads", threads_, "N", "number of threads; 0: all cores. Results do not depend on it",
                   {0, kMostThreads.as<double>(), false}, Recorded::no);
  options_.integer("seed", seed_, "N", "seed of the random numbers", kNotNegative);
  options_.file("stats", stats_path_, "write times, counts and memory to this file (JSON)", FileUse::written);
  options_.choice<ProgressMode>(
      "progress", progress_,
      {{"auto", ProgressMode::automatic},
       {"always", ProgressMode::always},
       {"never", ProgressMode::never},
       {"json", ProgressMode::json}},
      "progress on standard error; auto: on a terminal alone; json: one object a line", Recorded::no);
  options_.flag("quiet", quiet_, "print nothing but warnings and errors", Recorded::no);
  options_.flag("verbose", verbose_, "print more messages", Recorded::no);
  if (!strict_help_.empty()) options_.flag("strict", strict_, strict_help_, Recorded::no);
  if (wants_output_ == Output::none || !keyed_) return;
  options_.flag("reuse", reuse_, "do nothing if the output already holds exactly this result", Recorded::no);
  options_.flag("why", why_, "print what differs from the existing output, and do nothing else",
                Recorded::no);
}

void Tool::begin() {
  const bool silent = quiet_ && progress_ == ProgressMode::automatic;
  set_progress_mode(silent ? ProgressMode::never : progress_);
  set_threads(static_cast<int>(threads_));
  install_interrupt_handler();
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error of write(), as a full disk is
  if (wants_output_ == Output::required && output_.empty())
    throw Error(ExitCode::usage, "--output", "is empty; name a file for the result");
  require_frames_of_pattern();
  refuse_shared_files();
  if (!stats_path_.empty()) require_writable(stats_path_);
  if (!output_.empty() && !why_ && frames_.empty()) require_writable(output_);
}

int Tool::report(const std::string& where, const std::string& message, ExitCode code) const {
  std::cout.flush();
  std::fflush(stdout);
  std::string line = name_ + ": ";
  if (at_frame_ && code != ExitCode::usage) line += text("frame ", *at_frame_, ": ");
  print_line(line + (where.empty() ? "" : where + ": ") + message);
  return static_cast<int>(code);
}

int Tool::out_of_memory() const {
  const std::uint64_t mebibytes = peak_memory_bytes() >> 20;
  return report("", text("out of memory (", mebibytes, " MiB in use); ask for less, or use a larger machine"),
                ExitCode::no_memory);
}

int Tool::run(int argc, const char* const* argv, const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  occupy_standard_streams();
  install_read_error_handler();
  try {
    declare_common();
    if (options_.parse(argc, argv)) {
      begin();
      if (frames_.empty())
        body();
      else
        run_frames(body);
      if (!stats_path_.empty()) write_stats(seconds_since(start));
    }
    finish_stdout();
    return static_cast<int>(exit_);
  } catch (const Error& e) {
    return report(e.where(), e.what(), e.code());
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  } catch (const std::exception& e) {
    if (for_want_of_memory(e.what())) return out_of_memory();
    return report("", text("internal error: ", e.what(), "; please report it with the command"),
                  ExitCode::bad_input);
  }
}

void Tool::add_input(const std::string& role, const std::string& path) {
  add_input(role, std::vector<std::string>{path});
}

void Tool::add_input(const std::string& role, const std::vector<std::string>& paths) {
  PHOS_CHECK(!paths.empty(), role);
  reads(role, paths);
  std::string unique = role;
  for (int n = 2; inputs_.contains(unique); ++n) unique = text(role, '.', n);
  std::string& hash = inputs_[unique];
  Hasher together;
  for (const std::string& path : paths) {
    hash = hash_file(path).hex();
    together.add(hash);
    if (!is_container(path)) continue;
    const Provenance p = Container::open(path).provenance();
    Json::Array stages = p.history.as_array();
    stages.push_back(history_entry(p));
    const Json::Array& known = history_.as_array();
    for (const Json& stage : stages)
      if (std::find(known.begin(), known.end(), stage) == known.end()) history_.push_back(stage);
  }
  if (paths.size() > 1) hash = together.finish().hex();
}

std::string Tool::key() const {
  if (!asked_key_.empty()) return asked_key_;
  Hasher hasher;
  hasher.add(name_);
  hasher.add(algorithm_);
  hasher.add(options_.recorded().dump());
  for (const auto& [role, hash] : inputs_) {
    hasher.add(role);
    hasher.add(hash);
  }
  const std::string hex = hasher.finish().hex();
  return variant_.empty() ? hex : hex + ':' + variant_;
}

std::optional<Provenance> Tool::existing_provenance() const {
  if (is_container(output_)) return Container::open(output_).provenance();
  if (provenance_reader_ && ::access(output_.c_str(), R_OK) == 0) return provenance_reader_(output_);
  return std::nullopt;
}

bool Tool::up_to_date() {
  asked_key_ = key();
  if (output_.empty() || (!reuse_ && !why_)) return false;
  if (why_) return explain();
  std::string existing;
  try {
    if (const std::optional<Provenance> then = existing_provenance()) existing = then->key;
  } catch (const Error&) {
    return false;  // damaged or of another version: it is made anew
  }
  if (existing != asked_key_) return false;
  say(output_ + ": up to date");
  return true;
}

bool Tool::explain() const {
  std::vector<std::string> lines;
  try {
    if (::access(output_.c_str(), F_OK) != 0) {
      lines.push_back("not there");
    } else if (const std::optional<Provenance> then = existing_provenance(); !then) {
      lines.push_back("does not say how it was made");
    } else if (then->key != asked_key_) {
      lines = differences(*then, provenance(then->kind, "", {}));
      if (lines.empty())
        lines.push_back(
            text("key: ", then->key, " -> ", asked_key_, " (another shard, or an automatic parameter)"));
    }
  } catch (const Error& e) {
    lines.push_back(e.what());
  }
  for (const std::string& line : lines) std::cout << output_ << ": " << line << '\n';
  if (lines.empty()) std::cout << output_ << ": nothing differs\n";
  return true;
}

Provenance Tool::provenance(FileKind kind, const std::string& scene_hash, const Json& scene_parts) const {
  Provenance p;
  p.kind = kind;
  p.tool = text(name_, ' ', phos::version());
  p.algorithm = algorithm_;
  p.command = options_.command();
  p.parameters = options_.recorded();
  p.inputs = inputs_;
  p.scene_hash = scene_hash;
  p.scene_parts = scene_parts;
  p.history = history_;
  p.key = key();
  p.counters = counters_;
  return p;
}

void Tool::tell(const std::string& kind, const std::string& line) const {
  if (at_frame_ && !said_.insert(line).second) return;
  print_line(text(name_, ": ", kind, at_frame_ ? text("frame ", *at_frame_, ": ") : "", line));
}

void Tool::say(const std::string& line) const {
  if (!quiet_) tell("", line);
}

void Tool::warn(const std::string& line) const { tell("warning: ", line); }

void Tool::takes_strict(const std::string& help) {
  strict_help_ = !help.empty()
                     ? help
                     : "end without output: with code 3 if something in the scene is lost or replaced, with "
                       "code 5 if light is known to be left out or the stated error cannot be trusted";
}

void Tool::doubt(const std::string& line) const {
  if (strict_) throw Error(ExitCode::numerical, "", line);
  warn(line);
}

void Tool::write_stats(double seconds) const {
  Json out = stats_;
  out["tool"] = text(name_, ' ', phos::version());
  out["command"] = options_.command();
  out["exit_code"] = static_cast<int>(exit_);
  out["threads"] = thread_count();
  out["seconds.total"] = seconds;
  out["peak_memory_bytes"] = peak_memory_bytes();
  Json counters(Json::Object{});
  for (const auto& [event, n] : counters_.counts()) counters[event] = n;
  out["counters"] = counters;
  AtomicFile file(stats_path_);
  file.write(out.dump(2) + "\n");
  file.commit();
}

Tool::Timer::Timer(Tool& tool, std::string name)
    : tool_(tool), name_(std::move(name)), start_(std::chrono::steady_clock::now()) {}

Tool::Timer::~Timer() { tool_.stat("seconds." + name_, seconds()); }

double Tool::Timer::seconds() const { return seconds_since(start_); }

}  // namespace phos::inline file
