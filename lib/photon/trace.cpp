#include "photon/trace.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "photon/caustic_aim.h"
#include "photon/emission.h"
#include "photon/photon_file.h"
#include "photon/portal_split.h"
#include "scene/bsdf.h"
#include "scene/mirror_images.h"
#include "scene/passage.h"
#include "scene/sharp_materials.h"

namespace phos {
namespace {

constexpr std::size_t kPathChunk = 1024;
// Chunks of a wave wait in memory for each other before they are joined in order. Enough of them to keep
// every thread busy, and no more, so that their memory is used again before it has left the cache.
constexpr std::uint64_t kChunksPerThread = 16;
constexpr std::uint64_t kAimedItems = std::uint64_t{1} << 63;  // random streams: + number of the aimed path
constexpr std::uint32_t kMaxBounces = 65534;                   // the last that a random stream can number
// Light that total reflection keeps in glass that absorbs nothing may stay for ever: from so many events on
// it plays Russian roulette.
constexpr std::uint32_t kLongInGlass = 16384;
constexpr float kLongSurvival = 0.98f;
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
  // Flat mirrors since a light that has images in them (MirrorPlanes).
  bool mirrored = false;
  std::int32_t chain = MirrorPlanes::kNone;
  bool in_glass = false;  // in solid glass
  Vec3 stretch_from{0};   // where the ray began, or the pane that it has passed last
  enum class Keep : std::uint8_t { all, others, caustics } keep = Keep::all;  // photons that are stored
  // Light that is not aimed at portals: what is scattered through them goes by children of it (PortalSplit).
  // A child is one up to the portal.
  enum class Astray : std::uint8_t { no, parent, child } astray = Astray::no;
  float portal_m = kInfinity;  // along the ray, of one astray
  std::uint64_t number = 0;    // of the path
  bool aimed_class = false;    // the first event was on what paths are aimed at
  std::uint32_t aimed_at = 0;  // triangle

  /// Is the photon, or the stretch, this path's to tell of?
  bool tells() const {
    return keep == Keep::all || (keep == Keep::caustics) == (is_caustic(path()) && aimed_class);
  }

  PhotonPath path() const {
    if (bounce == 0) return PhotonPath::direct;
    if (!specular_only) return PhotonPath::indirect;
    return mirrored ? PhotonPath::mirrored : PhotonPath::caustic;
  }
};

/// Notes the stretch that caustic light has flown since the last surface, where no photon tells of it.
void note_flight(Flights& flights, const Flight& flight, float length_m) {
  if (!is_caustic(flight.path()) || flight.in_glass || !flight.tells()) return;
  flights.from.push_back(flight.stretch_from);
  flights.flux.push_back(flight.flux_lm);
  flights.direction.push_back(encode_octahedral(flight.ray.direction));
  flights.length.push_back(length_m);
}

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
  /// `aim` null: no path is aimed. `aimed_paths` are all of them.
  PathTracer(const RayScene& rays, const Emitter& emitter, const CausticAim* aim, std::uint64_t paths,
             std::uint64_t aimed_paths, std::uint64_t seed, bool log)
      : rays_(rays),
        emitter_(emitter),
        mirrors_(emitter.mirrors()),
        aim_(aim),
        paths_(paths),
        aimed_paths_(aimed_paths),
        seed_(seed),
        log_(log),
        units_per_lm_(std::ldexp(1.0, -emitter.flux_exponent())) {
    const std::vector<Portal>& portals = rays.scene().portal;
    if (emitter.aimed_lm() > 0) split_.emplace(portals, emitter.aimed_lm());
  }

