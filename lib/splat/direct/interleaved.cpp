#include "splat/direct/interleaved.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "scene/lamp/form.h"
#include "splat/direct/lamp_points.h"
#include "splat/direct/same_surface.h"

namespace phos::inline splat {
namespace {

constexpr int kBlock = kLampStrata;  // pixels each way that share a set of rays
constexpr int kReach = kBlock / 2;   // of a pixel's neighbours
constexpr std::size_t kTile = 16;    // pixels each way whose rays are sent together
constexpr std::size_t kChunk = 1024;
// Of the row or column at this distance: the outer two together count like one, so that the mean about a
// pixel holds each part of the set once.
constexpr float kShare[kReach + 1] = {1, 1, 0.5f};
/// Rays of a pixel to a lamp, all passes counted, from which on the rays of the pixels next to it suffice,
/// without the other pixels about it, and from which on its own rays suffice: the more, the less is blurred.
struct Enough {
  int next, own;
};
constexpr Enough kEnough = {16, 64};
/// Of a lamp whose light is not even, so that its noise is everywhere.
constexpr Enough kNoisyEnough = {128, 4096};
/// One in so many, and at least one, shows where a shadow's edge may be.
constexpr int kPerTest = 16;
/// Of one pass, that alone tell the variance of their mean.
constexpr int kTelling = 16;
/// Median of the square of a normal number.
constexpr double kMedianOfSquare = 0.455;
/// Variances of its noise beyond which a mean of nearer pixels counts: of a normal number; and, over the
/// number of rays that arrive or of those that do not, whichever are fewer, how many more: of few, chance
/// often makes twice as many.
constexpr double kDoubtMeans = 4, kDoubtFew = 4;
/// Relative noise of a pixel's own rays at which they suffice.
constexpr double kSure = 0.01;
/// So many tell how much less noise strata leave. Of fewer, most pixels have none.
constexpr double kEnoughTelling = 16;
/// Rays of one pass that it takes for that. A single one would be believed where it differs from most of
/// those about it, and not where it agrees: half shadows would come out too dark or too bright.
constexpr float kTold = 6;

/// What a shadow ray leaves from.
struct Receiver {
  Vec3 normal{0}, geometric_normal{0};
  float error_m = 0;
};

/// How far about a pixel.
enum Reach : std::size_t { kOwn, kNext, kAll, kReaches };

/// Bits: some ray of the pixel arrived, some did not.
enum : std::uint8_t { kNothing = 0, kSeen = 1, kBlocked = 2, kMixed = 3 };

class Interleaved {
 public:
  Interleaved(const RayScene& rays, const Luminaires& lights, const GBuffer& gbuffer, const RayShare& share,
              std::uint64_t seed)
      : lamps_(rays, lights),
        g_(gbuffer),
        share_(share),
        width_(static_cast<std::size_t>(gbuffer.width)),
        pixels_(gbuffer.hit.size()),
        seed_(seed) {}

  std::vector<SharedLight> light(const PixelRays& pixel_rays, const Vec2& subpixel) {
    find_receivers(pixel_rays, subpixel);
    shared_.assign(pixels_, SharedLight());
    sight_.resize(pixels_), found_.resize(pixels_), about_.resize(pixels_);
    for (std::size_t lamp = 0; lamp < lamps_.lights.size(); ++lamp) {
      const LampForm& form = lamps_.form[lamp];
      std::fill(sight_.begin(), sight_.end(), LampVisibility());
      brought_.assign(form.closed() ? 0 : pixels_, Brought());
      if (!lamps_.lights[lamp].extended()) {
        send(lamp, 0, 1, [](std::size_t) { return true; });
        for_each([&](std::size_t i) { shared_[i].illuminance += brought_[i].light; });
        continue;
      }
      const int first = share_.pass * share_.rays, tests = std::max(1, share_.rays / kPerTest);
      send(lamp, first, tests, [](std::size_t) { return true; });
      for_each([&](std::size_t i) { found_[i] = state(sight_[i]); });
      look_about();
      if (share_.rays > tests)
        send(lamp, first + tests, share_.rays - tests,
             [&](std::size_t i) { return about_[i] == kMixed || !form.closed(); });
      send_doubled(lamp, [&](std::size_t i) { return about_[i] == kMixed || !form.closed(); });
      if (form.closed()) {
        share_gain_ = gain_of_shares();
        for_each([&](std::size_t i) { add_share(lamp, i); });
      } else
        add_means(reach(lamp));
    }
    return std::move(shared_);
  }

