#include "file/shards.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "file/limits.h"

namespace phos::inline file {
namespace {

bool read_number(const char*& at, const char* end, std::uint64_t& value) {
  const auto [next, failure] = std::from_chars(at, end, value);
  const bool read = failure == std::errc() && next != at;
  at = next;
  return read;
}

/// "k/n" and nothing else.
bool read_share(const std::string& text, Share& share) {
  const char *at = text.data(), *end = at + text.size();
  return read_number(at, end, share.index) && at != end && *at++ == '/' &&
         read_number(at, end, share.count) && at == end && share.index >= 1 && share.index <= share.count &&
         share.count <= kMostShares.as<std::uint64_t>();
}

Shard open_shard(const std::string& path, const ShardKind& kind) {
  Shard shard{Container::open(path), {}, {}};
  const Provenance& p = shard.file.provenance();
  if (p.kind != kind.kind)
    throw Error(ExitCode::bad_input, path,
                text("is \"", name_of(p.kind), "\"; phos-merge joins ", kind.word(), "s of \"",
                     name_of(kind.kind), "\" here"));
  const Json* name = p.extra.find(kind.word());
  if (!name || !name->is_string())
    throw Error(ExitCode::bad_input, path,
                text("is a whole ", kind.whole, " already, not a ", kind.word(), " (", kind.maker, " makes ",
                     kind.word(), "s)"));
  shard.name = name->as_string();
  if (!read_share(shard.name, shard.share))
    throw Error(ExitCode::bad_input, path,
                text("the header does not say which ", kind.word(), " it is; make it again"));
  return shard;
}

void require_same_run(const Shard& a, const Shard& b, const ShardKind& kind) {
  const Provenance &p = a.file.provenance(), &q = b.file.provenance();
  const auto refuse = [&](const std::string& reason) { refuse_other_run(a, b, kind, reason); };
  if (p.tool != q.tool) refuse(text("made by ", q.tool, ", not ", p.tool));
  if (p.scene_hash != q.scene_hash) refuse("another scene");
  if (p.command != q.command) refuse(text("\"", q.command, "\", not \"", p.command, "\""));
  if (key_of_whole(p) != key_of_whole(q) || p.inputs != q.inputs || !(p.history == q.history))
    refuse("other inputs");
  if (a.share.count != b.share.count) refuse(text(kind.word(), " ", b.name, ", not one of ", a.share.count));
}

void require_each_once(const std::vector<Shard>& shards, const ShardKind& kind) {
  for (std::size_t i = 1; i < shards.size(); ++i)
    if (shards[i].share.index == shards[i - 1].share.index)
      throw Error(ExitCode::mismatch, shards[i].file.path(),
                  text("is ", kind.word(), " ", shards[i].name, ", and so is ", shards[i - 1].file.path(),
                       "; give each once"));
  std::string missing;
  std::uint64_t next = 1, absent = 0;
  const std::uint64_t count = shards.front().share.count;
  constexpr std::uint64_t kNamed = 8;
  const auto note_absent_below = [&](std::uint64_t end) {
    for (; next < end && absent < kNamed; ++next, ++absent)
      missing += text(missing.empty() ? "" : ", ", next, "/", count);
    absent += end - next;
  };
  for (const Shard& s : shards) note_absent_below(s.share.index), next = s.share.index + 1;
  note_absent_below(count + 1);
  if (absent > 0)
    throw Error(ExitCode::mismatch, "",
                text("missing ", kind.word(), absent > 1 ? "s " : " ", missing,
                     absent > kNamed ? ", ..." : "", " of the run; give all of them"));
}

}  // namespace

std::string share_of(const Container& file) {
  const Json* share = file.provenance().extra.find(name_of(file.form()));
  return share && share->is_string() ? share->as_string() : "?";
}

Share parse_share(const std::string& option, const std::string& value) {
  Share share;
  if (value.empty() || read_share(value, share)) return share;
  throw Error(
      ExitCode::usage, option,
      text("\"", value, "\" is not K/N with 1 <= K <= N <= ", kMostShares.most, " (for instance 2/4)"));
}

ItemRange range_of(const Share& share, std::uint64_t total) {
  PHOS_CHECK(share.index >= 1 && share.index <= share.count && total < (std::uint64_t{1} << 43), share.index,
             "/", share.count, " of ", total);
  const std::uint64_t first = total * (share.index - 1) / share.count;
  return {first, total * share.index / share.count - first};
}

std::vector<Shard> open_shards(const std::vector<std::string>& paths, const ShardKind& kind) {
  PHOS_CHECK(!paths.empty(), "no ", kind.word());
  std::vector<Shard> shards;
  for (const std::string& path : paths) shards.push_back(open_shard(path, kind));
  for (const Shard& s : shards) require_same_run(shards.front(), s, kind);
  std::stable_sort(shards.begin(), shards.end(),
                   [](const Shard& a, const Shard& b) { return a.share.index < b.share.index; });
  require_each_once(shards, kind);
  return shards;
}

void refuse_other_run(const Shard& a, const Shard& b, const ShardKind& kind, const std::string& reason) {
  throw Error(ExitCode::mismatch, b.file.path(),
              text("is of another run than ", a.file.path(), " (", reason, "); ", kind.word(),
                   "s of one run differ in --", kind.word(), " only"));
}

std::string key_of_whole(const Provenance& shard) { return shard.key.substr(0, shard.key.find(':')); }

}  // namespace phos::inline file
