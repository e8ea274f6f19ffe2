#include "scene/report/unsampled.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline scene {
namespace {

constexpr const char* kUnsampled = "unsampled";

enum class Finds : std::uint8_t { always, by_hits, never };

struct SamplerRow {
  Sampler sampler;
  const char* name;
  Finds mirrored, bent, gloss;
  const char* instead;  ///< the remedy where it does not
};

/// The table: estimator x way.
constexpr SamplerRow kSamplers[] = {
    {Sampler::path_tracing, "path tracing", Finds::by_hits, Finds::by_hits, Finds::by_hits,
     "--method bidirectional samples it"},
    {Sampler::gathering, "gathering", Finds::by_hits, Finds::by_hits, Finds::by_hits,
     "records of photons hold it (phos-irradiance --estimate hull)"},
    {Sampler::gathering_beside_caustics, "gathering", Finds::always, Finds::always, Finds::by_hits,
     "records of photons hold it (phos-irradiance --estimate hull)"},
    {Sampler::photons, "photons", Finds::always, Finds::always, Finds::always, ""},
};

const SamplerRow& row_of(Sampler sampler) {
  const auto* found = std::find_if(std::begin(kSamplers), std::end(kSamplers),
                                   [&](const SamplerRow& row) { return row.sampler == sampler; });
  PHOS_CHECK(found != std::end(kSamplers), static_cast<int>(sampler));
  return *found;
}

Finds finds(const SamplerRow& row, LightWay::Kind kind) {
  switch (kind) {
    case LightWay::Kind::mirrored:
      return row.mirrored;
    case LightWay::Kind::bent:
      return row.bent;
    case LightWay::Kind::gloss:
      return row.gloss;
  }
  return Finds::never;
}

std::string begun(const LightWay& way) {
  return text("lamp \"", way.lamp, "\" reaches surfaces by way of ", by_text(way));
}

std::string held_by_no_record(const LightWay& way) {
  return begun(way) + ", which its records do not hold; stderr is not stated";
}

/// The one of the same lamp and kind.
template <class Ways>
auto find_like(Ways& ways, const LightWay& way) {
  return std::find_if(ways.begin(), ways.end(),
                      [&](const LightWay& w) { return w.lamp == way.lamp && w.kind == way.kind; });
}

void add_new(std::vector<std::string>& words, const std::vector<std::string>& more) {
  for (const std::string& word : more)
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

void tell(Tool& tool, const std::string& what, const std::vector<std::string>& lines) {
  const std::string where = what.empty() ? "" : what + ": ";
  const std::size_t shown = std::min(kShownWays, lines.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == shown && lines.size() > shown;
    tool.doubt(where + lines[i] + (last ? text("; and ", lines.size() - shown, " more such ways") : ""));
  }
}

}  // namespace

bool samples(Sampler sampler, const LightWay& way, double samples) {
  switch (finds(row_of(sampler), way.kind)) {
    case Finds::always:
      return true;
    case Finds::by_hits:
      return samples * way.hit_share >= kExpectedHits;
    case Finds::never:
      break;
  }
  return false;
}

std::vector<LightWay> unsampled(const std::vector<LightWay>& ways, Sampler sampler, double count) {
  std::vector<LightWay> out;
  for (const LightWay& way : ways)
    if (!samples(sampler, way, count)) out.push_back(way);
  return out;
}

std::vector<LightWay> united(std::vector<LightWay> ways, const std::vector<LightWay>& more) {
  for (const LightWay& way : more) {
    const auto same = find_like(ways, way);
    if (same == ways.end()) {
      ways.push_back(way);
      continue;
    }
    add_new(same->materials, way.materials), add_new(same->by, way.by);
    same->share = std::max(same->share, way.share);
    same->hit_share = std::min(same->hit_share, way.hit_share);
  }
  return ways;
}

std::int64_t samples_wanted(const std::vector<LightWay>& ways, Sampler sampler, std::int64_t most) {
  double least = 0;
  for (const LightWay& way : ways)
    if (!samples(sampler, way, 1) && samples(sampler, way, static_cast<double>(most)))
      least = std::max(least, std::ceil(kExpectedHits / way.hit_share));
  return static_cast<std::int64_t>(least);
}

std::string unsampled_line(const LightWay& way, Sampler sampler, double samples) {
  const SamplerRow& row = row_of(sampler);
  const bool rare = finds(row, way.kind) == Finds::by_hits && way.hit_share > 0;
  std::string out = text(begun(way), ", which ", row.name, rare ? " would hit " : " does not sample here");
  if (rare)
    out += text(shortest(static_cast<float>(samples * way.hit_share)), " times, and ",
                shortest(static_cast<float>(kExpectedHits)),
                " are wanted: ", std::ceil(kExpectedHits / way.hit_share), " samples");
  out += "; stderr is not stated";
  return *row.instead ? text(out, "; ", row.instead) : out;
}

void tell_unsampled(Tool& tool, const std::vector<LightWay>& ways, Sampler sampler, double samples,
                    const std::string& what) {
  if (ways.empty()) return;
  tool.stat(kUnsampled, to_json(ways));
  std::vector<std::string> lines;
  for (const LightWay& way : ways) lines.push_back(unsampled_line(way, sampler, samples));
  tell(tool, what, lines);
}

void note_unsampled(Provenance& provenance, const std::vector<LightWay>& ways) {
  if (!ways.empty()) provenance.extra[kUnsampled] = to_json(ways);
}

std::vector<LightWay> unsampled_in(const Provenance& provenance) {
  const Json* noted = provenance.extra.find(kUnsampled);
  return noted ? light_ways_from(*noted) : std::vector<LightWay>();
}

std::vector<LightWay> tell_unsampled_in(Tool& tool, const std::vector<Container>& files) {
  std::vector<LightWay> all;
  for (const Container& file : files) {
    const std::vector<LightWay> ways = unsampled_in(file.provenance());
    std::vector<std::string> lines;
    for (const LightWay& way : ways) lines.push_back(held_by_no_record(way));
    tell(tool, file.path(), lines);
    all.insert(all.end(), ways.begin(), ways.end());
  }
  if (!all.empty()) tool.stat(kUnsampled, to_json(all));
  return all;
}

std::vector<LightWay> tell_unsampled_kept(Tool& tool, const std::string& path,
                                          const std::vector<LightWay>& kept,
                                          const std::vector<LightWay>& missed) {
  std::vector<std::string> lines;
  for (const LightWay& way : kept)
    if (find_like(missed, way) == missed.end()) lines.push_back(held_by_no_record(way));
  std::vector<LightWay> all = united(kept, missed);
  if (!lines.empty()) tool.stat(kUnsampled, to_json(all));
  tell(tool, path, lines);
  return all;
}

}  // namespace phos::inline scene