 private:
  /// Of this pass.
  int rays_of(std::size_t i) const {
    return share_.doublings.empty() ? share_.rays : share_.rays << share_.doublings[i];
  }

  /// Sends the further rays of pixels whose rays are doubled. Their points on the lamp follow the points that
  /// the undoubled rays of all passes take.
  template <class Wanted>
  void send_doubled(std::size_t lamp, const Wanted& wanted) {
    if (share_.doublings.empty()) return;
    const int most = *std::max_element(share_.doublings.begin(), share_.doublings.end());
    for (int d = 1; d <= most; ++d) {
      const int more = share_.rays * ((1 << d) - 1);
      send(lamp, share_.rays * share_.passes + share_.pass * more, more,
           [&](std::size_t i) { return share_.doublings[i] == d && wanted(i); });
    }
  }

  std::size_t reach(std::size_t lamp) const {
    const std::int64_t rays = std::int64_t{share_.rays} * share_.passes;
    const Enough enough = lamps_.form[lamp].closed() ? kEnough : kNoisyEnough;
    if (rays >= enough.own && (lamps_.form[lamp].closed() || share_.rays >= kTelling)) return kOwn;
    return rays >= enough.next ? kNext : kAll;
  }

  static std::uint8_t state(const LampVisibility& s) {
    return static_cast<std::uint8_t>((s.seen > 0 ? kSeen : 0) | (s.sent > s.seen ? kBlocked : 0));
  }

  template <class Body>
  void for_each(const Body& body) const {
    parallel_for(pixels_, kChunk, [&](std::size_t i) {
      if (g_.covered(i)) body(i);
    });
  }

  void find_receivers(const PixelRays& pixel_rays, const Vec2& subpixel) {
    receiver_.resize(pixels_);
    for_each([&](std::size_t i) {
      const Ray ray = pixel_rays(static_cast<int>(i % width_), static_cast<int>(i / width_), subpixel);
      const SurfacePoint point = lamps_.rays.surface(ray, g_.hit[i]);
      receiver_[i] = {point.normal, point.geometric_normal, point.error_m};
    });
  }

  SurfacePoint point(std::size_t i) const {
    SurfacePoint p;
    p.position = Vec3(g_.position[i]);
    p.geometric_normal = receiver_[i].geometric_normal, p.normal = receiver_[i].normal;
    p.error_m = receiver_[i].error_m;
    return p;
  }

  /// Rays first .. first + count - 1 of each pixel's part of its block's set, of the pixels that want them.
  /// Tile by tile, the rays of one stratum of the lamp together: such rays run side by side.
  template <class Wanted>
  void send(std::size_t lamp, int first, int count, const Wanted& wanted) {
    const std::size_t height = pixels_ / width_;
    parallel_for((height + kTile - 1) / kTile, 1, [&](std::size_t row) {
      LampRays lamp_rays(lamps_);
      std::vector<SurfacePoint> from(kTile * kTile);
      std::vector<LampPoints> to(kTile * kTile);
      for (std::size_t x0 = 0, y0 = row * kTile; x0 < width_; x0 += kTile) {
        const auto each = [&](const auto& visit) {
          for (std::size_t k = 0; k < kTile * kTile; ++k) {
            const auto [x, y] = in_tile(k);
            const std::size_t i = (y0 + y) * width_ + x0 + x;
            if (x0 + x < width_ && y0 + y < height && g_.covered(i) && wanted(i)) visit(k, i);
          }
        };
        each([&](std::size_t k, std::size_t i) { from[k] = point(i), to[k] = lamp_points(lamp, i); });
        for (int s = first; s < first + count; ++s)
          each([&](std::size_t k, std::size_t i) {
            const auto [u_triangle, u] = to[k].at(s);
            lamp_rays.aim(lamp, from[k], u_triangle, u, sight_[i], brought_.empty() ? nullptr : &brought_[i]);
          });
        lamp_rays.send();
      }
    });
  }

