#include "place/parts.h"

#include "core/error.h"
#include "file/shards.h"
#include "place/growth.h"
#include "place/parallel_maker.h"

namespace phos::inline place {
namespace {

const ShardKind kKind{FileKind::irradiance, FileForm::part, "cache",
                      "phos-irradiance --place every --part k/n"};
constexpr const char* kRun = "run";  // entry of a part's header: the facts of the whole run

Json to_json(const Vec3& v) { return Json::Array{Json(v.x), Json(v.y), Json(v.z)}; }

Json to_json(const Counters& counters) {
  Json json(Json::Object{});
  for (const auto& [event, n] : counters.counts()) json[event] = n;
  return json;
}

/// Reads entries of a part's header.
class RunEntry {
 public:
  explicit RunEntry(const Container& file) : file_(file) {}

  float number(const char* name) const { return number(name, find(name)); }
  std::uint64_t count(const char* name) const { return count(name, find(name)); }
  Vec3 vector(const char* name) const {
    const Json& value = find(name);
    if (!value.is_array() || value.as_array().size() != 3) refuse(name);
    const Json::Array& v = value.as_array();
    return {number(name, v[0]), number(name, v[1]), number(name, v[2])};
  }
  Counters counters(const char* name) const {
    const Json& value = find(name);
    if (!value.is_object()) refuse(name);
    Counters counters;
    for (const auto& [event, n] : value.as_object()) counters.add(event, count(name, n));
    return counters;
  }
  [[noreturn]] void refuse(const char* name) const {
    throw Error(ExitCode::bad_input, file_.path(),
                text("its header has no valid \"", name, "\" of the whole run; make the part again"));
  }

