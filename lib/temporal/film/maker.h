// The records of a film.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "place/placement_options.h"
#include "temporal/chain.h"
#include "temporal/film/options.h"
#include "temporal/frame_light.h"
#include "temporal/journal.h"
#include "temporal/survey.h"

namespace phos::inline temporal {

/// The light of the frames in work: the last few that were asked for.
class FrameLights {
 public:
  /// `source` as of FrameLight. Holds references.
  FrameLights(FrameScenes& scenes, const LightOptions& options, const Film* source)
      : scenes_(scenes), options_(options), source_(source) {}
  FrameLight& at(std::int64_t frame);
  const FrameScene& scene_at(std::int64_t frame) { return *(last_ = scenes_.at(frame)); }
  /// Those that were asked for.
  const std::set<std::int64_t>& frames() const { return frames_; }

 private:
  static constexpr std::size_t kKept = 3;
  FrameScenes& scenes_;
  const LightOptions& options_;
  const Film* source_;
  std::vector<std::unique_ptr<FrameLight>> recent_;
  std::shared_ptr<const FrameScene> last_;
  std::set<std::int64_t> frames_;
};

struct FilmReport {
  std::uint64_t chains = 0, records = 0;
  std::uint64_t estimates = 0;               ///< records made, those that were not kept among them
  std::set<std::int64_t> frames_with_light;  ///< at which any was made
  std::uint64_t uncovered = 0;
  std::uint64_t kept_alive = 0, deleted = 0;  ///< places at the end of a life: replaced, or out of sight
  double making_s = 0;
  std::map<std::int64_t, std::uint64_t> lives;  ///< records by frames that they live
};

inline constexpr std::int64_t kMostTasks = 64;

/// What is estimated, and where.
struct FilmTask {
  RecordOptions records;  ///< resolved
  PlacementOptions placement;
  MaterialFilter wanted;  ///< empty: diffuse surfaces
  std::function<const Estimator&(FrameLight&)> estimator;
  MaterialFilter unwanted{};           ///< of those, not these; empty: all
  std::int64_t number = 0;             ///< among the tasks of a film; below kMostTasks
  EstimateJournal* journal = nullptr;  ///< null: nothing is kept of an interrupted run
  std::string label = "film";          ///< of its progress
};

/// An estimator, by way of the journal if there is one.
class Kept {
 public:
  Kept(const Estimator& estimator, const FilmTask& task, std::int64_t frame) : estimator_(&estimator) {
    if (!task.journal) return;
    by_journal_ =
        std::make_unique<JournalEstimator>(estimator, *task.journal, kMostTasks * frame + task.number);
    estimator_ = by_journal_.get();
  }
  const Estimator& operator*() const { return *estimator_; }

 private:
  std::unique_ptr<const JournalEstimator> by_journal_;
  const Estimator* estimator_;
};

class FilmMaker {
 public:
  /// Holds references.
  FilmMaker(FrameLights& lights, const FilmSurvey& survey, const FilmOptions& options, FilmTask task,
            Counters& counters);

  /// All frames.
  void run();
  /// For a film in which no light changes: the places that its frames need, at the first frame.
  void still();
  const std::vector<Chain>& chains() const { return chains_; }
  std::vector<Chain> take_chains() { return std::move(chains_); }
  /// Chains are numbered from here on.
  void number_from(std::uint32_t first) { next_number_ = first; }
  std::uint32_t next_number() const { return next_number_; }
  /// All counts but the numbers of chains, records and lives, which the chains give.
  FilmReport report() const;

 private:
  struct Segment {
    std::size_t chain;
    std::int64_t begin, end;
    std::int64_t depth;  ///< halvings before it
  };
  /// Chains that may begin at `begin`, before their first keys.
  struct Late {
    std::vector<std::size_t> chains;
    std::int64_t begin = 0;
  };
  void block(std::int64_t begin, std::int64_t end, const FrameRange& shot, Progress& progress);
  void frame_by_rate(std::int64_t frame, const FrameRange& shot);
  void live(Key& key, const Chain& chain, const Made& made, const FrameScene* next, std::int64_t most) const;
  std::vector<std::size_t> there_at(std::int64_t frame);
  std::vector<std::size_t> place_at(std::int64_t frame, std::span<const std::int64_t> looks);
  Late add_late(std::int64_t frame, std::int64_t looked, std::span<const RecordSite> sites,
                std::int64_t begin);
  void add_chains(FrameLight& light, const Estimator& estimator, IrradianceCache& known,
                  std::span<const RecordSite> sites, std::vector<Made>& made);
  std::vector<Key> estimate(std::span<const std::size_t> chains, FrameLight& light,
                            const Estimator& estimator, std::vector<std::size_t>& there,
                            std::vector<Made>& made);
  std::vector<Key> estimate_at(std::int64_t frame, std::span<const std::size_t> chains,
                               std::vector<std::size_t>& there);
  void estimate_anew(std::size_t first, FrameLight& light);
  void set_floor();
  void end_at(std::span<const std::size_t> chains, std::int64_t frame);
  void begin_at(std::span<const std::size_t> chains, std::int64_t frame);
  void begin_appeared(std::span<const std::size_t> chains, std::int64_t begin);
  void end_vanished(std::span<const std::size_t> chains, std::int64_t begin, std::int64_t end);
  void refine(std::span<const std::size_t> chains, std::int64_t begin);
  void cover(std::vector<std::size_t>& wanted, std::int64_t begin, std::int64_t end, std::int64_t look);
  bool is_straight(const Key& from, const Key& middle, const Key& to, double& share) const;

  FrameLights& lights_;
  const FilmSurvey& survey_;
  const FilmOptions& options_;
  FilmTask task_;
  Counters& counters_;
  std::vector<Chain> chains_;
  RadiusBounds bounds_;
  std::uint32_t next_number_ = 0;
  double floor_ = 0;
  FilmReport report_;
};

}  // namespace phos::inline temporal