  /// The aimed paths that go with a path: all of them are dealt out in order.
  void trace_aimed(std::uint64_t path, Part& part) const {
    if (!aim_) return;
    const auto until = [&](std::uint64_t p) {
      return static_cast<std::uint64_t>(static_cast<double>(p) / static_cast<double>(paths_) *
                                        static_cast<double>(aimed_paths_));
    };
    const std::uint64_t last = path + 1 == paths_ ? aimed_paths_ : until(path + 1);
    for (std::uint64_t i = until(path); i < last; ++i) trace_one_aimed(i, part);
  }

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
    flight.mirrored = !mirrors_.empty() && is_of_image(emitter_.light(path), start.ray.direction);
    part.emitted += flight.units;
    if (aim_) flight.keep = Flight::Keep::others;
    flight.number = path;
    if (split_ && start.astray) flight.astray = Flight::Astray::parent;
    while (largest(flight.flux_lm) > 0 && step(flight, random, part)) {
    }
  }

 private:
  void trace_one_aimed(std::uint64_t number, Part& part) const {
    RandomStream random(seed_, Stage::photon_path, kAimedItems + number);
    random.start_bounce(0);
    const std::size_t light = emitter_.light_of(number);
    CausticAim::Start start = aim_->start(light, random);
    const double per_path = static_cast<double>(paths_) / static_cast<double>(aimed_paths_);
    start.photon.flux_lm *= emitter_.scale(light) * static_cast<float>(per_path);
    if (!is_finite(start.photon.flux_lm)) {
      ++part.non_finite;
      return;
    }
    Flight flight;
    flight.ray = start.photon.ray, flight.flux_lm = start.photon.flux_lm;
    flight.units = units(flight.flux_lm);
    flight.source_normal = start.photon.source_normal, flight.from_infinity = start.photon.from_infinity;
    flight.mirrored = !mirrors_.empty() && is_of_image(emitter_.light(number), start.photon.ray.direction);
    flight.keep = Flight::Keep::caustics, flight.aimed_at = start.triangle;
    // Its light is in the totals already: only what is stored counts.
    Part uncounted;
    std::swap(uncounted.photons, part.photons);
    while (largest(flight.flux_lm) > 0 && step(flight, random, uncounted)) {
    }
    std::swap(uncounted.photons, part.photons);
    part.stored += uncounted.stored;
    part.non_finite += uncounted.non_finite, part.too_long += uncounted.too_long;
    if (log_) part.rays.insert(part.rays.end(), uncounted.rays.begin(), uncounted.rays.end());
  }

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
      const bool met = way.next(point);
      if (flight.astray != Flight::Astray::no && (met ? point.distance_m : kInfinity) > flight.portal_m) {
        if (flight.astray == Flight::Astray::parent) return drop(flight, part);
        flight.astray = Flight::Astray::no;
      }
      const bool before_portal = flight.astray == Flight::Astray::child;
      if (!met && before_portal) return drop(flight, part);
      if (!met) {
        note_flight(part.photons.flights, flight, kInfinity);
        part.escaped += flight.units;
        ++part.escaped_paths;
        return false;
      }
      const Bsdf bsdf = way.bsdf(point);
      if (before_portal) {
        // What is not through yet, the parent tells of.
      } else if (bsdf.takes_light()) {
        if (flight.tells()) {
          store(part.photons, flight, point);
          part.stored += flight.units;
        }
      } else {
        note_flight(part.photons.flights, flight, glm::distance(flight.stretch_from, point.position));
      }
      flight.stretch_from = point.position;
      part.absorbed += flight.units;
      const After after = scatter(bsdf, point, u_lobe, u, flight, random, part);
      if (after == After::ended || (before_portal && after != After::passed)) return false;
      flight.units = units(flight.flux_lm);
      part.absorbed -= flight.units;
      if (after == After::scattered) return true;
    }
  }

  /// Light of a lamp that has images in flat mirrors; of an environment, of its sun.
  bool is_of_image(const Light& light, const Vec3& direction) const {
    const Scene& scene = rays_.scene();
    if (light.kind != Light::Kind::environment) return has_images(scene, light);
    return sun_luminance(scene, -direction) != Rgb(0);
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
    if (flight.astray == Flight::Astray::parent) send_through_portals(bsdf, point, wo, flight, part);
    BsdfSample sample;
    if (!bsdf.sample(wo, u_lobe, u, sample, TransportMode::flux)) return After::ended;
    const Rgb flux = sample.weight * flight.flux_lm;
    if (!is_finite(flux)) {
      ++part.non_finite;
      return After::ended;
    }
    float survival = std::min(1.0f, largest(flux) / largest(flight.flux_lm));
    if (flight.in_glass && flight.events > kLongInGlass) survival = std::min(survival, kLongSurvival);
    if (!(survival > 0) || (survival < 1 && random.uniform() >= survival)) return After::ended;
    flight.flux_lm = (1 / survival) * flux;
    if (sample.straight) return After::passed;
    if (aim_ && flight.bounce == 0) {
      flight.aimed_class = aim_->takes(point.material);
      if (flight.keep == Flight::Keep::caustics && point.triangle != flight.aimed_at) return After::ended;
    }
    if (flight.keep == Flight::Keep::caustics && !sample.specular) return After::ended;
    ++flight.bounce;
    flight.ray = Ray{point.leave(sample.direction), sample.direction};
    flight.source_normal = glm::dot(sample.direction, point.geometric_normal) >= 0 ? point.geometric_normal
                                                                                   : -point.geometric_normal;
    flight.from_infinity = false;
    // What mirrors and glass send on has no children.
    if (flight.astray == Flight::Astray::parent)
      flight.portal_m =
          sample.specular ? kInfinity : split_->first_crossing_m(point.position, sample.direction);
    flight.specular_only = flight.specular_only && sample.specular;
    if (flight.mirrored) {
      const bool reflected = sample.specular && !sample.transmitted;
      flight.chain =
          reflected ? mirrors_.follow(flight.chain, point.triangle, point.front) : MirrorPlanes::kNone;
      flight.mirrored = flight.chain != MirrorPlanes::kNone;
    }
    const bool ahead = glm::dot(sample.direction, point.geometric_normal) >= 0;
    flight.in_glass =
        rays_.scene().material[point.material].model == Model::dielectric && ahead != point.front;
    return After::scattered;
  }

  /// A flight that is told of by others.
  static bool drop(const Flight& flight, Part& part) {
    part.absorbed += flight.units;
    return false;
  }

  /// The children of a flight astray that has met a surface.
  void send_through_portals(const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo, const Flight& parent,
                            Part& part) const {
    RandomStream random(seed_, Stage::through_portal, parent.number);
    random.start_bounce(parent.events);
    std::vector<PortalSplit::Child> children;
    split_->children(point, bsdf, wo, parent.flux_lm, random, children);
    for (std::size_t i = 0; i < children.size(); ++i) {
      Flight child = parent;
      child.flux_lm *= children[i].weight;
      if (!is_finite(child.flux_lm)) {
        ++part.non_finite;
        continue;
      }
      child.units = units(child.flux_lm);
      child.ray = Ray{point.leave(children[i].direction), children[i].direction};
      child.source_normal = glm::dot(children[i].direction, point.geometric_normal) >= 0
                                ? point.geometric_normal
                                : -point.geometric_normal;
      child.from_infinity = child.specular_only = child.mirrored = child.in_glass = false;
      child.chain = MirrorPlanes::kNone;
      ++child.bounce;
      child.astray = Flight::Astray::child;
      child.portal_m = split_->first_crossing_m(point.position, children[i].direction);
      // Of the light that the surface took.
      part.absorbed -= child.units;
      RandomStream own(seed_, Stage::through_portal, mixed(parent.number, parent.events, i));
      while (largest(child.flux_lm) > 0 && step(child, own, part)) {
      }
    }
  }

  /// Numbers a child's random stream (Steele et al. 2014, SplitMix64).
  static std::uint64_t mixed(std::uint64_t path, std::uint32_t event, std::size_t child) {
    std::uint64_t z = path + 0x9e3779b97f4a7c15u * ((std::uint64_t{event} << 32 | child) + 1);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (z ^ (z >> 31)) | std::uint64_t{1} << 63;  // apart from those of parents
  }

  const RayScene& rays_;
  const Emitter& emitter_;
  const MirrorPlanes& mirrors_;
  const CausticAim* aim_;
  std::optional<PortalSplit> split_;
  std::uint64_t paths_, aimed_paths_;
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

