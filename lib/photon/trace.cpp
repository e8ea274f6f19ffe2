#include "photon/trace.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <span>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "photon/emission.h"
#include "photon/photon_file.h"
#include "scene/bsdf.h"
#include "scene/passage.h"

namespace phos {
namespace {

constexpr std::size_t kPathChunk = 1024;
// Chunks of a wave wait in memory for each other before they are joined in order. Enough of them to keep
// every thread busy, and no more, so that their memory is used again before it has left the cache.
constexpr std::uint64_t kChunksPerThread = 16;
constexpr std::uint32_t kMaxBounces = 65534;  // the last that a random stream can number
// Of a chunk: more, and nothing absorbs the light, whose photons would fill any memory.
constexpr std::uint64_t kMostTooLong = 16;

// Without the not-a-number rules of fmax, which cost a call.
float largest(const Rgb& c) { return std::max(c.x, std::max(c.y, c.z)); }

/// What one chunk of paths gives.
struct Part {
  Photons photons;
  FluxSum emitted, stored, escaped, absorbed;
  std::uint64_t escaped_paths = 0, non_finite = 0, too_long = 0;
  std::vector<Ray> rays;

  void restart() {
    emitted = stored = escaped = absorbed = FluxSum();
    escaped_paths = non_finite = too_long = 0;
    rays.clear();
  }
};

/// A photon in flight.
struct Flight {
  Ray ray;
  Rgb flux_lm{0};
  FluxSum units;  // of flux_lm
  Vec3 source_normal{0, 0, 1};
  std::uint32_t bounce = 0;
  std::uint32_t events = 0;  // bounces and panes passed straight: numbers the random draws
  bool from_infinity = false;
  bool specular_only = true;  // since the light
  bool in_glass = false;      // in solid glass
  Vec3 stretch_from{0};       // where the ray began, or the pane that it has passed last

  PhotonPath path() const {
    if (bounce == 0) return PhotonPath::direct;
    return specular_only ? PhotonPath::caustic : PhotonPath::indirect;
  }
};

/// Notes the stretch that caustic light has flown since the last surface, where no photon tells of it.
void note_flight(Flights& flights, const Flight& flight, float length_m) {
  if (!is_caustic(flight.path()) || flight.in_glass) return;
  flights.from.push_back(flight.stretch_from);
  flights.flux.push_back(flight.flux_lm);
  flights.direction.push_back(encode_octahedral(flight.ray.direction));
  flights.length.push_back(length_m);
}

bool stores(const Bsdf& bsdf) { return !bsdf.has_specular() || bsdf.has_diffuse() || bsdf.has_gloss(); }

void store(Photons& photons, const Flight& flight, const SurfacePoint& point) {
  photons.position.push_back(point.position);
  photons.flux.push_back(flight.flux_lm);
  photons.direction.push_back(encode_octahedral(-flight.ray.direction));
  photons.normal.push_back(encode_octahedral(point.smooth_normal));
  photons.distance.push_back(flight.from_infinity ? kInfinity : point.distance_m);
  photons.source_normal.push_back(encode_octahedral(flight.source_normal));
  photons.path.push_back(static_cast<std::uint8_t>(flight.path()));
  photons.bounce.push_back(static_cast<std::uint8_t>(std::min(flight.bounce, 255u)));
}

class PathTracer {
 public:
  PathTracer(const RayScene& rays, const Emitter& emitter, std::uint64_t seed, bool log)
      : rays_(rays),
        emitter_(emitter),
        seed_(seed),
        log_(log),
        units_per_lm_(std::ldexp(1.0, -emitter.flux_exponent())) {}

  void trace_path(std::uint64_t path, Part& part) const {
    RandomStream random(seed_, Stage::photon_path, path);
    random.start_bounce(0);
    const EmittedPhoton start = emitter_.emit(path, random);
    if (!is_finite(start.flux_lm)) {
      ++part.non_finite;
      return;
    }
    Flight flight;
    flight.ray = start.ray, flight.flux_lm = start.flux_lm, flight.units = units(start.flux_lm);
    flight.source_normal = start.source_normal, flight.from_infinity = start.from_infinity;
    part.emitted += flight.units;
    while (largest(flight.flux_lm) > 0 && step(flight, random, part)) {
    }
  }

