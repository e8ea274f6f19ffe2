// A record ahead is on the mean what the next frame has there.
#include "temporal/ahead.h"

#include <gtest/gtest.h>

#include "support/moving_rooms.h"
#include "support/two_frames.h"

namespace phos {
namespace {

using test::Mover;

struct Mean {
  double sum = 0, squares = 0, n = 0;
  void add(double x) { sum += x, squares += x * x, n += 1; }
  double mean() const { return sum / n; }
  double error() const { return std::sqrt(std::max(0.0, squares / n - mean() * mean()) / (n - 1)); }
};

/// By reprojection alone, in rooms where a lamp, what casts a shadow, what reflects, or the place itself
/// moves. What lamps do is unbiased; what comes to light behind things is guessed, which may cost a
/// part `guessed` of the change, and of a fiftieth of the light.
TEST(Ahead, IsTheNextFrameOnTheMean) {
  const RecordSite sites[] = {{{2.1f, 0.2f, 2.1f}, {0, 1, 0}, 0},
                              {{4, 1.3f, 2.2f}, {-1, 0, 0}, 0},
                              {{1.2f, 0, 3.1f}, {0, 1, 0}, 0},
                              {{2.5f, 3, 1.8f}, {0, -1, 0}, 0}};
  for (const auto& [mover, guessed] : {std::pair{Mover::lamp, 0.0},
                                       {Mover::dimmer, 0.0},
                                       {Mover::occluder, 0.2},
                                       {Mover::wall, 0.2},
                                       {Mover::floor, 0.2}}) {
    const test::TwoFrames f(test::moving_room(mover, 0), test::moving_room(mover, 1));
    const RecordOptions options = test::gather_options(f.scene[0], Quantity::indirect, 1, 512);
    const GatherEstimator now(f.rays[0], f.lights[0], {}, options, 1),
        next(f.rays[1], f.lights[1], {}, options, 1);
    const AheadEstimator ahead({now, f.rays[0], f.lights[0]}, {next, f.rays[1], f.lights[1]}, f.change,
                               options, 1, {.most_holes = 1});
    const auto worker = ahead.make_worker(), alone = next.make_worker();
    for (RecordSite site : sites) {
      Mean reached, truth, change;
      for (std::uint64_t item = 0; item < 256; ++item) {
        site.item = item;
        const Made made = ahead.make(site, *worker);
        ASSERT_TRUE(made.ahead);
        const IrradianceRecord& r = made.ahead->record;
        const auto there =
            static_cast<double>(next.make({r.position, r.normal, item}, *alone).record.irradiance.y);
        truth.add(there);
        reached.add(static_cast<double>(r.irradiance.y) - there);
        change.add(static_cast<double>(made.record.irradiance.y) - there);
      }
      EXPECT_NEAR(reached.mean(), 0,
                  4 * reached.error() + guessed * (std::fabs(change.mean()) + 0.02 * truth.mean()))
          << test::name_of(mover) << " at " << site.position.x << ", change " << change.mean() / truth.mean();
    }
  }
}

}  // namespace
}  // namespace phos
