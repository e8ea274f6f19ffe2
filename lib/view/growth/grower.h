// Lets a cache grow in a thread of its own, and answers the pages that ask for records.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/counters.h"
#include "core/error.h"
#include "core/vector.h"
#include "view/growth/grown_cache.h"
#include "view/growth/growth_log.h"
#include "view/growth/growth_wish.h"

namespace phos::inline view {

/// Values of growth.state.
enum class GrowthState : std::uint32_t {
  preparing = 0,  ///< points are queued
  growing = 1,
  full = 2,   ///< kMostGrownRecords are there
  ended = 3,  ///< by an error, which the program has told
};

/// All that has grown.
struct Grown {
  std::vector<IrradianceRecord> records;
  Counters counters;  ///< numerical events of making them
};

struct GrowerParts {
  Bounds scene{};
  std::size_t most_points = 0;  ///< of a message
  double reach = 1;             ///< radii are multiplied by this for the page
  /// Called once, in the thread of the grower.
  std::function<std::shared_ptr<GrownCache>()> make;
  /// Writes the new records with those that were there. In the thread of the grower; empty: pages cannot
  /// save.
  std::function<void(const Grown& grown)> save{};
  /// Says an error. In the thread of the grower.
  std::function<void(const std::string& line)> warn{};
};

/// All pages share one cache. Pages send points, and fetch the changes since the last that they have; no call
/// waits for records.
class Grower {
 public:
  explicit Grower(GrowerParts parts);
  ~Grower();
  Grower(const Grower&) = delete;
  Grower& operator=(const Grower&) = delete;

  /// MessageKind::grown, the answer to MessageKind::wish. Throws Error(bad_input) as read_growth_wish() does.
  std::string answer(std::string_view wish);
  /// Of the last change; 0: nothing has grown.
  std::uint32_t serial() const;
  Grown grown() const;
  /// Ends the thread. Records of which a batch is being made are given up.
  void stop();

 private:
  struct Task {
    double share = 1;
    std::vector<SurfaceSample> points;
  };
  void work();
  bool wait_for_task(Task& task, bool& save);
  void grow(GrownCache& cache, const Task& task);
  void save();
  void warn(const Error& e) const;

  GrowerParts parts_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  // Under the mutex.
  std::deque<Task> tasks_;
  std::size_t waiting_ = 0;  // points of tasks, and of the task at work
  GrowthLog log_;
  Counters counters_;
  GrowthState state_ = GrowthState::preparing;
  bool stopped_ = false, save_wanted_ = false, save_failed_ = false;
  std::uint32_t saved_serial_ = 0, saves_ = 0;
  std::thread thread_;
};

}  // namespace phos::inline view