 private:
  FluxSum units(const Rgb& flux_lm) const { return FluxSum::of(flux_lm, units_per_lm_); }

  /// To the next surface and off it again; straight through panes on the way. False: the photon is no more.
  bool step(Flight& flight, RandomStream& random, Part& part) const {
    if (log_) part.rays.push_back(flight.ray);
    Way way(rays_, flight.ray);
    flight.stretch_from = flight.ray.origin;
    for (;;) {
      // Drawn before the ray is traced, so that the processor can work them out in the waits of the
      // traversal.
      random.start_bounce(flight.events + 1);
      const float u_lobe = random.uniform();
      const Vec2 u = random.uniform2();
      SurfacePoint point;
      if (!way.next(point)) {
        note_flight(part.photons.flights, flight, kInfinity);
        part.escaped += flight.units;
        ++part.escaped_paths;
        return false;
      }
      const Bsdf bsdf = way.bsdf(point);
      if (stores(bsdf)) {
        store(part.photons, flight, point);
        part.stored += flight.units;
      } else {
        note_flight(part.photons.flights, flight, glm::distance(flight.stretch_from, point.position));
      }
      flight.stretch_from = point.position;
      part.absorbed += flight.units;
      const After after = scatter(bsdf, point, u_lobe, u, flight, random, part);
      if (after == After::ended) return false;
      flight.units = units(flight.flux_lm);
      part.absorbed -= flight.units;
      if (after == After::scattered) return true;
    }
  }

  enum class After : std::uint8_t { ended, scattered, passed };

  /// Samples the material and plays Russian roulette.
  After scatter(const Bsdf& bsdf, const SurfacePoint& point, float u_lobe, const Vec2& u, Flight& flight,
                RandomStream& random, Part& part) const {
    if (flight.events == kMaxBounces) {
      ++part.too_long;
      return After::ended;
    }
    ++flight.events;
    const Vec3 wo = -flight.ray.direction;
    BsdfSample sample;
    if (!bsdf.sample(wo, u_lobe, u, sample, TransportMode::flux)) return After::ended;
    const Rgb flux = sample.weight * flight.flux_lm;
    if (!is_finite(flux)) {
      ++part.non_finite;
      return After::ended;
    }
    const float survival = std::min(1.0f, largest(flux) / largest(flight.flux_lm));
    if (!(survival > 0) || (survival < 1 && random.uniform() >= survival)) return After::ended;
    flight.flux_lm = (1 / survival) * flux;
    if (sample.straight) return After::passed;
    ++flight.bounce;
    flight.ray = Ray{point.leave(sample.direction), sample.direction};
    flight.source_normal = glm::dot(sample.direction, point.geometric_normal) >= 0 ? point.geometric_normal
                                                                                   : -point.geometric_normal;
    flight.from_infinity = false;
    flight.specular_only = flight.specular_only && sample.specular;
    const bool ahead = glm::dot(sample.direction, point.geometric_normal) >= 0;
    flight.in_glass =
        rays_.scene().material[point.material].model == Model::dielectric && ahead != point.front;
    return After::scattered;
  }

