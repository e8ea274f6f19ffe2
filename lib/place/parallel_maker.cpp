#include "place/parallel_maker.h"

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace phos::inline place {
namespace {

constexpr std::size_t kChunk = 4;     // records made by one task
constexpr std::size_t kBlock = 4096;  // records made between two reports of progress
constexpr std::size_t kLeastBatch = 16, kMostBatch = 128;

}  // namespace

std::vector<Made> ParallelMaker::make(std::span<const RecordSite> sites) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Made> made(sites.size());
  const auto run = [&](std::size_t begin, std::size_t end) {
    std::unique_ptr<Estimator::Worker> worker = take_worker();
    for (std::size_t i = begin; i < end; ++i) {
      made[i] = estimator_.make(sites[i], *worker);
      made[i].item = sites[i].item;
    }
    give_back(std::move(worker));
  };
  if (estimator_.one_thread())
    run(0, sites.size());
  else
    parallel_chunks(sites.size(), kChunk, run);
  made_ += sites.size();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return made;
}

std::vector<Made> ParallelMaker::make_at(std::span<const SurfaceSample> points, std::size_t first,
                                         std::size_t count) {
  PHOS_CHECK(first + count <= points.size(), first, " + ", count, " of ", points.size());
  const Candidates candidates = point_candidates(points);
  Progress progress("records", count, "records");
  std::vector<Made> all;
  all.reserve(count);
  for (std::size_t done = 0; done < count;) {
    std::vector<RecordSite> sites;
    for (; done < count && sites.size() < kBlock; ++done) candidates.sites(first + done, sites);
    const std::vector<Made> made = make(sites);
    all.insert(all.end(), made.begin(), made.end());
    progress.advance(made.size());
  }
  return all;
}

void ParallelMaker::count_into(Counters& counters) const {
  for (const auto& worker : workers_) counters.merge(worker->counters);
}

std::unique_ptr<Estimator::Worker> ParallelMaker::take_worker() {
  const std::lock_guard lock(mutex_);
  if (workers_.empty()) return estimator_.make_worker();
  std::unique_ptr<Estimator::Worker> worker = std::move(workers_.back());
  workers_.pop_back();
  return worker;
}

void ParallelMaker::give_back(std::unique_ptr<Estimator::Worker> worker) {
  const std::lock_guard lock(mutex_);
  workers_.push_back(std::move(worker));
}

Placer::Placer(ParallelMaker& maker, Growth& growth)
    : maker_(maker), growth_(growth), batch_size_(kLeastBatch) {}

std::size_t Placer::cover(std::span<const RecordSite> open) {
  std::size_t placed = 0;
  for (std::size_t begin = 0; begin < open.size();) {
    std::vector<RecordSite> batch;
    for (; begin < open.size() && batch.size() < batch_size_; ++begin) {
      if (!growth_.covered(open[begin])) batch.push_back(open[begin]);
    }
    const std::vector<Made> made = maker_.make(batch);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (growth_.covered(batch[i])) continue;
      growth_.accept(made[i]);
      ++kept;
    }
    const bool in_vain = kept * 10 < made.size() * 9;
    batch_size_ = std::clamp(in_vain ? batch_size_ / 2 : batch_size_ * 2, kLeastBatch, kMostBatch);
    placed += kept;
  }
  return placed;
}

}  // namespace phos::inline place
