// Shards: the parts of one run, and their union.
#include <algorithm>
#include <cstdlib>

#include "core/error.h"
#include "photon/photon_file.h"

namespace phos {
namespace {

struct Shard {
  Container file;
  std::string name;  // "i/n"
  std::uint64_t index = 0, count = 0;
  PhotonColumns columns;
  PhotonTotals totals;
};

// "i/n" with 1 <= i <= n.
bool parse(const std::string& s, std::uint64_t& index, std::uint64_t& count) {
  char* end = nullptr;
  index = std::strtoull(s.c_str(), &end, 10);
  if (*end != '/') return false;
  count = std::strtoull(end + 1, &end, 10);
  return *end == '\0' && index >= 1 && index <= count;
}

Shard open_shard(const std::string& path) {
  Shard s{Container::open(path), {}, 0, 0, {}, {}};
  const Provenance& p = s.file.provenance();
  if (p.kind != "photons")
    throw Error(ExitCode::bad_input, path,
                text("is \"", p.kind, "\"; phos-merge joins shards of \"photons\""));
  const Json* name = p.extra.find("shard");
  if (!name || !name->is_string())
    throw Error(ExitCode::bad_input, path,
                "is a whole map already, not a shard (phos-photons --shard i/n makes shards)");
  s.name = name->as_string();
  if (!parse(s.name, s.index, s.count))
    throw Error(ExitCode::bad_input, path, "the header does not say which shard it is; make it again");
  s.columns = columns_of(s.file);
  s.totals = totals_of(s.file, s.columns.position.size());
  return s;
}

// A shard's key is that of the whole with ":shard i/n" behind it.
std::string key_of_whole(const Provenance& p) { return p.key.substr(0, p.key.find(':')); }

void require_same_run(const Shard& a, const Shard& b) {
  const Provenance &p = a.file.provenance(), &q = b.file.provenance();
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitCode::mismatch, b.file.path(),
                text("is of another run than ", a.file.path(), " (", what,
                     "); shards of one run differ in --shard only"));
  };
  if (p.tool != q.tool) refuse(text("made by ", q.tool, ", not ", p.tool));
  if (p.scene_hash != q.scene_hash) refuse("another scene");
  if (p.command != q.command) refuse(text("\"", q.command, "\", not \"", p.command, "\""));
  if (key_of_whole(p) != key_of_whole(q) || p.inputs != q.inputs || !(p.history == q.history))
    refuse("other inputs");
  if (a.count != b.count) refuse(text("shard ", b.name, ", not one of ", a.count));
  if (a.totals.emitted != b.totals.emitted || a.totals.flux_exponent != b.totals.flux_exponent)
    refuse("other totals");
}

void require_each_once(const std::vector<Shard>& shards) {
  for (std::size_t i = 1; i < shards.size(); ++i)
    if (shards[i].index == shards[i - 1].index)
      throw Error(
          ExitCode::mismatch, shards[i].file.path(),
          text("is shard ", shards[i].name, ", and so is ", shards[i - 1].file.path(), "; give each once"));
  std::string missing;
  std::uint64_t next = 1, absent = 0;
  const std::uint64_t count = shards.front().count;
  constexpr std::uint64_t kNamed = 8;
  const auto note_absent_below = [&](std::uint64_t end) {
    for (; next < end && absent < kNamed; ++next, ++absent)
      missing += text(missing.empty() ? "" : ", ", next, "/", count);
    absent += end - next;
  };
  for (const Shard& s : shards) note_absent_below(s.index), next = s.index + 1;
  note_absent_below(count + 1);
  if (absent > 0)
    throw Error(ExitCode::mismatch, "",
                text("missing shard", absent > 1 ? "s " : " ", missing, absent > kNamed ? ", ..." : "",
                     " of the run"));
  std::uint64_t path = 0;
  for (const Shard& s : shards) {
    if (s.totals.first_path != path)
      throw Error(ExitCode::mismatch, s.file.path(),
                  text("starts at path ", s.totals.first_path, ", where ", path,
                       " comes next; make the shards again"));
    path += s.totals.paths;
  }
  if (path != shards.front().totals.emitted)
    throw Error(
        ExitCode::mismatch, "",
        text("the shards hold ", path, " of ", shards.front().totals.emitted, " paths; make them again"));
}

std::vector<Shard> open_shards(const std::vector<std::string>& paths) {
  PHOS_CHECK(!paths.empty(), "no shards");
  std::vector<Shard> shards;
  for (const std::string& path : paths) shards.push_back(open_shard(path));
  for (const Shard& s : shards) require_same_run(shards.front(), s);
  std::stable_sort(shards.begin(), shards.end(),
                   [](const Shard& a, const Shard& b) { return a.index < b.index; });
  require_each_once(shards);
  return shards;
}

template <class T>
void add(std::vector<T>& to, std::span<const T> from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void write_shard(const std::string& path, const Photons& photons, const PhotonTotals& totals,
                 const std::string& shard, Provenance provenance) {
  provenance.kind = "photons";
  provenance.version = 1;
  provenance.extra["totals"] = totals_to_json(totals);
  provenance.extra["bounds_m"] = bounds_to_json(photons.position);
  provenance.extra["shard"] = shard;
  ContainerWriter writer;
  add_columns(writer, columns_of(photons));
  writer.write(path, provenance);
}

std::string key_of_merged(const std::vector<std::string>& paths) {
  return key_of_whole(open_shards(paths).front().file.provenance());
}

MergedShards read_shards(const std::vector<std::string>& paths) {
  std::vector<Shard> shards = open_shards(paths);
  MergedShards merged;
  merged.provenance = shards.front().file.provenance();
  merged.provenance.key = key_of_whole(merged.provenance);
  merged.provenance.extra = Json();
  merged.provenance.counters = Counters();
  merged.totals.emitted = shards.front().totals.emitted;
  merged.totals.flux_exponent = shards.front().totals.flux_exponent;
  std::size_t rows = 0;
  for (const Shard& s : shards) rows += s.columns.position.size();
  Photons& p = merged.photons;
  p.position.reserve(rows), p.flux.reserve(rows), p.direction.reserve(rows), p.normal.reserve(rows);
  p.distance.reserve(rows), p.source_normal.reserve(rows), p.path.reserve(rows), p.bounce.reserve(rows);
  for (Shard& open : shards) {
    const Shard s = std::move(open);  // its mapping goes once it is copied
    s.file.verify();
    const PhotonColumns& c = s.columns;
    add(p.position, c.position), add(p.flux, c.flux), add(p.direction, c.direction), add(p.normal, c.normal);
    add(p.distance, c.distance), add(p.source_normal, c.source_normal), add(p.path, c.path),
        add(p.bounce, c.bounce);
    add_totals(merged.totals, s.totals);
    merged.provenance.counters.merge(s.file.provenance().counters);
  }
  return merged;
}

}  // namespace phos
