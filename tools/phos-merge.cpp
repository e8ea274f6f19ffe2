// phos-merge: joins the shards of a run to the file of the whole run.
#include "stage/merge.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-merge"),
            "Takes every shard of one run of phos-photons (--shard 1/N ... N/N), or every part of one run of "
            "phos-irradiance (--place every --part 1/N ... N/N), in any order, and writes the file that the "
            "same command without --shard or --part writes: the same bytes, header included. Shards of other "
            "runs, shards given twice and missing shards are errors that name them. Kinds merged: photons, "
            "irradiance.",
            stage::kMergeAlgorithm);
  stage::MergeCommand asked;
  tool.options().inputs("SHARD", asked.shards, "all shards of one run, in any order");
  tool.options().text(
      "memory", asked.memory, "SIZE",
      "most memory to take for shards of photons, such as 2G, at least 64M; more photons than "
      "fit are sorted on disk, in temporary files beside the output of about twice its size "
      "(default: as much memory as it takes)",
      Recorded::no);
  tool.options().example("phos-merge a.photons b.photons -o room.photons",
                         "joins the files of --shard 1/2 and 2/2");
  tool.options().example("phos-merge a.irradiance b.irradiance -o room.irradiance",
                         "joins the files of --part 1/2 and 2/2");
  tool.options().example("phos-merge *.photons --memory 2G -o town.photons",
                         "joins shards whose photons do not fit in memory");
  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
