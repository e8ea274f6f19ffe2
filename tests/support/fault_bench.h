// Stages hit by faults, and the state that is right afterwards.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "support/faults.h"

namespace phos::test {

enum class Fault {
  killed,
  interrupted,
  terminated,
  full_disk,
  unwritable,
  read_error,
  out_of_memory,
  two_at_once
};
constexpr std::pair<Fault, const char*> kFaults[] = {
    {Fault::killed, "SIGKILL"},          {Fault::interrupted, "SIGINT"},
    {Fault::terminated, "SIGTERM"},      {Fault::full_disk, "full disk"},
    {Fault::unwritable, "unwritable"},   {Fault::read_error, "read error"},
    {Fault::out_of_memory, "no memory"}, {Fault::two_at_once, "two at once"}};

inline std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

inline bool is_temporary(const std::string& name) {
  return name.starts_with(".phos-") && name.ends_with(".tmp");
}

/// The table of a study without its clocks.
inline std::string timeless(const std::string& folder) {
  if (!std::filesystem::exists(folder + "/results.csv")) return "";
  const CsvTable table = parse_csv(slurp(folder + "/results.csv"), "results.csv");
  std::string all;
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& name = table.columns[i];
      const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
      if (!has("seconds") && !has("cpu_s") && !has("peak_bytes") && !has("best_in")) all += row[i] + ",";
    }
  return all;
}

/// Runs stages in a folder of its own, hits them, and judges the files that are left.
class FaultBench {
 public:
  FaultBench() : folder_(scratch("faults")), inputs_(folder_ + "/in"), work_(folder_ + "/work") {
    std::filesystem::create_directories(inputs_), std::filesystem::create_directories(folder_ + "/tmp");
    stages_ = fault_stages(inputs_);
    std::filesystem::permissions(folder_, std::filesystem::perms::all),
        std::filesystem::permissions(folder_ + "/tmp", std::filesystem::perms::all);
  }
  ~FaultBench() { std::filesystem::remove_all(folder_); }
  const std::vector<FaultStage>& stages() const { return stages_; }

  /// Runs the stage without a fault, and keeps the right result, the time and the memory that it takes.
  void learn(const FaultStage& stage) {
    clear("");
    const Outcome run = start(stage, {});
    ASSERT_EQ(run.code, 0) << stage.name << ": " << run.err;
    right_ = result(stage), seconds_ = run.seconds, memory_ = run.peak_address_space;
    ASSERT_FALSE(right_.empty()) << stage.name;
  }

  /// "", or the fault that was found.
  std::string hit(const FaultStage& stage, Fault fault, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform;
    const double moment = uniform(random);
    const bool there = stage.same_bytes && uniform(random) < 0.5;
    const std::string before = there ? "what was there before\n" : "";
    clear(before.empty() ? "" : stage.output, before);
    const Outcome run = strike(stage, fault, moment, random);
    wait_for_orphans(folder_);
    const std::string at = stage.name + " at " + std::to_string(moment) + ", code " +
                           std::to_string(run.code) + " (" + run.err + "): ";
    if (run.hung) return at + "hung";
    if (std::string why = verdict(stage, fault, before, run); !why.empty()) return at + why;
    if (!(stage.same_bytes && strays_.empty())) return again(stage, at);
    return "";
  }

  /// Runs it again where it was hit.
  std::string again(const FaultStage& stage, const std::string& at) {
    const Outcome run = start(stage, {});
    if (run.code != 0) return at + "the rerun fails: " + run.err;
    if (stage.name == "plan" ? result(stage).empty() : result(stage) != right_)
      return at + "the rerun differs";
    for (const std::string& name : names_in(work_))
      if (name != stage.output) return at + "the rerun leaves " + name;
    return "";
  }

 private:
  void clear(const std::string& old, const std::string& bytes = "") {
    strays_.clear();
    for (const std::string& f : {work_, folder_ + "/tmp"}) {
      std::filesystem::remove_all(f), std::filesystem::create_directories(f);
      std::filesystem::permissions(f, std::filesystem::perms::all);
    }
    if (!old.empty())
      spill(work_ + "/" + old, bytes),
          std::filesystem::permissions(work_ + "/" + old, std::filesystem::perms::all);
  }

  Outcome start(const FaultStage& stage, const Hit& h, const std::string& input = "") const {
    std::vector<std::string> words = stage.arguments;
    for (std::string& w : words) {
      if (w == "OUT") w = work_ + "/" + stage.output;
      if (!input.empty() && w == stage.cut) w = input;
    }
    return run_hit(words, folder_, h);
  }

  std::string result(const FaultStage& stage) const {
    const std::string path = work_ + "/" + stage.output;
    return stage.name == "study" ? timeless(path) : slurp(path);
  }

