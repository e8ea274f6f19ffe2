// A study as its file asks for it: which scenes, which stages, which values of their options.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "study/command.h"
#include "study/spec/toml.h"

namespace phos::inline study {

/// An option of a stage that takes several values in turn.
struct Factor {
  std::string section, option;
  std::vector<std::string> labels;              ///< each value as the study writes it
  std::vector<std::vector<std::string>> words;  ///< each on the command line
  std::size_t line = 0;                         ///< of the file
  std::string name() const { return section + "." + option; }
};

/// A reference that was made before: one file, or two of different seeds.
struct GivenReference {
  std::string scene, camera;               ///< "": all, of which there must be one
  std::vector<std::string> pictures, lux;  ///< paths; empty: it is made
  std::string where;
};

struct StudyFile {
  std::string path, folder;
  std::vector<std::string> scenes, cameras;  ///< cameras: at least one; "" is the scene's first
  std::vector<std::int64_t> seeds;           ///< one for each repeat
  std::string sensors;                       ///< CSV of points; "": no lux is asked for
  std::string layer = "beauty";
  bool ignore_lamps = true;
  std::int64_t threads = 0;
  double confidence = 0.95;
  bool by_cpu =
      false;  ///< time = "cpu": fronts and effects are of processor time, which other work disturbs less
  std::optional<std::int64_t> width, height;  ///< pixels

  std::set<std::string> sections;  ///< stages that run
  /// Words of the options with one value, by section; "common" holds for every stage that takes them.
  std::map<std::string, std::vector<std::string>> fixed;
  std::vector<Factor> factors;  ///< in the order of the file
  std::set<std::string> files;  ///< words that are paths of files to be read

  std::vector<std::string> reference;               ///< words for phos-reference
  std::vector<std::int64_t> reference_seeds{1, 2};  ///< one or two
  std::optional<std::int64_t> sensor_samples;       ///< of phos-reference at points
  std::vector<GivenReference> given;

  bool makes_pictures() const { return sections.contains("splat"); }
  bool reads_sensors() const { return !sensors.empty(); }
};

/// `camera = "each"` in a stage before phos-splat: the view's own.
inline constexpr const char* kEachCamera =
    "\x01"
    "camera";

/// Reads and checks all that can be checked without opening a scene. Throws Error(bad_input) for a file that
/// is no TOML or is missing; Error(usage), naming line and key, for an unknown section or option (with the
/// nearest name), a value that the program would refuse, a list that is empty or repeats itself, a range that
/// contradicts itself, and a study that asks for nothing.
StudyFile read_study(const std::string& path, const CommandRunner& runner);

}  // namespace phos::inline study
