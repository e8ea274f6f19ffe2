// Joins the shards of one run to the file of the whole run.
#include <optional>

#include "file/tool.h"
#include "photon/photon_file.h"
#include "photon/photon_map.h"

using namespace phos;

int main(int argc, char** argv) {
  Tool tool("phos-merge", "joins the shards of a run into the file that the whole run would have made",
            "Takes every shard of one run of phos-photons (--shard 1/N ... N/N), in any order, and writes "
            "the map that the "
            "same command without --shard writes: the same bytes, header included. Shards of other runs, "
            "shards given twice "
            "and missing shards are errors that name them. Kinds merged: photons.",
            1);
  std::vector<std::string> shards;
  tool.options().inputs("SHARD", shards, "all shards of one run, in any order");
  tool.options().example("phos-merge a.photons b.photons -o room.photons",
                         "joins the files of --shard 1/2 and 2/2");
  return tool.run(argc, argv, [&] {
    tool.set_key(key_of_merged(shards));
    if (tool.up_to_date()) return;
    MergedShards merged = read_shards(shards);
    tool.say(
        text(shards.size(), " shards: ", merged.totals.paths, " paths, ", merged.totals.stored, " photons"));
    tool.stat("paths", merged.totals.paths);
    tool.stat("stored", merged.totals.stored);
    std::optional<PhotonMap> map;
    {
      const Tool::Timer timer = tool.time("kdtree");
      map = PhotonMap::build(std::move(merged.photons), merged.totals);
    }
    const Tool::Timer timer = tool.time("write");
    map->write(tool.output(), merged.provenance);
  });
}
