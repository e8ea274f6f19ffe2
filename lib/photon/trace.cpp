#include "photon/trace.h"

#include <algorithm>
#include <new>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "photon/caustic_aim.h"
#include "photon/emission.h"
#include "photon/events.h"
#include "photon/path_batch.h"
#include "photon/path_tracer.h"
#include "photon/photon_file.h"
#include "scene/material/sharp_materials.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kPathChunk = 1024;
// Chunks of a wave wait in memory for each other before they are joined in order. Enough of them to keep
// every thread busy, and no more, so that their memory is used again before it has left the cache.
constexpr std::uint64_t kChunksPerThread = 16;

void join(const PathPart& part, PhotonTotals& totals, Counters& counters, std::vector<Ray>* log) {
  totals.stored += part.photons.size();
  totals.emitted_sum += part.sums.emitted, totals.stored_sum += part.sums.stored;
  totals.escaped_sum += part.sums.escaped, totals.absorbed_sum += part.sums.absorbed;
  totals.stored_sum += part.aimed.stored;
  const auto count = [&](const Event& event, std::uint64_t times) {
    if (times > 0) counters.count(event, times);
  };
  count(kEscapedEvent, part.sums.escaped_paths);
  count(kKeptInGlassEvent, part.sums.kept_in_glass + part.aimed.kept_in_glass);
  count(kNonFiniteEvent, part.sums.non_finite + part.aimed.non_finite), count(kTooLongEvent, part.too_long());
  if (log) log->insert(log->end(), part.rays.begin(), part.rays.end());
}

/// Where each row goes: in the order of turns, and of each turn's rows as they are.
std::vector<std::uint32_t> places(std::span<const std::uint32_t> turn, std::uint32_t turns) {
  std::vector<std::uint32_t> first(turns + 1), place(turn.size());
  for (const std::uint32_t t : turn) ++first[t + 1];
  for (std::uint32_t t = 0; t < turns; ++t) first[t + 1] += first[t];
  for (std::size_t i = 0; i < turn.size(); ++i) place[i] = first[turn[i]]++;
  return place;
}

/// A part's flights in the order of its paths.
Flights in_order(const PathPart& part) {
  Flights sorted = part.photons.flights;
  const std::vector<std::uint32_t> place = places(part.flight_turn, part.turns);
  const auto put = [&](auto& column, const auto& own) {
    for (std::size_t i = 0; i < place.size(); ++i) column[place[i]] = own[i];
  };
  const Flights& own = part.photons.flights;
  put(sorted.from, own.from), put(sorted.flux, own.flux);
  put(sorted.direction, own.direction), put(sorted.length, own.length);
  return sorted;
}

/// Puts the parts' photons behind all others; the parts keep their memory for the next wave.
void join_photons(std::span<PathPart> parts, Photons& all, std::size_t expected_rows) {
  std::vector<std::size_t> first{all.size()};
  for (const PathPart& part : parts) first.push_back(first.back() + part.photons.size());
  for_columns(
      [&](auto& column) {
        if (first.back() > column.capacity()) column.reserve(std::max(first.back(), expected_rows));
        column.resize(first.back());
      },
      all);
  // Where paths part, all photons have it; such paths are not traced in batches (PathTracer::steps_alike()).
  const bool families = std::any_of(parts.begin(), parts.end(),
                                    [](const PathPart& part) { return !part.photons.family.empty(); });
  if (families) {
    if (first.back() > all.family.capacity()) all.family.reserve(std::max(first.back(), expected_rows));
    all.family.resize(first.back());
  }
  parallel_for(parts.size(), 1, [&](std::size_t i) {
    const std::vector<std::uint32_t> place = places(parts[i].turn, parts[i].turns);
    for_columns(
        [&](auto& column, auto& own) {
          const auto to = column.begin() + static_cast<std::ptrdiff_t>(first[i]);
          if (place.empty()) std::copy(own.begin(), own.end(), to);
          for (std::size_t k = 0; k < place.size(); ++k) to[place[k]] = own[k];
          own.clear();
        },
        all, parts[i].photons);
    Column<std::uint32_t>& family = parts[i].photons.family;
    std::copy(family.begin(), family.end(),
              all.family.begin() + static_cast<std::ptrdiff_t>(families ? first[i] : 0));
    family.clear();
  });
  for (PathPart& part : parts) {
    append(all.flights, columns_of(in_order(part)));
    part.photons.flights = {};
  }
}

