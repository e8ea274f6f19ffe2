// Makes records in parallel and accepts those that are needed.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/counters.h"
#include "estimate/estimator.h"
#include "place/candidates.h"
#include "place/growth.h"

namespace phos::inline place {

/// One estimator, at work in all threads (in one, if it must).
class ParallelMaker {
 public:
  explicit ParallelMaker(const Estimator& estimator) : estimator_(estimator) {}

  /// Records at all these sites, in their order.
  std::vector<Made> make(std::span<const RecordSite> sites);
  /// The same at points [first, first + count), with progress.
  std::vector<Made> make_at(std::span<const SurfaceSample> points, std::size_t first, std::size_t count);

  std::uint64_t made() const { return made_; }
  double seconds() const { return seconds_; }  ///< wall time spent in making
  /// What happened in all threads together.
  void count_into(Counters& counters) const;

 private:
  std::unique_ptr<Estimator::Worker> take_worker();
  void give_back(std::unique_ptr<Estimator::Worker> worker);

  const Estimator& estimator_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Estimator::Worker>> workers_;  // idle ones
  std::uint64_t made_ = 0;
  double seconds_ = 0;
};

/// Lets a cache grow where nothing covers a site.
class Placer {
 public:
  Placer(ParallelMaker& maker, Growth& growth);

  /// Makes records at sites that nothing covers and accepts them one after another, each unless a record
  /// before covers it. A batch grows while its records keep clear of each other and shrinks when they cover
  /// each other's places, so that few are made in vain. Returns how many were accepted.
  std::size_t cover(std::span<const RecordSite> open);

 private:
  ParallelMaker& maker_;
  Growth& growth_;
  std::size_t batch_size_;
};

}  // namespace phos::inline place
