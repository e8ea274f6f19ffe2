// Estimates of an interrupted film, kept so that the next run does not make them again.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/error.h"
#include "estimate/estimator.h"

namespace phos::inline temporal {

/// A file that grows by each estimate as it is made. Entries carry checksums: one that was cut off, and all
/// after it, are not there. The order of entries does not matter, and the film of a run that goes on from a
/// journal equals the film of an uninterrupted run, byte for byte.
class EstimateJournal {
 public:
  /// Estimates of the run that `key` stands for. With `go_on`, those that an earlier run of the same key
  /// left; else, or if the file is another run's or damaged, it begins anew. Throws Error(bad_input) if it
  /// cannot be written.
  EstimateJournal(const std::string& path, const std::string& key, bool go_on);
  ~EstimateJournal();
  std::size_t found() const { return entries_.size(); }  ///< left by an earlier run
  /// Work that adds to it. Where that is interrupted, the error names the estimates that are kept, and how to
  /// go on.
  template <class Work>
  auto keeping(const Work& work) {
    try {
      return work();
    } catch (const Error& e) {
      tell_kept(e);
      throw;
    }
  }
  /// Removes the file: the film is whole.
  void finish();

 private:
  friend class JournalEstimator;
  using Id = std::pair<std::int64_t, std::uint64_t>;  // group, item
  struct Entry {
    Made made;
    std::map<std::string, std::uint64_t> events;
  };
  void tell_kept(const Error& e);
  const Entry* find(const Id& id) const;
  void add(const Id& id, const Made& made, const Counters& events);
  std::size_t read(const std::string& bytes);

  std::string path_, key_;
  std::map<Id, Entry> entries_;
  std::mutex mutex_;
  std::size_t added_ = 0;
  std::ofstream file_;
};

/// Takes estimates from a journal, or makes them and adds them to it. Items must be unique within a `group`
/// (a frame of a task).
class JournalEstimator : public Estimator {
 public:
  JournalEstimator(const Estimator& inner, EstimateJournal& journal, std::int64_t group)
      : inner_(inner), journal_(journal), group_(group) {}
  std::unique_ptr<Worker> make_worker() const override;
  Made make(const RecordSite& site, Worker& worker) const override;
  bool one_thread() const override { return inner_.one_thread(); }

 private:
  struct Inner;
  const Estimator& inner_;
  EstimateJournal& journal_;
  std::int64_t group_;
};

}  // namespace phos::inline temporal
