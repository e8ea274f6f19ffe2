// Joins the shards of one run to the file of the whole run.
#include <optional>

#include "file/tool.h"
#include "photon/photon_file.h"
#include "photon/photon_map.h"
#include "place/parts.h"

using namespace phos;

namespace {

void merge_photons(Tool& tool, const std::vector<std::string>& shards) {
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
}

void merge_irradiance(Tool& tool, const std::vector<std::string>& parts) {
  tool.set_key(key_of_merged_parts(parts));
  if (tool.up_to_date()) return;
  MergedParts merged;
  {
    const Tool::Timer timer = tool.time("radii");
    merged = read_parts(parts);
  }
  tool.say(text(parts.size(), " parts: ", merged.cache.records.size(), " records"));
  tool.stat("records", merged.cache.records.size());
  const Tool::Timer timer = tool.time("write");
  write_irradiance(tool.output(), merged.cache, merged.provenance);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-merge", "joins the shards of a run into the file that the whole run would have made",
            "Takes every shard of one run of phos-photons (--shard 1/N ... N/N), or every part of one run of "
            "phos-irradiance (--place every --part 1/N ... N/N), in any order, and writes the file that the "
            "same command without --shard or --part writes: the same bytes, header included. Shards of other "
            "runs, shards given twice and missing shards are errors that name them. Kinds merged: photons, "
            "irradiance.",
            1);
  std::vector<std::string> shards;
  tool.options().inputs("SHARD", shards, "all shards of one run, in any order");
  tool.options().example("phos-merge a.photons b.photons -o room.photons",
                         "joins the files of --shard 1/2 and 2/2");
  tool.options().example("phos-merge a.irradiance b.irradiance -o room.irradiance",
                         "joins the files of --part 1/2 and 2/2");
  return tool.run(argc, argv, [&] {
    for (const std::string& path : shards)
      if (records_of(Container::open(path)) == RecordsOf::film)
        throw Error(
            ExitCode::usage, path,
            "is a film, which has no parts; phos-merge joins shards of photons and parts of irradiance");
    const bool irradiance = Container::open(shards.front()).provenance().kind == "irradiance";
    irradiance ? merge_irradiance(tool, shards) : merge_photons(tool, shards);
  });
}