  /// Pixel k of a tile in order of the strata, which those 4 apart share.
  static std::pair<std::size_t, std::size_t> in_tile(std::size_t k) {
    constexpr std::size_t kBlocks = kTile / kBlock;  // each way
    const std::size_t stratum = k / (kBlocks * kBlocks), block = k % (kBlocks * kBlocks);
    return {block % kBlocks * kBlock + stratum % kBlock, block / kBlocks * kBlock + stratum / kBlock};
  }

  LampPoints lamp_points(std::size_t lamp, std::size_t i) const {
    RandomStream random(seed_, Stage::direct_light, i);
    random.start_bounce(static_cast<std::uint32_t>(2 + lamp) & 0xffffu);
    return {Stratum(i % width_, i / width_), lamps_.lights.by_u_alone(lamp), random};
  }

  /// What the pixels within reach found, whatever their surface.
  void look_about() {
    const std::size_t height = pixels_ / width_;
    std::vector<std::uint8_t> row(pixels_);
    const auto gather = [&](const std::vector<std::uint8_t>& from, std::vector<std::uint8_t>& to,
                            std::size_t step, const auto& place, std::size_t places) {
      parallel_for(pixels_, kChunk, [&](std::size_t i) {
        const std::size_t at = place(i), before = std::min<std::size_t>(at, kReach),
                          after = std::min<std::size_t>(places - 1 - at, kReach);
        std::uint8_t all = kNothing;
        for (std::size_t j = i - before * step; j <= i + after * step; j += step) all |= from[j];
        to[i] = all;
      });
    };
    for (std::size_t i = 0; i < pixels_; ++i)
      if (!g_.covered(i)) found_[i] = kNothing;
    gather(
        found_, row, 1, [&](std::size_t i) { return i % width_; }, width_);
    gather(
        row, about_, width_, [&](std::size_t i) { return i / width_; }, height);
  }

  /// The light of a lamp with a closed form at a pixel, from the results of the pixel and its neighbours.
  void add_share(std::size_t lamp, std::size_t i) {
    const LampForm& form = lamps_.form[lamp];
    if (!(about_[i] & kSeen)) return;
    if (about_[i] == kSeen) {
      shared_[i].illuminance += form.luminance() * unoccluded(form, i);
      return;
    }
    const std::array<PooledVisibility, kReaches> found = found_about(i);
    const std::size_t reach = this->reach(lamp);
    if (reach == kOwn && rays_of(i) < kTelling)
      add_own_share(form, i, found);
    else
      add_drawn_share(form, i, found, reach);
  }

  /// By the pixel's own rays. A few of them, of one pass, see the lamp's parts in proportions that are not
  /// right, so that seen / sent would be biased: the light that they saw is divided by the light to be seen,
  /// with the share about the pixel as control variate, so that there is no noise where all rays see the lamp
  /// or none does.
  void add_own_share(const LampForm& form, std::size_t i,
                     const std::array<PooledVisibility, kReaches>& found) {
    const float whole = unoccluded(form, i);
    if (!(found[kAll].sent > 0) || !(whole > 0)) return;
    const float about = found[kAll].share();
    shared_[i].add_share(form.luminance() * whole, own_share(found, about, whole),
                         about * (1 - about) / found[kOwn].rays);
  }

  static float own_share(const std::array<PooledVisibility, kReaches>& found, float about, float whole) {
    return about + (found[kOwn].seen - about * found[kOwn].sent) / (found[kOwn].rays * whole);
  }

