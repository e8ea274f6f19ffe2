#include "place/on_surfaces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/sampling.h"
#include "place/events.h"
#include "place/growth.h"
#include "place/parallel_maker.h"
#include "place/placement.h"
#include "place/placement_options.h"
#include "place/refinement.h"
#include "place/surface_sides.h"

namespace phos::inline place {
namespace {

constexpr float kFine = 0.125f;  // a piece this small beside the reach of a record there is not cut further
constexpr float kInset = 1 / 64.f;  // corners of pieces are looked at this far inwards
constexpr int kDeepest = 40;        // cuts of a triangle: finer ones are lost in the rounding of floats
constexpr int kDeepEnough = 8;      // cuts after which all of a large closed piece is taken to be so
constexpr std::size_t kFreshPoints = 1 << 16;
constexpr std::size_t kTaskPieces = 64;

/// A part of a triangle's side, cut at its longest edge again and again.
struct Piece {
  Side side = 0;
  int depth = 0;
  Vec2 corner[3]{{0, 0}, {1, 0}, {0, 1}};

  Vec2 middle() const { return (corner[0] + corner[1] + corner[2]) / 3.f; }
  /// The halves on either side of the middle of the edge opposite corner `apex`.
  Piece half(int apex, bool second) const {
    const Vec2 cut = (corner[(apex + 1) % 3] + corner[(apex + 2) % 3]) / 2.f;
    Piece piece{side, depth + 1, {corner[0], corner[1], corner[2]}};
    piece.corner[(apex + (second ? 1 : 2)) % 3] = cut;
    return piece;
  }
};

enum class Finding : std::uint8_t {
  covered,  ///< by one record, or well enough
  open,     ///< nothing covers its middle
  cut,      ///< to be looked at in halves
  closed,   ///< the whole side is in a solid
};

struct Look {
  Finding finding = Finding::covered;
  std::uint8_t apex = 0;  ///< corner opposite the longest edge
  RecordSite site;        ///< its middle
};

/// Numbers 0 .. n-1 in an order that jumps about: neighbours in it are far apart.
class Jumps {
 public:
  explicit Jumps(std::size_t n)
      : n_(n), step_(std::max<std::size_t>(1, static_cast<std::size_t>(0.618034 * static_cast<double>(n)))) {
    while (std::gcd(step_, n_) > 1) ++step_;
  }
  std::size_t operator[](std::size_t i) const { return i * step_ % n_; }

 private:
  std::size_t n_, step_;
};

class SurfaceCover {
 public:
  SurfaceCover(const RayScene& rays, const RecordOptions& resolved, const MaterialFilter& wanted,
               Growth& growth, Placer& placer)
      : rays_(rays),
        options_(resolved),
        sides_(rays),
        growth_(growth),
        placer_(placer),
        accuracy_(static_cast<float>(resolved.accuracy)),
        least_reach_m_(static_cast<float>(resolved.accuracy * *resolved.min_radius_m)),
        reachable_(2 * rays.scene().triangle.size()) {
    std::copy_if(sides_.sides().begin(), sides_.sides().end(), std::back_inserter(wanted_),
                 [&](Side side) { return !wanted || wanted(sides_.point(side, Vec2(1 / 3.f)).material); });
  }

  /// Looks at all surfaces and covers open places.
  void pass(int number);
  /// The share of the surface in reach of light that fresh points find open, by area or each triangle alike.
  double open_share(int pass, bool by_area) const;

  std::uint64_t pieces() const { return pieces_; }
  std::uint64_t sides() const { return wanted_.size(); }
  std::uint64_t sides_inside() const {
    return static_cast<std::uint64_t>(
        std::count_if(wanted_.begin(), wanted_.end(), [&](Side side) { return !reachable_[side]; }));
  }

 private:
  Look look(const Piece& piece) const;
  Finding find(const Piece& piece, const SurfacePoint& middle, const SurfacePoint (&corner)[3],
               float length_m) const;
  bool valid(const IrradianceRecord& record, const SurfacePoint& point) const;
  std::vector<Piece> round(const std::vector<Piece>& pieces, Progress& progress);

