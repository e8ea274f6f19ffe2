#include "stage/merge.h"

#include <optional>

#include "photon/photon_map.h"
#include "photon/photon_shards.h"
#include "place/parts.h"

namespace phos::stage {
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

void run(Tool& tool, const MergeCommand& asked) {
  for (const std::string& path : asked.shards)
    if (Container::open(path).form() == FileForm::film)
      throw Error(
          ExitCode::usage, path,
          "is a film, which has no parts; phos-merge joins shards of photons and parts of irradiance");
  const bool irradiance = Container::open(asked.shards.front()).kind() == FileKind::irradiance;
  irradiance ? merge_irradiance(tool, asked.shards) : merge_photons(tool, asked.shards);
}

}  // namespace phos::stage