  const RayScene& rays_;
  const Emitter& emitter_;
  std::uint64_t seed_;
  bool log_;
  double units_per_lm_;
};

void join(Part& part, PhotonTotals& totals, Counters& counters, std::vector<Ray>* log) {
  totals.stored += part.photons.size();
  totals.emitted_sum += part.emitted, totals.stored_sum += part.stored;
  totals.escaped_sum += part.escaped, totals.absorbed_sum += part.absorbed;
  const auto count = [&](const char* event, std::uint64_t times) {
    if (times > 0) counters.count(event, times);
  };
  count(kEscapedEvent, part.escaped_paths);
  count(kNonFiniteEvent, part.non_finite), count(kTooLongEvent, part.too_long);
  if (log) log->insert(log->end(), part.rays.begin(), part.rays.end());
}

/// The same vector of every part behind the end of `all`'s; the parts keep their memory for the next wave.
template <class T>
void join_column(std::vector<T> Photons::*column, std::span<Part> parts, Photons& all,
                 std::size_t expected_rows) {
  std::vector<T>& joined = all.*column;
  std::size_t rows = joined.size();
  for (const Part& part : parts) rows += (part.photons.*column).size();
  if (rows > joined.capacity()) joined.reserve(std::max(rows, expected_rows));
  for (Part& part : parts) {
    std::vector<T>& own = part.photons.*column;
    joined.insert(joined.end(), own.begin(), own.end());
    own.clear();
  }
}

void join_flights(std::span<Part> parts, Flights& all) {
  for (Part& part : parts) {
    append(all, columns_of(part.photons.flights));
    part.photons.flights = {};
  }
}

void join_photons(std::span<Part> parts, Photons& all, std::size_t expected_rows) {
  const auto join_number = [&](std::size_t column) {
    switch (column) {
      case 0:
        return join_column(&Photons::position, parts, all, expected_rows);
      case 1:
        return join_column(&Photons::flux, parts, all, expected_rows);
      case 2:
        return join_column(&Photons::direction, parts, all, expected_rows);
      case 3:
        return join_column(&Photons::normal, parts, all, expected_rows);
      case 4:
        return join_column(&Photons::source_normal, parts, all, expected_rows);
      case 5:
        return join_column(&Photons::distance, parts, all, expected_rows);
      case 6:
        return join_column(&Photons::path, parts, all, expected_rows);
      case 7:
        return join_flights(parts, all.flights);
      default:
        return join_column(&Photons::bounce, parts, all, expected_rows);
    }
  };
  parallel_for(9, 1, join_number);
}

/// How many rows all paths will give, by those that are done, and a little more.
std::size_t expected_rows(std::size_t rows, std::uint64_t done, std::uint64_t paths) {
  return static_cast<std::size_t>(1.01 * static_cast<double>(rows) / static_cast<double>(done) *
                                  static_cast<double>(paths));
}

}  // namespace

void declare_options(Options& options, PhotonOptions& p) {
  options.section("Photons");
  options.integer(
      "photons", p.paths, "N",
      "paths emitted from the lights; each stores a photon on every surface it reaches that is not purely "
      "mirror or glass (both numbers are printed)",
      {0, 0x1p40});
  options.number(
      "minimum-share", p.minimum_share, "SHARE",
      "least number of paths of a light, in parts of an equal share, so that small lamps are not starved; "
      "0 is by power alone, 1 is equal shares",
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
  const PathTracer tracer(rays, emitter, seed, log != nullptr);
  Progress progress("photons", range.count, "paths");
  std::vector<Part> parts;
  const std::uint64_t full_wave = kChunksPerThread * kPathChunk * static_cast<std::uint64_t>(thread_count());
  for (std::uint64_t done = 0; done < range.count;) {
    const std::uint64_t wave = std::min(full_wave, range.count - done);
    const std::uint64_t first = range.first + done;
    parts.resize(std::max<std::size_t>(parts.size(), (wave + kPathChunk - 1) / kPathChunk));
    parallel_chunks(wave, kPathChunk, [&](std::size_t begin, std::size_t end) {
      Part& part = parts[begin / kPathChunk];
      part.restart();
      for (std::size_t i = begin; i < end; ++i) {
        tracer.trace_path(first + i, part);
        if (part.too_long < kMostTooLong) continue;
        throw Error(
            ExitCode::numerical, "",
            text(kTooLongEvent, ": ", kMostTooLong, " of ", i + 1 - begin,
                 " paths; a closed part of the scene absorbs nothing, and its light has no end: lower "
                 "the reflectance of its materials below 1"));
      }
      progress.advance(end - begin);
    });
    done += wave;
    const std::span<Part> traced(parts.data(), (wave + kPathChunk - 1) / kPathChunk);
    for (Part& part : traced) join(part, totals, counters, log);
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

}  // namespace phos