  /// By the share about the pixel, drawn towards nearer shares where these differ by more than noise. Of a
  /// lamp that nearly all rays miss, or nearly none, as where it shines through bars, chance makes one pixel
  /// twice as bright as the next.
  void add_drawn_share(const LampForm& form, std::size_t i,
                       const std::array<PooledVisibility, kReaches>& found, std::size_t reach) {
    const float whole = unoccluded(form, i);
    if (!(found[kAll].sent > 0) || !(whole > 0)) return;
    const float about = found[kAll].share();
    const auto telling = [&](std::size_t r) {
      return telling_of(found[r].rays, found[kAll].seen, found[kAll].sent);
    };
    const auto noise = [&](std::size_t r) {
      return left_by_strata(telling(r)) * static_cast<double>(about * (1 - about) / found[r].independent());
    };
    if (reach == kOwn && noise(kOwn) < kSure * kSure * static_cast<double>(about * about))
      return add_own_share(form, i, found);
    const bool few = !(found[kNext].sent > 0) || telling(kNext) < kEnoughTelling / 2;
    const std::size_t widest = reach == kAll || few ? kAll : kNext;
    double share = static_cast<double>(found[widest].share()),
           variance = static_cast<double>(found[widest].variance_of(about));
    for (std::size_t r = widest; r-- > kOwn;) {
      if (!(found[r].sent > 0) || found[r].rays < kTold) continue;
      const double nearer =
          static_cast<double>(r == kOwn ? own_share(found, about, whole) : found[r].share());
      const double k = drawn((nearer - share) * (nearer - share), noise(r), telling(r));
      share += k * (nearer - share);
      variance = (1 - k) * (1 - k) * variance + k * k * noise(r);
    }
    shared_[i].add_share(form.luminance() * whole, static_cast<float>(share), static_cast<float>(variance));
  }

  /// Of the variance of a share that independent rays would have: all, where few arrive.
  double left_by_strata(double telling) const { return telling < kEnoughTelling ? 1 : share_gain_; }

  /// Of the variance of pixels' own shares, over the variance by independent rays; at most 1: as usual,
  /// whatever the edges of shadows are. Pixels a block apart send their rays to the same part of the lamp;
  /// three of them in a row tell noise from light that changes evenly.
  double gain_of_shares() const {
    const std::size_t height = pixels_ / width_;
    std::vector<float> ratio = parallel_reduce(
        height, 1, std::vector<float>(),
        [&](std::size_t y, std::size_t) {
          std::vector<float> row;
          for (std::size_t x = 0; x < width_; ++x) {
            const std::size_t i = y * width_ + x;
            if (x + 2 * kBlock < width_) add_ratio(i, kBlock, row);
            if (y + 2 * kBlock < height) add_ratio(i, kBlock * width_, row);
          }
          return row;
        },
        [](std::vector<float>& all, const std::vector<float>& row) {
          all.insert(all.end(), row.begin(), row.end());
        });
    return usual_gain(ratio);
  }

  /// Of the pixels i, i + step and i + 2 step, if they show one surface.
  void add_ratio(std::size_t i, std::size_t step, std::vector<float>& ratio) const {
    const std::size_t j = i + step, k = j + step;
    for (const std::size_t p : {i, j, k})
      if (!g_.covered(p) || about_[p] != kMixed || !(sight_[p].sent > 0)) return;
    const SeenSurface own = SeenSurface::of(g_, j);
    if (!same_surface(own, g_, i) || !same_surface(own, g_, k)) return;
    const LampVisibility &a = sight_[i], &b = sight_[j], &c = sight_[k];
    const float seen = a.seen + b.seen + c.seen, sent = a.sent + b.sent + c.sent;
    const auto fewest = static_cast<float>(std::min({a.rays, b.rays, c.rays}));
    if (telling_of(fewest, seen, sent) < kEnoughTelling) return;
    const float differ = a.seen / a.sent - 2 * b.seen / b.sent + c.seen / c.sent, share = seen / sent;
    const auto each = [](const LampVisibility& v) { return 1 / static_cast<float>(v.rays); };
    ratio.push_back(differ * differ / (share * (1 - share) * (each(a) + 4 * each(b) + each(c))));
  }
  /// By the median of squares over their independent variances.
  static double usual_gain(std::vector<float>& ratio) {
    if (ratio.empty()) return 1;
    const auto middle = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
    std::nth_element(ratio.begin(), middle, ratio.end());
    return std::min(1.0, static_cast<double>(*middle) / kMedianOfSquare);
  }