/// How many rows all paths will give, by those that are done, and a little more.
std::size_t expected_rows(std::size_t rows, std::uint64_t done, std::uint64_t paths) {
  return static_cast<std::size_t>(1.01 * static_cast<double>(rows) / static_cast<double>(done) *
                                  static_cast<double>(paths));
}

}  // namespace

void declare_options(Options& options, PhotonOptions& p) {
  options.section("Photons");
  options.integer("photons", p.paths, "N",
                  "number of paths emitted from the lights; each path stores a photon on every surface it "
                  "reaches that is not purely mirror or glass (both numbers are printed); 0: an empty file",
                  {0, 0x1p40});
  options.integer("caustic-photons", p.caustic_paths, "N",
                  "number of paths aimed from the lamps at mirrors and glass, in scenes that have them; "
                  "these paths find all light that reaches surfaces by way of mirrors and glass alone. -1: "
                  "as many as --photons, or fewer where panes turn little of the light; 0: none, and "
                  "--photons find this light by chance",
                  {-1, 0x1p40}, Recorded::unless_default);
  options.number("minimum-share", p.minimum_share, "SHARE",
                 "least number of paths of a light, as a share of the equal share, so that small lamps are "
                 "not starved; 0: paths by power alone; 1: equal shares",
                 {0, 1});
  declare_isa(options, p.isa);
  options.text("shard", p.shard, "I/N",
               "trace only part I of N of the paths; phos-merge joins the parts exactly", Recorded::no);
}

ItemRange path_range(const std::string& shard, std::int64_t paths) {
  PHOS_CHECK(paths >= 0, "paths = ", paths);
  return range_of(parse_share("--shard", shard), static_cast<std::uint64_t>(paths));
}

Photons trace_photons(const RayScene& rays, const PhotonOptions& options, std::uint64_t seed,
                      PhotonTotals& totals, Counters& counters, std::vector<Ray>* log) {
  const ItemRange range = path_range(options.shard, options.paths);
  totals = {};
  totals.emitted = static_cast<std::uint64_t>(options.paths);
  totals.first_path = range.first, totals.paths = range.count;
  Photons photons;
  if (options.paths == 0) return photons;
  const Emitter emitter(rays.scene(), options.minimum_share, totals.emitted, seed);
  totals.flux_exponent = emitter.flux_exponent();
  std::optional<CausticAim> aim;
  if (options.caustic_paths != 0 && casts_caustics(rays.scene())) aim.emplace(rays);
  if (aim && aim->empty()) aim.reset();
  const std::uint64_t aimed = options.caustic_paths >= 0 ? static_cast<std::uint64_t>(options.caustic_paths)
                              : aim                      ? aim->paths_for(totals.emitted)
                                                         : 0;
  const PathTracer tracer(rays, emitter, aim ? &*aim : nullptr, totals.emitted, aimed, seed, log != nullptr);
  Progress progress("photons", range.count, "paths");
  std::vector<PathPart> parts;
  const std::uint64_t full_wave = kChunksPerThread * kPathChunk * static_cast<std::uint64_t>(thread_count());
  for (std::uint64_t done = 0; done < range.count;) {
    const std::uint64_t wave = std::min(full_wave, range.count - done);
    const std::uint64_t first = range.first + done;
    parts.resize(std::max<std::size_t>(parts.size(), (wave + kPathChunk - 1) / kPathChunk));
    parallel_chunks(wave, kPathChunk, [&](std::size_t begin, std::size_t end) {
      PathPart& part = parts[begin / kPathChunk];
      part.restart();
      trace_paths(tracer, first + begin, first + end, part);
      if (has_no_end(part))
        throw Error(
            ExitCode::numerical, "",
            text(kTooLongEvent.name, ": ", part.too_long(), " of ", part.turns,
                 " paths; a closed part of the scene absorbs nothing, and its light has no end: lower "
                 "the reflectance of its materials below 1"));
      progress.advance(end - begin);
    });
    done += wave;
    const std::span<PathPart> traced(parts.data(), (wave + kPathChunk - 1) / kPathChunk);
    for (const PathPart& part : traced) join(part, totals, counters, log);
    const std::size_t expected = expected_rows(totals.stored, done, range.count);
    try {
      join_photons(traced, photons, expected);
    } catch (const std::bad_alloc&) {
      throw Error(ExitCode::no_memory, "",
                  text("no memory for the about ", expected, " photons that ", range.count,
                       " paths will store here; emit fewer (--photons)"));
    }
  }
  totals.settle();
  return photons;
}

}  // namespace phos::inline photon