/// Puts the parts' photons behind all others; the parts keep their memory for the next wave.
void join_photons(std::span<Part> parts, Photons& all, std::size_t expected_rows) {
  std::vector<std::size_t> first{all.size()};
  for (const Part& part : parts) first.push_back(first.back() + part.photons.size());
  for_columns(
      [&](auto& column) {
        if (first.back() > column.capacity()) column.reserve(std::max(first.back(), expected_rows));
        column.resize(first.back());
      },
      all);
  parallel_for(parts.size(), 1, [&](std::size_t i) {
    for_columns(
        [&](auto& column, auto& own) {
          std::copy(own.begin(), own.end(), column.begin() + static_cast<std::ptrdiff_t>(first[i]));
          own.clear();
        },
        all, parts[i].photons);
  });
  for (Part& part : parts) {
    append(all.flights, columns_of(part.photons.flights));
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
  options.integer(
      "photons", p.paths, "N",
      "paths emitted from the lights; each stores a photon on every surface it reaches that is not purely "
      "mirror or glass (both numbers are printed)",
      {0, 0x1p40});
  options.integer(
      "caustic-photons", p.caustic_paths, "N",
      "where there are mirrors or glass: paths aimed from the lamps at these, which find all light "
      "that reaches surfaces by way of them alone; -1: as many as --photons; 0: none, such light "
      "is what other paths find",
      {-1, 0x1p40}, Recorded::unless_default);
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
  const std::uint64_t aimed =
      static_cast<std::uint64_t>(options.caustic_paths < 0 ? options.paths : options.caustic_paths);
  std::optional<CausticAim> aim;
  if (aimed > 0 && casts_caustics(rays.scene())) aim.emplace(rays);
  if (aim && aim->empty()) aim.reset();
  const PathTracer tracer(rays, emitter, aim ? &*aim : nullptr, totals.emitted, aimed, seed, log != nullptr);
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
        tracer.trace_aimed(first + i, part);
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