 private:
  const Json& find(const char* name) const {
    const Json* run = file_.provenance().extra.find(kRun);
    const Json* value = run ? run->find(name) : nullptr;
    if (!value) refuse(name);
    return *value;
  }
  float number(const char* name, const Json& value) const {
    if (!value.is_number()) refuse(name);
    const auto v = static_cast<float>(value.as_number());
    if (!std::isfinite(v)) refuse(name);
    return v;
  }
  std::uint64_t count(const char* name, const Json& value) const {
    if (!value.is_integer() || value.as_integer() < 0) refuse(name);
    return static_cast<std::uint64_t>(value.as_integer());
  }
  const Container& file_;
};

/// A part's header.
struct PartFile {
  Shard shard;
  std::uint64_t first, total, records;
  RadiusBounds bounds;
  Bounds scene;
};

PartFile read_header(Shard shard) {
  const RunEntry run(shard.file);
  const RadiusBounds bounds{run.number("min_radius_m"), run.number("max_radius_m")};
  if (!(bounds.least_m > 0) || !(bounds.most_m >= bounds.least_m)) run.refuse("min_radius_m");
  const Bounds scene{run.vector("scene_lo_m"), run.vector("scene_hi_m")};
  const std::uint64_t records = TensorReader(shard.file).extent("n");
  const std::uint64_t first = run.count("first"), total = run.count("total");
  return {std::move(shard), first, total, records, bounds, scene};
}

void require_together(const std::vector<PartFile>& parts) {
  const PartFile& a = parts.front();
  std::uint64_t next = 0;
  for (const PartFile& b : parts) {
    const bool same = a.total == b.total && a.bounds.least_m == b.bounds.least_m &&
                      a.bounds.most_m == b.bounds.most_m && a.scene.lo == b.scene.lo &&
                      a.scene.hi == b.scene.hi;
    if (!same) refuse_other_run(a.shard, b.shard, kKind, "other totals");
    if (a.shard.file.provenance().counters.counts() != b.shard.file.provenance().counters.counts())
      refuse_other_run(a.shard, b.shard, kKind, "other counts of what went before");
    if (b.first != next)
      throw Error(ExitCode::mismatch, b.shard.file.path(),
                  text("starts at record ", b.first, ", where ", next, " comes next; make the parts again"));
    next += b.records;
  }
  if (next != a.total)
    throw Error(ExitCode::mismatch, "",
                text("the parts hold ", next, " of ", a.total, " records; make them again"));
}

std::vector<PartFile> open_parts(const std::vector<std::string>& paths) {
  std::vector<PartFile> parts;
  for (Shard& shard : open_shards(paths, kKind)) parts.push_back(read_header(std::move(shard)));
  require_together(parts);
  return parts;
}

/// As the whole run's header: further entries of a part's header are left out.
Json extra_of_whole(const Json& extra) {
  Json whole(Json::Object{});
  for (const auto& [name, value] : extra.as_object()) {
    if (name != kKind.word() && name != kRun) whole[name] = value;
  }
  return whole;
}

}  // namespace

IrradiancePart make_part(const IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                         const RecordOptions& resolved, const std::string& name,
                         std::span<const SurfaceSample> points) {
  if (!cache.records.empty())
    throw Error(ExitCode::usage, "--part",
                "cannot add to an earlier file; merge the parts first, and give both files to phos-splat");
  const ItemRange range = range_of(parse_share("--part", name), points.size());
  IrradiancePart part{name, range.first, points.size(),       {},
                      {},   cache,       bounds_of(resolved), rays.scene().bounds};
  ParallelMaker maker(estimator);
  part.made = maker.make_at(points, range.first, range.count);
  maker.count_into(part.counters);
  return part;
}

void write_part(const std::string& path, const IrradiancePart& part, Provenance provenance) {
  IrradianceCache cache = part.whole;
  std::vector<float> least_m;
  for (const Made& made : part.made) {
    PHOS_CHECK(made.site_least_m == 0 && made.site_most_m == kInfinity, "a point of --at has no pixel");
    cache.records.push_back(made.record);
    least_m.push_back(made.least_radius_m);
  }
  Json run(Json::Object{});
  run["first"] = part.first, run["total"] = part.total;
  run["min_radius_m"] = part.bounds.least_m, run["max_radius_m"] = part.bounds.most_m;
  run["scene_lo_m"] = to_json(part.scene.lo), run["scene_hi_m"] = to_json(part.scene.hi);
  run["counters"] = to_json(part.counters);
  provenance.extra[kRun] = run;
  provenance.extra[kKind.word()] = part.name;
  write_irradiance(path, cache, provenance, least_m);
}

std::string key_of_merged_parts(const std::vector<std::string>& paths) {
  return key_of_whole(open_parts(paths).front().shard.file.provenance());
}

MergedParts read_parts(const std::vector<std::string>& paths) {
  const std::vector<PartFile> parts = open_parts(paths);
  MergedParts merged;
  Provenance& p = merged.provenance;
  p = parts.front().shard.file.provenance();
  p.key = key_of_whole(p);
  p.extra = extra_of_whole(p.extra);
  merged.cache.scene_hash = p.scene_hash;
  RadiusRules rules(parts.front().scene, parts.front().bounds);
  for (const PartFile& part : parts) {
    const Container& file = part.shard.file;
    const RecordColumns columns(file, FileForm::part);
    const std::span<const float> least_m = TensorReader(file).values<float>("least_radius");
    merged.cache.accuracy = columns.accuracy(), merged.cache.quantity = columns.quantity();
    if (!merged.cache.caustics) merged.cache.caustics = caustics_of(file);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (least_m[i] > columns.radius_m(i))
        throw Error(ExitCode::bad_input, file.path(),
                    text("record ", i, " has a least radius above its radius; make the part again"));
      rules.add({columns[i], least_m[i]}, [](std::size_t, float) {});
    }
    p.counters.merge(RunEntry(file).counters("counters"));
  }
  rules.finish(merged.cache.records);
  rules.count_into(p.counters);
  return merged;
}

}  // namespace phos::inline place
