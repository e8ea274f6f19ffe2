#include "view/growth/grower.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "view/limits.h"
#include "view/message/writer.h"
#include "view/records_message.h"

namespace phos::inline view {
namespace {

constexpr std::size_t kMostTasks = 16;      // more pages than that wait; the oldest is dropped
constexpr std::size_t kAtOnce = 32;         // points between two looks of the pages
constexpr std::size_t kMostChanges = 1024;  // of an answer

std::uint32_t number(std::size_t n) { return static_cast<std::uint32_t>(n); }

}  // namespace

Grower::Grower(GrowerParts parts) : parts_(std::move(parts)), thread_([this] { work(); }) {}

Grower::~Grower() { stop(); }

void Grower::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::uint32_t Grower::serial() const {
  const std::lock_guard lock(mutex_);
  return log_.serial();
}

Grown Grower::grown() const {
  const std::lock_guard lock(mutex_);
  return {{log_.records().begin(), log_.records().end()}, counters_};
}

std::string Grower::answer(std::string_view bytes) {
  GrowthWish wish = read_growth_wish(bytes, parts_.scene, parts_.most_points);
  MessageWriter message(MessageKind::grown);
  const auto add = [&](const char* name, std::uint32_t value) {
    message.add("growth", name, std::vector<std::uint32_t>{value});
  };
  std::vector<IrradianceRecord> changed;
  {
    const std::lock_guard lock(mutex_);
    const bool grows = state_ == GrowthState::preparing || state_ == GrowthState::growing;
    if (grows && !wish.points.empty()) {
      if (tasks_.size() == kMostTasks) waiting_ -= tasks_.front().points.size(), tasks_.pop_front();
      waiting_ += wish.points.size();
      tasks_.push_back({std::min(wish.share, 1.0), std::move(wish.points)});
    }
    save_wanted_ = save_wanted_ || (wish.save && parts_.save && state_ != GrowthState::ended);
    const GrowthLog::Changes changes = log_.since(wish.since, kMostChanges);
    add("serial", changes.serial), add("more", changes.more ? 1 : 0);
    add("state", static_cast<std::uint32_t>(state_)), add("waiting", number(waiting_));
    add("records", number(log_.records().size()));
    add("saves", saves_), add("save_failed", save_failed_ ? 1 : 0);
    message.add("record", "row", changes.rows);
    for (const std::uint32_t row : changes.rows) changed.push_back(log_.records()[row]);
  }
  wake_.notify_all();
  for (IrradianceRecord& r : changed) r.radius_m *= static_cast<float>(parts_.reach);
  add_records(changed, message);
  return message.message();
}

bool Grower::wait_for_task(Task& task, bool& save) {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [&] { return stopped_ || save_wanted_ || !tasks_.empty(); });
  if (stopped_) return false;
  save = std::exchange(save_wanted_, false);
  task = {};
  if (!tasks_.empty()) task = std::move(tasks_.front()), tasks_.pop_front();
  return true;
}

void Grower::grow(GrownCache& cache, const Task& task) {
  for (std::size_t begin = 0; begin < task.points.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, task.points.size() - begin);
    const bool full = cache.size() + count > kMostGrownRecords.as<std::size_t>();
    const std::size_t grown = full ? 0 : cache.grow(std::span(task.points).subspan(begin, count), task.share);
    const std::lock_guard lock(mutex_);
    waiting_ -= count;
    if (full) state_ = GrowthState::full;
    if (grown > 0) {
      log_.update(cache.records());
      counters_ = {};
      cache.count_into(counters_);
    }
    if (stopped_) return;
  }
}

void Grower::save() {
  const std::uint32_t serial = this->serial();  // changes in this thread alone
  if (saves_ > 0 && serial == saved_serial_ && !save_failed_) return;
  bool failed = false;
  try {
    parts_.save(grown());
  } catch (const Error& e) {
    if (e.code() == ExitCode::interrupted) throw;
    failed = true;
    warn(e);
  }
  const std::lock_guard lock(mutex_);
  save_failed_ = failed;
  if (!failed) saved_serial_ = serial, ++saves_;
}

void Grower::warn(const Error& e) const {
  if (parts_.warn) parts_.warn(text(e.where(), e.where().empty() ? "" : ": ", e.what()));
}

void Grower::work() {
  set_flush_to_zero();
  try {
    const std::shared_ptr<GrownCache> cache = parts_.make();
    {
      const std::lock_guard lock(mutex_);
      state_ = GrowthState::growing;
    }
    Task task;
    for (bool save_now = false; wait_for_task(task, save_now);) {
      if (save_now) save();
      grow(*cache, task);
    }
    return;
  } catch (const Error& e) {
    if (e.code() != ExitCode::interrupted) warn(e);
  } catch (const std::exception& e) {  // of memory
    warn(Error(ExitCode::bad_input, "", text("the cache does not grow further: ", e.what())));
  }
  const std::lock_guard lock(mutex_);
  state_ = GrowthState::ended;
  tasks_.clear();
  waiting_ = 0;
}

}  // namespace phos::inline view