  /// By how much a mean is drawn towards another, 0 to 1, whose square of difference and variance are these
  /// (James and Stein 1961): so that noise is believed nowhere. `telling`: telling_of() the other.
  static double drawn(double difference2, double variance, double telling) {
    const double doubt2 = (1 + kDoubtFew / telling) * kDoubtMeans * variance;
    return difference2 > doubt2 ? 1 - doubt2 / difference2 : 0;
  }

  /// The light of a lamp without one, at all pixels.
  void add_means(std::size_t reach) {
    std::vector<SharedLight> mean(pixels_);
    for_each([&](std::size_t i) { mean[i].add_mean(found_about(i)[reach]); });
    const Gain gain = gain_of_strata(mean);
    for_each([&](std::size_t i) {
      mean[i].variance *= gain.overall;
      if (reach > kOwn && rays_of(i) >= kTelling) draw_nearer(found_about(i), reach, gain.usual, mean[i]);
      shared_[i].illuminance += mean[i].illuminance, shared_[i].variance += mean[i].variance;
    });
  }

  /// Draws the mean within reach towards the means of nearer pixels where these differ by more than noise: at
  /// the edge of a shadow.
  static void draw_nearer(const std::array<PooledVisibility, kReaches>& found, std::size_t reach, double gain,
                          SharedLight& mean) {
    const PooledVisibility& all = found[reach];
    const DVec3 whole(mean.illuminance);
    const DVec3 spread = glm::max(all.light2 / static_cast<double>(all.rays) - whole * whole, DVec3(0));
    for (std::size_t r = reach; r-- > kOwn;) {
      const DVec3 differs = DVec3(found[r].light / found[r].rays - mean.illuminance);
      const double telling = telling_of(found[r].rays, all.seen, all.sent);
      const DVec3 noise =
          spread * ((telling < kEnoughTelling ? 1 : gain) / static_cast<double>(found[r].independent()));
      const double k = drawn(glm::dot(differs, differs), glm::dot(noise, DVec3(1)), telling);
      mean.illuminance += Rgb(k * differs);
      mean.variance = (1 - k) * (1 - k) * mean.variance + k * k * noise;
    }
  }

  /// Of rays, those that arrive or those that do not, whichever are fewer, where `seen` of `sent` arrives.
  static double telling_of(float rays, float seen, float sent) {
    return sent > 0 ? static_cast<double>(rays * std::min(seen, sent - seen) / sent) : 0;
  }