  const RayScene& rays_;
  const RecordOptions& options_;
  SurfaceSides sides_;
  std::vector<Side> wanted_;  // of them
  Growth& growth_;
  Placer& placer_;
  float accuracy_, least_reach_m_;
  std::vector<std::uint8_t> reachable_;  // per side: some part is not closed
  std::uint64_t pieces_ = 0;
};

bool SurfaceCover::valid(const IrradianceRecord& record, const SurfacePoint& point) const {
  const Vec3 &p = point.position, &n = point.smooth_normal;
  const float weight = record_weight(record_error(record, p, n), accuracy_);
  if (!(weight > kLeastWeight) || record_apart(record, p, n)) return false;
  return options_.leak_test == LeakTest::none || record_in_sight(rays_, record, p, n);
}

/// A disc is convex on a flat triangle: a record that covers all corners covers the piece. A footprint is
/// not: pieces are cut until they are small beside its shortest axis.
Finding SurfaceCover::find(const Piece& piece, const SurfacePoint& middle, const SurfacePoint (&corner)[3],
                           float length_m) const {
  const bool last = piece.depth >= kDeepest;
  thread_local std::vector<const IrradianceRecord*> records;
  growth_.tree().valid(middle.position, middle.smooth_normal, records);
  float reach_m = 0;
  for (const IrradianceRecord* r : records) {
    reach_m = std::max(reach_m, accuracy_ * least_radius_m(*r));
    if (!r->footprint && std::all_of(corner, corner + 3, [&](const SurfacePoint& p) { return valid(*r, p); }))
      return Finding::covered;
  }
  if (!records.empty()) return last || length_m <= kFine * reach_m ? Finding::covered : Finding::cut;
  if (!sides_.closed_off(middle)) return Finding::open;
  if (last || length_m <= kFine * least_reach_m_) return Finding::closed;
  const bool all =
      std::all_of(corner, corner + 3, [&](const SurfacePoint& p) { return sides_.closed_off(p); });
  return all && (piece.depth >= kDeepEnough || length_m <= 4 * least_reach_m_) ? Finding::closed
                                                                               : Finding::cut;
}

Look SurfaceCover::look(const Piece& piece) const {
  const Vec2 uv = piece.middle();
  const SurfacePoint middle = sides_.point(piece.side, uv);
  SurfacePoint corner[3];
  for (int i = 0; i < 3; ++i) corner[i] = sides_.point(piece.side, glm::mix(piece.corner[i], uv, kInset));
  Look look;
  float longest = 0;
  for (int i = 0; i < 3; ++i) {
    const float length = glm::length(corner[(i + 1) % 3].position - corner[(i + 2) % 3].position);
    if (length > longest) longest = length, look.apex = static_cast<std::uint8_t>(i);
  }
  look.finding = find(piece, middle, corner, longest);
  look.site.position = middle.position, look.site.normal = middle.smooth_normal;
  return look;
}

/// Looks at pieces, covers open places, and returns the pieces to look at next.
std::vector<Piece> SurfaceCover::round(const std::vector<Piece>& pieces, Progress& progress) {
  std::vector<Piece> next;
  const Jumps order(pieces.size());
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::size_t block =
        std::min(pieces.size() - begin, std::clamp<std::size_t>(4 * growth_.size(), 64, 16384));
    std::vector<Look> looks(block);
    parallel_for(block, kTaskPieces, [&](std::size_t i) { looks[i] = look(pieces[order[begin + i]]); });
    std::vector<RecordSite> open;
    for (std::size_t i = 0; i < block; ++i) {
      const Piece& piece = pieces[order[begin + i]];
      const Look& seen = looks[i];
      if (seen.finding == Finding::covered || seen.finding == Finding::open) reachable_[piece.side] = 1;
      if (seen.finding == Finding::cut) {
        next.push_back(piece.half(seen.apex, false)), next.push_back(piece.half(seen.apex, true));
      } else if (seen.finding == Finding::open) {
        open.push_back(seen.site);
        open.back().item = kSurfaceItems + pieces_ + i;
        next.push_back(piece);
      }
    }
    placer_.cover(open);
    pieces_ += block, begin += block;
    progress.advance(block);
  }
  return next;
}

void SurfaceCover::pass(int number) {
  std::vector<Piece> pieces;
  for (const Side side : wanted_) {
    if (number == 1 || reachable_[side]) pieces.push_back({side});
  }
  for (int step = 1; !pieces.empty(); ++step) {
    Progress progress(text("records, pass ", number, ", step ", step), pieces.size(), "pieces of surface");
    pieces = round(pieces, progress);
  }
}

double SurfaceCover::open_share(int pass, bool by_area) const {
  std::vector<double> sum;
  double total = 0;
  for (const Side side : wanted_) sum.push_back(total += by_area ? sides_.area_m2(side) : 1);
  if (wanted_.empty()) return 0;
  struct Count {
    std::uint64_t open = 0, closed = 0;
  };
  const Count count = parallel_reduce<Count>(
      kFreshPoints, 1024, {},
      [&](std::size_t begin, std::size_t end) {
        Count part;
        for (std::size_t i = begin; i < end; ++i) {
          RandomStream random(static_cast<std::uint64_t>(pass), Stage::placement,
                              kSurfaceItems + 2 * i + (by_area ? 1 : 0));
          const double at = (static_cast<double>(i) + random.uniform_double()) / kFreshPoints * total;
          const auto found = std::upper_bound(sum.begin(), sum.end() - 1, at) - sum.begin();
          const SurfacePoint p =
              sides_.point(wanted_[static_cast<std::size_t>(found)], sample_triangle(random.uniform2()));
          if (growth_.tree().covered(p.position, p.smooth_normal)) continue;
          ++(sides_.closed_off(p) ? part.closed : part.open);
        }
        return part;
      },
      [](Count& all, const Count& part) { all.open += part.open, all.closed += part.closed; });
  const std::uint64_t reached = kFreshPoints - count.closed;
  return reached > 0 ? static_cast<double>(count.open) / static_cast<double>(reached) : 0;
}

}  // namespace

