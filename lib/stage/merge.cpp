#include "stage/merge.h"

#include <optional>

#include "core/memory.h"
#include "photon/disk/merge_on_disk.h"
#include "photon/photon_map.h"
#include "photon/photon_shards.h"
#include "place/parts.h"

namespace phos::stage {
namespace {

/// Of the program itself: code, threads, what packages hold.
constexpr std::uint64_t kMemoryOfProgram = std::uint64_t{40} << 20;

void tell(Tool& tool, std::size_t shards, const PhotonTotals& totals, bool on_disk) {
  tool.say(text(shards, " shards: ", totals.paths, " paths, ", totals.stored, " photons",
                on_disk ? "; more than --memory holds, so sorted on disk" : ""));
  tool.stat("paths", totals.paths);
  tool.stat("stored", totals.stored);
  tool.stat("on_disk", on_disk);
}

void merge_on_disk(Tool& tool, MergeOnDisk& merge) {
  {
    const Tool::Timer timer = tool.time("sort");
    merge.sort();
  }
  {
    const Tool::Timer timer = tool.time("kdtree");
    merge.build_tree();
  }
  const Tool::Timer timer = tool.time("write");
  merge.write();
}

void merge_photons(Tool& tool, const std::vector<std::string>& shards, const std::string& memory) {
  const std::uint64_t most =
      memory.empty() ? 0 : parse_memory("--memory", memory, kLeastMergeMemory) - kMemoryOfProgram;
  tool.set_key(key_of_merged(shards));
  if (tool.up_to_date()) return;
  if (most > 0) {
    MergeOnDisk merge(shards, tool.output(), most);
    if (merge.totals().stored * kBytesOfMergeInMemory > most) {
      tell(tool, shards.size(), merge.totals(), true);
      merge_on_disk(tool, merge);
      return;
    }
  }
  MergedShards merged = read_shards(shards);
  tell(tool, shards.size(), merged.totals, false);
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
  if (irradiance && !asked.memory.empty())
    throw Error(ExitCode::usage, "--memory",
                "is for shards of photons; parts of irradiance are joined in memory: leave --memory out");
  irradiance ? merge_irradiance(tool, asked.shards) : merge_photons(tool, asked.shards, asked.memory);
}

}  // namespace phos::stage
