// A study that ends in seconds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "file/csv.h"
#include "support/run.h"

namespace phos::test {

inline const std::string kToyStages =
    "[reference]\nsamples = 16\nsensor_samples = 64\n"
    "[photons]\nphotons = [2000, 8000]\n[irradiance]\naccuracy = [0.2, 0.5]\n[splat]\npixel_samples = 1\n";

/// A folder with the toy scene and its study.
inline std::string toy_study(const std::string& name, const std::string& more = "",
                             const std::string& stages = kToyStages) {
  const std::string folder = scratch("study-" + name);
  std::filesystem::copy_file(data("cornell-empty.glb"), folder + "/box.glb");
  spill(folder + "/points.csv", "x,y,z,nx,ny,nz\n0.3,0.1,0.1,0,1,0\n0.4,0.2,0.2,0,1,0\n0.2,0.3,0.3,1,0,0\n");
  spill(folder + "/toy.toml",
        "[study]\nscenes = \"box.glb\"\nwidth = 24\nrepeats = 2\nthreads = 1\n" + more + stages);
  return folder;
}

inline Run study(const std::string& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"study", folder + "/toy.toml", "-o", folder + "/out"};
  words.insert(words.end(), more.begin(), more.end());
  return run_tool(words);
}

inline CsvTable results(const std::string& folder) {
  return parse_csv(slurp(folder + "/out/results.csv"), "results.csv");
}

}  // namespace phos::test
