#include "photon/photon_shards.h"

#include "core/error.h"

namespace phos::inline photon {
namespace {

const ShardKind kKind{FileKind::photons, FileForm::shard, "map", "phos-photons --shard i/n"};

void require_same_totals(const std::vector<PhotonShard>& shards) {
  const PhotonShard& a = shards.front();
  std::uint64_t path = 0;
  for (const PhotonShard& b : shards) {
    if (a.totals.emitted != b.totals.emitted || a.totals.flux_exponent != b.totals.flux_exponent)
      refuse_other_run(a.shard, b.shard, kKind, "other totals");
    if (a.totals.stored > 0 && b.totals.stored > 0 && a.columns.family.empty() != b.columns.family.empty())
      refuse_other_run(a.shard, b.shard, kKind, "other columns");
    if (b.totals.first_path != path)
      throw Error(ExitCode::mismatch, b.shard.file.path(),
                  text("starts at path ", b.totals.first_path, ", where ", path,
                       " comes next; make the shards again"));
    path += b.totals.paths;
  }
  if (path != a.totals.emitted)
    throw Error(ExitCode::mismatch, "",
                text("the shards hold ", path, " of ", a.totals.emitted, " paths; make them again"));
}

}  // namespace

std::vector<PhotonShard> open_photon_shards(const std::vector<std::string>& paths) {
  std::vector<PhotonShard> shards;
  for (Shard& shard : open_shards(paths, kKind)) {
    const PhotonColumns columns = columns_of(shard.file);
    const PhotonTotals totals = totals_of(shard.file, columns.position.size());
    shards.push_back({std::move(shard), columns, totals});
  }
  require_same_totals(shards);
  return shards;
}

void write_shard(const std::string& path, const Photons& photons, const PhotonTotals& totals,
                 const std::string& shard, Provenance provenance) {
  describe_map(provenance, totals, bounds_to_json(photons.position));
  provenance.extra[kKind.word()] = shard;
  TensorWriter writer(FileKind::photons);
  add_columns(writer, columns_of(photons));
  writer.write(path, provenance);
}

std::string key_of_merged(const std::vector<std::string>& paths) {
  return key_of_whole(open_photon_shards(paths).front().shard.file.provenance());
}

MergedHeader header_of_merged(const std::vector<PhotonShard>& shards) {
  MergedHeader merged;
  merged.provenance = shards.front().shard.file.provenance();
  merged.provenance.key = key_of_whole(merged.provenance);
  merged.provenance.extra = Json();
  merged.provenance.counters = Counters();
  merged.totals.emitted = shards.front().totals.emitted;
  merged.totals.flux_exponent = shards.front().totals.flux_exponent;
  for (const PhotonShard& s : shards) {
    add_totals(merged.totals, s.totals);
    merged.provenance.counters.merge(s.shard.file.provenance().counters);
    merged.has_families = merged.has_families || !s.columns.family.empty();
  }
  return merged;
}

MergedShards read_shards(const std::vector<std::string>& paths) {
  std::vector<PhotonShard> shards = open_photon_shards(paths);
  MergedHeader header = header_of_merged(shards);
  MergedShards merged{{}, header.totals, std::move(header.provenance)};
  Photons& p = merged.photons;
  for_columns([&](auto& column) { column.reserve(static_cast<std::size_t>(merged.totals.stored)); }, p);
  for (PhotonShard& open : shards) {
    const PhotonShard s = std::move(open);  // its mapping goes once it is copied
    s.shard.file.require_sound();
    const PhotonColumns& c = s.columns;
    for_columns([](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); }, p, c);
    p.family.insert(p.family.end(), c.family.begin(), c.family.end());
    append(p.flights, c.flights);
  }
  return merged;
}

}  // namespace phos::inline photon