PlacementReport place_on_surfaces(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                                  const RecordOptions& resolved, const PlacementOptions& placement,
                                  Counters& counters, const MaterialFilter& wanted) {
  PlacementReport report;
  Growth growth(cache, rays, resolved, placement.error ? GrowthBy::error : GrowthBy::rules);
  ParallelMaker maker(estimator);
  Placer placer(maker, growth);
  SurfaceCover cover(rays, resolved, wanted, growth, placer);
  std::optional<Refinement> refinement;
  if (placement.error) refinement.emplace(growth, maker, resolved, *placement.error);
  const std::int64_t passes =
      refinement ? std::max<std::int64_t>(placement.passes, kErrorPasses) : placement.passes;
  for (int pass = 1; pass <= passes; ++pass) {
    report.passes = static_cast<std::uint64_t>(pass);
    cover.pass(pass);
    if (refinement) {
      if (pass < passes && refinement->refine() > 0) continue;
    } else if (pass < passes) {
      growth.compare();
    }
    report.uncovered_share = cover.open_share(pass, true);
    report.uncovered_share_of_triangles = cover.open_share(pass, false);
    if (std::max(*report.uncovered_share, *report.uncovered_share_of_triangles) < kSurfaceShare) break;
  }
  report.candidates = cover.pieces();
  report.sides = cover.sides(), report.sides_inside = cover.sides_inside();
  if (report.sides_inside > 0) counters.count(kSidesInsideEvent, report.sides_inside);
  const std::size_t first_new = cache.records.size();
  finish_placement(growth, maker, cache, report, counters);
  if (refinement && resolved.gradients != GradientMode::none)
    refinement->fit_gradients(cache.records, first_new);
  return report;
}

}  // namespace phos::inline place