  Outcome strike(const FaultStage& stage, Fault fault, double moment, std::mt19937_64& random) {
    Hit h;
    h.after_s = 1.1 * moment * seconds_;
    switch (fault) {
      case Fault::killed:
      case Fault::interrupted:
      case Fault::terminated: {
        const int signal = fault == Fault::killed ? SIGKILL : fault == Fault::interrupted ? SIGINT : SIGTERM;
        h.action = [=](pid_t pid) { kill(pid, signal); };
        return start(stage, h);
      }
      case Fault::full_disk:
        return on_full_disk(stage, moment);
      case Fault::unwritable: {
        // Rights do not bind root: the tool runs as nobody.
        h.in_child = [] {
          if (getuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(126);
        };
        h.action = [&](pid_t) { std::filesystem::permissions(work_, std::filesystem::perms(0555)); };
        const Outcome run = start(stage, h);
        std::filesystem::permissions(work_, std::filesystem::perms::all);
        return run;
      }
      case Fault::read_error: {
        const std::string copy =
            stage.name == "study"
                ? stage.cut
                : folder_ + "/tmp/cut" + std::filesystem::path(stage.cut).extension().string();
        const std::string bytes = slurp(stage.cut);
        spill(copy, bytes);
        h.action = [&](pid_t) { static_cast<void>(truncate(copy.c_str(), 0)); };
        const Outcome run = start(stage, h, copy);
        stage.name == "study" ? spill(copy, bytes) : static_cast<void>(std::filesystem::remove(copy));
        return run;
      }
      case Fault::out_of_memory: {
        // With less than that the kernel does not get as far as the program.
        const auto most = static_cast<std::uint64_t>((0.03 + 0.97 * moment) * static_cast<double>(memory_));
        h.after_s = -1;
        h.in_child = [=] { limit(RLIMIT_AS, most); };
        Outcome run = start(stage, h);
        // A crash before main(), where a library that is loaded gets no memory, is not ours: then the tool
        // cannot tell its version either.
        if (run.code > 128 && run_hit({stage.name, "--version"}, folder_, h).code > 128) run.code = 127;
        return run;
      }
      case Fault::two_at_once: {
        Outcome other;
        const double later_s = std::uniform_real_distribution<double>(0, 0.5 * seconds_)(random);
        std::thread second([&] {
          std::this_thread::sleep_for(Seconds(later_s));
          std::vector<std::string> words = stage.arguments;
          for (std::string& w : words)
            if (w == "OUT") w = work_ + "/" + stage.output;
          std::filesystem::create_directories(folder_ + "/second/tmp");
          other = run_hit(words, folder_ + "/second", {});
        });
        Outcome run = start(stage, {});
        second.join();
        if (run.code == 0 && other.code != 0) run.code = other.code, run.err = other.err;
        return run;
      }
    }
    return {};
  }

  /// A disk of this many bytes, where one may be mounted; else a limit to the size of files.
  Outcome on_full_disk(const FaultStage& stage, double moment) {
    const std::size_t size =
        stage.name == "study" ? 300000 : slurp(work_ + "/" + stage.output).size() + right_.size();
    const auto room = static_cast<std::uint64_t>(moment * static_cast<double>(size));
    const std::string old = slurp(work_ + "/" + stage.output);
    const std::string options = "size=" + std::to_string(4096 + room);
    if (stage.name == "study" || mount("tmpfs", work_.c_str(), "tmpfs", 0, options.c_str()) != 0) {
      Hit h;
      h.in_child = [=] { limit(RLIMIT_FSIZE, room); };
      return start(stage, h);
    }
    if (!old.empty()) spill(work_ + "/" + stage.output, old);
    const Outcome run = start(stage, {});
    const std::string left =
        std::filesystem::exists(work_ + "/" + stage.output) ? slurp(work_ + "/" + stage.output) : "";
    const std::set<std::string> names = names_in(work_);
    umount(work_.c_str());
    for (const std::string& name : names) spill(work_ + "/" + name, name == stage.output ? left : "");
    return run;
  }

  bool may_end_so(Fault fault, int code, const FaultStage& stage) const {
    if (code == 0) return true;
    // A study goes on without the settings that failed (1), and says what hit a stage (3); 4: a part of it is
    // new.
    const bool of_a_stage = stage.name == "study" && (code == 1 || code == 3 || code == 4);
    switch (fault) {
      case Fault::killed:
        return code == 128 + SIGKILL;
      case Fault::interrupted:
        return code == 130;
      case Fault::terminated:
        return code == 130 || code == 128 + SIGTERM;  // before main() is reached
      case Fault::full_disk:
      case Fault::unwritable:
      case Fault::read_error:
        return code == 3 || of_a_stage;
      case Fault::out_of_memory:
        return code == 6 || code == 127 || of_a_stage ||
               (stage.name == "plan" && code == 3);  // 127: the loader's
      case Fault::two_at_once:
        return of_a_stage;  // one works, the other says so
    }
    return false;
  }

  std::string verdict(const FaultStage& stage, Fault fault, const std::string& before, const Outcome& run) {
    if (!may_end_so(fault, run.code, stage)) return "another exit code";
    const bool told = run.code != 0 && run.code < 126;
    // FLANN has a line of its own when it gets no memory.
    const std::size_t before_last =
        run.err.size() < 2 ? std::string::npos : run.err.rfind('\n', run.err.size() - 2);
    const std::string line = fault == Fault::out_of_memory && before_last != std::string::npos
                                 ? run.err.substr(before_last + 1)
                                 : run.err;
    if (told && stage.same_bytes && !(is_one_line(line) && line.starts_with("phos-" + stage.name + ": ")))
      return "not one line of its own";
    for (const std::string& name : names_in(work_)) {
      if (name == stage.output) continue;
      strays_.insert(name);
      if (stage.name == "temporal" && name == stage.output + ".journal") continue;  // kept, to go on from
      // Who is killed cannot tidy up, nor who may no longer write into the folder; the next run does.
      if (!(fault == Fault::killed || fault == Fault::unwritable) || !is_temporary(name))
        return "leaves " + name;
    }
    if (fault != Fault::killed && fault != Fault::out_of_memory)
      for (const std::string& name : names_in(folder_ + "/tmp"))
        return "leaves " + name + " in the folder for such";
    if (!stage.same_bytes) return "";
    const std::string after = result(stage);
    if (run.code == 0 && after != right_) return "WRONG: done, but not the right bytes";
    if (after != before && after != right_) return "LOST: neither what was there nor the result";
    return "";
  }

  std::string folder_, inputs_, work_;
  std::vector<FaultStage> stages_;
  std::string right_;
  double seconds_ = 0;
  std::uint64_t memory_ = 0;
  std::set<std::string> strays_;
};

}  // namespace phos::test
