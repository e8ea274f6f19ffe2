// What every program shares: common options, progress, provenance, --reuse, --stats, errors to exit codes.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/error.h"
#include "core/facts/programs.h"
#include "core/json.h"
#include "core/options.h"
#include "core/progress.h"
#include "file/container.h"
#include "file/frames.h"

namespace phos::inline file {

/// One run of one program. Typical main:
///
///   Tool tool(program("phos-photons"), "long description", 1);
///   PhotonOptions options;  std::string scene_path;
///   tool.options().input("SCENE", scene_path, "glTF or OBJ scene");
///   declare_options(tool.options(), options);
///   return tool.run(argc, argv, [&] {
///     tool.add_input("scene", scene_files(scene_path));
///     if (tool.up_to_date()) return;
///     const Scene scene = load_scene(scene_path, ...);
///     ...
///     write_photons(map, tool.output(), tool.provenance(FileKind::photons, scene.hash, scene.parts));
///   });
class Tool {
 public:
  enum class Output { none, required, optional };

  /// `algorithm` is raised whenever the same command would give other numbers: it invalidates --reuse.
  Tool(const std::string& name, const std::string& summary, const std::string& description, int algorithm,
       Output output = Output::required);
  /// Of a row of the table of programs.
  Tool(const Program& program, const std::string& description, int algorithm,
       Output output = Output::required);

  Options& options() { return options_; }
  /// Declares the options that programs share. run() does so; call it only for the help of a tool that does
  /// not run.
  void declare_common();

  /// Adds the common options (--threads --seed -o --stats --progress --quiet --verbose --reuse --why ...),
  /// parses, calls body, writes --stats, and turns every exception into one line on stderr and an exit code.
  int run(int argc, const char* const* argv, const std::function<void()>& body);

  /// For a command that can make a sequence, one file for each frame: declares --frames A:B. run() then calls
  /// the body once per frame with `frame` set as --frame does, and output() the name of that frame's file;
  /// inputs, counters and figures begin anew. Each file is the one that --frame N makes: no range is
  /// recorded.
  void takes_frames(std::optional<double>& frame);
  /// Gives every frame these options as they were asked for, where a body fills automatic values in.
  template <class T>
  void fresh_each_frame(T& asked) {
    fresh_.push_back([&asked, first = std::optional<T>()]() mutable {
      if (!first) first = asked;
      asked = *first;
    });
  }
  /// The frames asked for; null: no sequence.
  std::optional<FrameRange> frames() const;
  /// The name of this frame's file of another output (--misses); as it is where there is no sequence, and "".
  std::string frame_path(const std::string& pattern, const std::string& option) const;

  /// A command that worked but whose answer is "no" (phos-compare above a limit) ends with this code.
  void set_exit(ExitCode code) { exit_ = code; }

  std::uint64_t seed() const { return static_cast<std::uint64_t>(seed_); }
  const std::string& output() const { return output_; }
  bool verbose() const { return verbose_; }

  /// Declares --strict: results with a doubt are refused (see doubt(), and tell_losses() of scene/note.h).
  /// `help` describes the option where it differs from other programs. Call before run().
  void takes_strict(const std::string& help = "");
  bool strict() const { return strict_; }
  /// Light that a result lacks, or an error that cannot be stated: a warning; with --strict, which every tool
  /// that says such things takes, Error(numerical) and no output.
  void doubt(const std::string& line) const;

  /// What the program reads besides the files that the command line names (textures of a scene): throws
  /// Error(usage) where an output is among them. add_input() does so.
  void reads(const std::string& role, const std::vector<std::string>& paths) const;
  /// What it writes besides, files of an output folder: throws Error(usage) where one is an input.
  void writes(const std::string& option, const std::string& folder, const std::vector<std::string>& names);

  /// Registers an input by content hash (of several files together where one input is many). A phos
  /// container's own history is appended to ours.
  void add_input(const std::string& role, const std::string& path);
  void add_input(const std::string& role, const std::vector<std::string>& paths);

