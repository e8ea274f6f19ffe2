// Every stage of the pipeline as a short command. The files that it reads are made once.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/run.h"
#include "support/study.h"

namespace phos::test {

struct FaultStage {
  std::string name;
  std::vector<std::string> arguments;  ///< OUT stands for the output
  std::string cut;                     ///< the input that a read error hits
  std::string output;                  ///< its name
  /// The same bytes each time. Not so where clocks decide (a plan) or are told (a study, whose output is a
  /// folder).
  bool same_bytes = true;
};

/// Makes the inputs in `folder` and returns the commands, in the order in which they build on each other.
inline std::vector<FaultStage> fault_stages(const std::string& folder) {
  const auto in = [&](const std::string& name) { return folder + "/" + name; };
  const std::string room = in("room.glb"), film = in("film.glb");
  std::filesystem::copy_file(data("cornell-glossy22.glb"), room);
  std::filesystem::copy_file(data("moving-light.glb"), film);
  std::filesystem::copy_file(data("cornell-empty.glb"), in("box.glb"));
  spill(in("points.csv"), "x,y,z,nx,ny,nz\n0.3,0.001,0.1,0,1,0\n0.4,0.001,0.2,0,1,0\n0.2,0.001,0.3,0,1,0\n");
  spill(in("toy.toml"),
        "[study]\nscenes = \"box.glb\"\nwidth = 16\nrepeats = 1\nthreads = 1\n[reference]\nsamples = 4\n"
        "[photons]\nphotons = [500, 1000]\n[irradiance]\naccuracy = [0.6]\n[splat]\npixel_samples = 1\n");
  const auto make = [&](std::vector<std::string> words, const std::string& name) {
    words.insert(words.end(), {"--quiet", "-o", in(name)});
    const Run run = run_tool(words);
    EXPECT_EQ(run.code, 0) << words[0] << ": " << run.err;
  };
  const std::vector<std::string> photons{"photons", room, "--photons", "30000"};
  make(photons, "room.photons");
  for (const std::string shard : {"1", "2"})
    make({"photons", room, "--photons", "30000", "--shard", shard + "/2"}, "part" + shard + ".photons");
  for (const std::string shard : {"1", "2"})
    make({"photons", room, "--photons", "200000", "--caustic-photons", "0", "--shard", shard + "/2"},
         "many" + shard + ".photons");
  make({"brdf", room, "--resolution", "8"}, "room.brdf");
  make({"irradiance", room, in("room.photons"), "--accuracy", "0.6"}, "room.irradiance");
  make({"radiance", room, in("room.photons"), in("room.brdf"), "--accuracy", "0.9"}, "room.radiance");
  for (const std::string seed : {"1", "2"})
    make({"reference", room, "--width", "64", "--samples", "1", "--seed", seed}, "picture" + seed + ".exr");

  const auto stage = [](std::vector<std::string> words, const std::string& cut, const std::string& output) {
    words.insert(words.end(), {"--quiet", "-o", "OUT"});
    return FaultStage{words[0], words, cut, output};
  };
  std::vector<FaultStage> all;
  all.push_back(stage(photons, room, "o.photons"));
  all.push_back(stage({"merge", in("part1.photons"), in("part2.photons")}, in("part2.photons"), "o.photons"));
  // More photons than 64 MiB hold.
  all.push_back(stage({"merge", in("many1.photons"), in("many2.photons"), "--memory", "64M"},
                      in("many2.photons"), "o.photons"));
  all.push_back(stage({"brdf", room, "--resolution", "12"}, room, "o.brdf"));
  all.push_back(stage({"irradiance", room, in("room.photons"), "--accuracy", "0.6"}, in("room.photons"),
                      "o.irradiance"));
  all.push_back(stage({"radiance", room, in("room.photons"), in("room.brdf"), "--accuracy", "0.9"},
                      in("room.photons"), "o.radiance"));
  all.push_back(stage({"temporal", film, "--frames", "0:2", "--rays", "16", "--photons", "2000", "--width",
                       "16", "--accuracy", "0.6"},
                      film, "o.irradiance"));
  all.push_back(stage({"splat", room, in("room.irradiance"), in("room.radiance"), in("room.brdf"), "--width",
                       "32", "--pixel-samples", "1"},
                      in("room.radiance"), "o.exr"));
  all.push_back(stage({"sense", room, in("room.irradiance"), "--points", in("points.csv")},
                      in("room.irradiance"), "o.csv"));
  all.push_back(stage({"reference", room, "--width", "32", "--samples", "16"}, room, "o.exr"));
  all.push_back(stage({"picture", in("picture1.exr")}, in("picture1.exr"), "o.png"));
  all.push_back({"compare",
                 {"compare", in("picture1.exr"), in("picture2.exr"), "--quiet", "--difference", "OUT"},
                 in("picture2.exr"),
                 "o.png"});
  all.push_back(stage({"plan", in("box.glb"), "--error", "50%", "--width", "24", "--pilot-seconds", "1"},
                      in("box.glb"), "plan.sh"));
  all.back().same_bytes = false;
  all.push_back(stage({"study", in("toy.toml")}, in("box.glb"), "study"));
  all.back().same_bytes = false;
  return all;
}

}  // namespace phos::test