  struct Gain {
    double overall = 1;  ///< of all variance together
    /// Of the pixel in the middle, whatever the edges of shadows are, where pixels a block apart differ.
    double usual = 1;
  };
  /// Variance of the light of a pixel's rays, over the variance by independent rays; at most 1. Pixels a
  /// block apart send their rays to the same part of the lamp, so half the mean square of their differences
  /// is the first; the other is the mean square of a ray's light less the square of the mean about the pixel,
  /// which holds all parts.
  Gain gain_of_strata(const std::vector<SharedLight>& mean) const {
    struct Variances {
      double in_strata = 0, independent = 0;
      std::vector<float> ratio;
    };
    const std::size_t height = pixels_ / width_;
    Variances sum = parallel_reduce(
        height, 1, Variances(),
        [&](std::size_t y, std::size_t) {
          Variances row;
          for (std::size_t x = 0; x < width_; ++x) {
            const std::size_t i = y * width_ + x;
            if (!g_.covered(i)) continue;
            const SeenSurface own = SeenSurface::of(g_, i);
            const auto pair = [&](std::size_t j) {
              if (!same_surface(own, g_, j)) return;
              const DVec3 differ = own_mean(i) - own_mean(j);
              const double in_strata = glm::dot(differ, differ) / 2,
                           independent = (spread_of_mean(i, mean[i]) + spread_of_mean(j, mean[j])) / 2;
              row.in_strata += in_strata, row.independent += independent;
              const auto telling = [&](std::size_t k) {
                return telling_of(static_cast<float>(sight_[k].rays), sight_[k].seen, sight_[k].sent);
              };
              if (independent > 0 && std::min(telling(i), telling(j)) >= kEnoughTelling)
                row.ratio.push_back(static_cast<float>(in_strata / independent));
            };
            if (x + kBlock < width_) pair(i + kBlock);
            if (y + kBlock < height) pair(i + kBlock * width_);
          }
          return row;
        },
        [](Variances& all, const Variances& row) {
          all.in_strata += row.in_strata, all.independent += row.independent;
          all.ratio.insert(all.ratio.end(), row.ratio.begin(), row.ratio.end());
        });
    Gain gain;
    if (sum.in_strata < sum.independent) gain.overall = sum.in_strata / sum.independent;
    gain.usual = usual_gain(sum.ratio);
    return gain;
  }
  DVec3 own_mean(std::size_t i) const {
    return DVec3(brought_[i].light) / static_cast<double>(sight_[i].rays);
  }
  /// Variance of a pixel's mean if its rays were independent, lx^2, all channels.
  double spread_of_mean(std::size_t i, const SharedLight& mean) const {
    const auto n = static_cast<double>(sight_[i].rays);
    const DVec3 light(mean.illuminance), spread = brought_[i].light2 / n - light * light;
    return (spread.x + spread.y + spread.z) / n;
  }

  /// What a pixel found, with those next to it that show its surface, and with all of these within reach.
  std::array<PooledVisibility, kReaches> found_about(std::size_t i) const {
    std::array<PooledVisibility, kReaches> found;
    const SeenSurface own = SeenSurface::of(g_, i);
    const int x = static_cast<int>(i % width_), y = static_cast<int>(i / width_);
    const auto add = [&](Reach reach, std::size_t j, float weight) {
      found[reach].add(sight_[j], weight);
      if (!brought_.empty()) found[reach].add(brought_[j], weight);
    };
    add(kOwn, i, 1);
    for (int v = std::max(0, y - kReach); v <= std::min(g_.height - 1, y + kReach); ++v) {
      for (int u = std::max(0, x - kReach); u <= std::min(g_.width - 1, x + kReach); ++u) {
        const std::size_t j = static_cast<std::size_t>(v) * width_ + static_cast<std::size_t>(u);
        if (g_.hit[j].triangle != g_.hit[i].triangle && !same_surface(own, g_, j)) continue;
        add(kAll, j, kShare[std::abs(u - x)] * kShare[std::abs(v - y)]);
        if (std::abs(u - x) <= 1 && std::abs(v - y) <= 1) add(kNext, j, 1);
      }
    }
    return found;
  }

  float unoccluded(const LampForm& form, std::size_t i) const {
    return form.projected_solid_angle(Vec3(g_.position[i]), receiver_[i].normal);
  }

  AimedLamps lamps_;
  const GBuffer& g_;
  RayShare share_;
  std::size_t width_, pixels_;
  std::uint64_t seed_;
  std::vector<Receiver> receiver_;
  std::vector<LampVisibility> sight_;        // per pixel, of one lamp
  std::vector<Brought> brought_;             // empty for a lamp with a closed form
  std::vector<std::uint8_t> found_, about_;  // states of a pixel, and of a pixel with its neighbours
  std::vector<SharedLight> shared_;
  double share_gain_ = 1;  // gain_of_shares()
};

}  // namespace

std::vector<SharedLight> interleaved_light(const RayScene& rays, const Luminaires& lights,
                                           const GBuffer& gbuffer, const PixelRays& pixel_rays,
                                           const Vec2& subpixel, const RayShare& share, std::uint64_t seed) {
  return Interleaved(rays, lights, gbuffer, share, seed).light(pixel_rays, subpixel);
}

}  // namespace phos::inline splat