  /// With --reuse: true if the output already holds the result of this command (then says so, and the caller
  /// returns). With --why: prints the differences to stdout. Call after every add_input and before the
  /// work.
  bool up_to_date();

  /// For outputs that are no phos container (an EXR image): reads how `path` was made, nothing if it does not
  /// say. May throw Error(bad_input), which counts as nothing.
  using ProvenanceReader = std::function<std::optional<Provenance>(const std::string& path)>;
  void set_provenance_reader(ProvenanceReader reader) { provenance_reader_ = std::move(reader); }
  /// For outputs that cannot say how they were made: no --reuse, no --why. Call before run().
  void output_has_no_key() { keyed_ = false; }

  /// What tells this output from others of the same command, though it is no parameter ("shard 1/4"): the key
  /// becomes "key:variant". Call before up_to_date() and provenance().
  void set_variant(const std::string& variant) { variant_ = variant; }
  /// The key of an output that another tool makes too (merged shards are the file of the whole run).
  void set_key(const std::string& key) { asked_key_ = key; }

  /// Header for the output: resolved parameters, inputs, history, key, counters so far.
  Provenance provenance(FileKind kind, const std::string& scene_hash, const Json& scene_parts) const;

  Counters& counters() { return counters_; }
  /// A line for people on stderr, unless --quiet. In a sequence it says which frame, and a line that repeats
  /// is said once.
  void say(const std::string& line) const;
  /// A line on stderr that --quiet does not silence.
  void warn(const std::string& line) const;
  /// A figure for --stats (JSON): times in s, counts, bytes.
  void stat(const std::string& name, Json value) { stats_[name] = std::move(value); }

  /// Times its own life into stats as "seconds.<name>".
  class Timer {
   public:
    Timer(Tool& tool, std::string name);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    double seconds() const;

   private:
    Tool& tool_;
    std::string name_;
    std::chrono::steady_clock::time_point start_;
  };
  Timer time(const std::string& name) { return Timer(*this, name); }

 private:
  void begin();
  void require_frames_of_pattern() const;
  void refuse_shared_files();
  void add_written(const GivenFile& file, const std::string& path);
  void require_not_written(const GivenFile& file, const std::string& path) const;
  std::vector<std::string> files_of(const GivenFile& file) const;
  void run_frames(const std::function<void()>& body);
  void begin_frame(std::int64_t frame, const FramePattern& names);
  int out_of_memory() const;
  int report(const std::string& where, const std::string& message, ExitCode code) const;
  void tell(const std::string& kind, const std::string& line) const;
  void write_stats(double seconds) const;
  std::string key() const;
  bool explain() const;
  std::optional<Provenance> existing_provenance() const;
  std::string name_;
  Options options_;
  int algorithm_;
  Output wants_output_;
  std::int64_t threads_ = 0, seed_ = 0;
  std::string output_, stats_path_, variant_;
  std::string asked_key_;  ///< the key when up_to_date() was called: before automatic values were filled in
  ProvenanceReader provenance_reader_;
  bool keyed_ = true;
  bool quiet_ = false, verbose_ = false, reuse_ = false, why_ = false;
  std::string strict_help_;  ///< empty: no --strict
  bool strict_ = false;
  ProgressMode progress_ = ProgressMode::automatic;
  ExitCode exit_ = ExitCode::done;
  Json stats_;
  Counters counters_;
  std::map<std::string, std::string> inputs_;
  Json history_ = Json::Array{};
  std::map<std::string, GivenFile> written_;  ///< outputs, by their file_key()
  std::set<std::string> grown_;               ///< keys of inputs that the output may replace
  std::string frames_;                        ///< --frames
  std::optional<double>* frame_ = nullptr;    ///< --frame
  std::optional<std::int64_t> at_frame_;
  std::vector<std::function<void()>> fresh_;
  mutable std::set<std::string> said_;
};

/// Largest resident set of this process so far, bytes.
std::uint64_t peak_memory_bytes();

}  // namespace phos::inline file
