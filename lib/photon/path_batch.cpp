#include "photon/path_batch.h"

#include <tuple>
#include <vector>

#include "scene/texture/ask_texels.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kBatch = 64;       // paths: their data stay in the first caches
constexpr std::size_t kLarge = 4096;     // triangles: where fewer stay in the caches, batches only cost
constexpr std::size_t kTexelsAhead = 6;  // paths

class Batch {
 public:
  Batch(const PathTracer& tracer, std::uint64_t begin, std::uint64_t end, PathPart& part)
      : tracer_(tracer), next_(begin), end_(end), part_(part) {
    flight_.reserve(kBatch), random_.reserve(kBatch);
  }

  void trace() {
    while (!has_no_end(part_) && fill()) {
      fly();
      land();
    }
  }

 private:
  /// Starts paths until the batch is full, or there are no more. False: it is empty.
  bool fill() {
    while (flight_.size() < kBatch && (next_ < end_ || aimed_ < aimed_end_)) {
      Flight flight;
      flight.turn = part_.turns++;
      if (aimed_ < aimed_end_) {
        RandomStream random = tracer_.aimed_stream(aimed_);
        if (tracer_.start_aimed(aimed_++, random, flight, part_)) add(flight, random);
        continue;
      }
      RandomStream random = tracer_.stream(next_);
      if (tracer_.start(next_, random, flight, part_)) add(flight, random);
      std::tie(aimed_, aimed_end_) = tracer_.aimed_with(next_++);
    }
    return !flight_.empty();
  }

  void add(const Flight& flight, const RandomStream& random) {
    flight_.push_back(flight), random_.push_back(random);
  }

  void fly() {
    const std::size_t n = flight_.size();
    draws_.resize(n), hit_.resize(n), point_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      draws_[i] = tracer_.depart(flight_[i], random_[i], part_);
      hit_[i] = Hit();
      if (!tracer_.rays().intersect(flight_[i].ray, hit_[i])) hit_[i].distance_m = kInfinity;
    }
    for (std::size_t i = 0; i < n; ++i) {
      tracer_.rays().ask_ahead(hit_, i);
      if (met(i)) point_[i] = tracer_.rays().surface(flight_[i].ray, hit_[i]);
    }
  }

  bool met(std::size_t i) const { return hit_[i].distance_m < kInfinity; }

  /// Those that go on move up.
  void land() {
    const Scene& scene = tracer_.rays().scene();
    const std::size_t n = flight_.size();
    const auto ask = [&](std::size_t i) {
      if (i < n && met(i)) ask_texels(scene, point_[i]);
    };
    for (std::size_t i = 0; i < kTexelsAhead; ++i) ask(i);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
      ask(i + kTexelsAhead);
      const bool goes_on = land(i);
      part_.turn.resize(part_.photons.size(), flight_[i].turn);
      part_.flight_turn.resize(part_.photons.flights.size(), flight_[i].turn);
      if (!goes_on) continue;
      if (kept != i) flight_[kept] = flight_[i], random_[kept] = random_[i];
      ++kept;
    }
    flight_.resize(kept), random_.erase(random_.begin() + static_cast<std::ptrdiff_t>(kept), random_.end());
  }

  bool land(std::size_t i) {
    Flight& flight = flight_[i];
    if (!met(i)) return tracer_.escape(flight, part_), false;
    const Bsdf bsdf(tracer_.rays().scene(), point_[i]);
    const PathTracer::After after = tracer_.land(point_[i], bsdf, draws_[i], flight, random_[i], part_);
    // Without panes no light passes straight.
    if (after == PathTracer::After::passed) return tracer_.escape(flight, part_), false;
    return after == PathTracer::After::scattered && PathTracer::carries_light(flight);
  }

  const PathTracer& tracer_;
  std::uint64_t next_, end_;
  std::uint64_t aimed_ = 0, aimed_end_ = 0;  // aimed paths of the path before `next_`
  PathPart& part_;
  std::vector<Flight> flight_;
  std::vector<RandomStream> random_;
  std::vector<PathTracer::Draws> draws_;
  std::vector<Hit> hit_;
  std::vector<SurfacePoint> point_;
};

}  // namespace

void trace_paths(const PathTracer& tracer, std::uint64_t begin, std::uint64_t end, PathPart& part) {
  const bool large = tracer.rays().scene().triangle.size() >= kLarge;
  if (large && tracer.steps_alike()) return Batch(tracer, begin, end, part).trace();
  for (std::uint64_t path = begin; path < end && !has_no_end(part); ++path) {
    tracer.trace(path, part);
    ++part.turns;
  }
}

}  // namespace phos::inline photon
