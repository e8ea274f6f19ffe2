#include "splat/interleaved.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "scene/lamp_form.h"
#include "splat/same_surface.h"

namespace phos {
namespace {

constexpr int kBlock = 4;               // pixels each way that share a set of rays
constexpr int kReach = kBlock / 2;      // of a pixel's neighbours
constexpr std::size_t kTile = 16;       // pixels each way whose rays are sent together
constexpr std::size_t kMostRays = 256;  // of a lamp; further ones have the random numbers of the next lamp
constexpr std::size_t kChunk = 1024;
// Of the row or column at this distance: the outer two together count like one, so that the mean about a
// pixel holds each part of the set once.
constexpr float kShare[kReach + 1] = {1, 1, 0.5f};
/// Standard errors at which what is nearest is believed against what is all about: a shadow's edge.
constexpr float kDoubt = 2;

/// What a shadow ray leaves from.
struct Receiver {
  Vec3 normal{0}, geometric_normal{0};
  float error_m = 0;
};

/// Bits: some ray of the pixel arrived, some did not.
enum : std::uint8_t { kNothing = 0, kSeen = 1, kBlocked = 2, kMixed = 3 };

/// Strata of a lamp, 4 x 4, of ray `s` of the pixel at (x, y) of a picture: the pixels of any 4 x 4 meet each
/// stratum once with each of their rays, those of any 2 x 2 a quarter each, and so do the first 4 rays of a
/// pixel.
struct Stratum {
  Stratum(std::size_t x, std::size_t y, int s)
      : column(corner(x, x >> 1) ^ corner(bit(s, 0), bit(s, 2))),
        row(corner(y, y >> 1) ^ corner(bit(s, 0) ^ bit(s, 1), bit(s, 2) ^ bit(s, 3))) {}
  static std::size_t bit(int s, int i) { return static_cast<std::size_t>(s >> i & 1); }
  /// Of 0 .. 3: the half, and which part of it.
  static unsigned corner(std::size_t half, std::size_t part) {
    return static_cast<unsigned>((half & 1) << 1 | (part & 1));
  }
  unsigned column, row;
};

class Interleaved {
 public:
  Interleaved(const RayScene& rays, const Luminaires& lights, const GBuffer& gbuffer, std::uint64_t seed)
      : rays_(rays),
        lights_(lights),
        g_(gbuffer),
        width_(static_cast<std::size_t>(gbuffer.width)),
        pixels_(gbuffer.hit.size()),
        seed_(seed) {}

  std::vector<SharedLight> light(const PixelRays& pixel_rays, const Vec2& subpixel, int lamp_rays, int pass) {
    find_receivers(pixel_rays, subpixel);
    shared_.assign(pixels_, SharedLight());
    sight_.resize(pixels_), found_.resize(pixels_), about_.resize(pixels_);
    for (std::size_t lamp = 0; lamp < lights_.size(); ++lamp) {
      std::fill(sight_.begin(), sight_.end(), Sight());
      if (!lights_[lamp].extended()) {
        send(lamp, 0, 1, [](std::size_t) { return true; });
        for_each([&](std::size_t i) { shared_[i].illuminance += sight_[i].light; });
        continue;
      }
      const LampForm form(rays_.scene(), lights_[lamp]);
      const int first = pass * lamp_rays;
      send(lamp, first, 1, [](std::size_t) { return true; });
      for_each([&](std::size_t i) { found_[i] = state(sight_[i]); });
      look_about();
      if (lamp_rays > 1)
        send(lamp, first + 1, lamp_rays - 1,
             [&](std::size_t i) { return about_[i] == kMixed || !form.closed(); });
      for_each([&](std::size_t i) { add(form, i); });
    }
    return std::move(shared_);
  }

 private:
  static std::uint8_t state(const Sight& s) {
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
      const SurfacePoint point = rays_.surface(ray, g_.hit[i]);
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
  /// Tile by tile, those of one stratum of the lamp together: such rays run side by side.
  template <class Wanted>
  void send(std::size_t lamp, int first, int count, const Wanted& wanted) {
    const std::size_t height = pixels_ / width_;
    parallel_for((height + kTile - 1) / kTile, 1, [&](std::size_t row) {
      LampRays lamp_rays(rays_, lights_);
      std::vector<SurfacePoint> points(kTile * kTile);
      for (std::size_t x0 = 0, y0 = row * kTile; x0 < width_; x0 += kTile) {
        const auto each = [&](const auto& visit) {
          for (std::size_t k = 0; k < kTile * kTile; ++k) {
            const auto [x, y] = in_tile(k);
            const std::size_t i = (y0 + y) * width_ + x0 + x;
            if (x0 + x < width_ && y0 + y < height && g_.covered(i) && wanted(i)) visit(k, i);
          }
        };
        each([&](std::size_t k, std::size_t i) { points[k] = point(i); });
        for (int s = first; s < first + count; ++s)
          each([&](std::size_t k, std::size_t i) { aim(lamp, i, points[k], s, lamp_rays); });
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

  void aim(std::size_t lamp, std::size_t i, const SurfacePoint& p, int s, LampRays& lamp_rays) {
    RandomStream random(seed_, Stage::direct_light, i);
    random.start_bounce(static_cast<std::uint32_t>(2 + lamp * kMostRays + static_cast<std::size_t>(s)) &
                        0xffffu);
    const Stratum stratum(i % width_, i / width_, s);
    const Vec2 jitter = random.uniform2();
    Vec2 u = (Vec2(stratum.column, stratum.row) + jitter) / static_cast<float>(kBlock);
    float u_triangle = 0;
    if (!lights_.by_u_alone(lamp)) {
      u_triangle = (static_cast<float>(stratum.row * kBlock + stratum.column) + jitter.x) /
                   static_cast<float>(kBlock * kBlock);
      u = Vec2(random.uniform(), jitter.y);
    }
    lamp_rays.aim(lamp, p, u_triangle, u, sight_[i]);
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

  /// The lamp's light at a pixel, from what it and its neighbours found.
  void add(const LampForm& form, std::size_t i) {
    if (form.closed() && !(about_[i] & kSeen)) return;
    if (form.closed() && about_[i] == kSeen) {
      shared_[i].illuminance += form.luminance() * unoccluded(form, i);
      return;
    }
    const auto [near, all] = found_about(i);
    if (!form.closed()) return shared_[i].add_mean(all);
    if (!(all.seen > 0)) return;
    const Rgb whole = form.luminance() * unoccluded(form, i);
    const float share = all.share(), variance_near = near.variance_of(share);
    const float change = near.sent > 0 ? near.share() - share : 0.f;
    if (change * change > kDoubt * kDoubt * variance_near)
      shared_[i].add_share(whole, near.share(), variance_near);
    else
      shared_[i].add_share(whole, share, all.variance_of(share));
  }

  /// What the pixels about one found that show its surface: within one pixel, and within reach.
  std::pair<Finding, Finding> found_about(std::size_t i) const {
    Finding near, all;
    const SeenSurface own = SeenSurface::of(g_, i);
    const int x = static_cast<int>(i % width_), y = static_cast<int>(i / width_);
    for (int v = std::max(0, y - kReach); v <= std::min(g_.height - 1, y + kReach); ++v) {
      for (int u = std::max(0, x - kReach); u <= std::min(g_.width - 1, x + kReach); ++u) {
        const std::size_t j = static_cast<std::size_t>(v) * width_ + static_cast<std::size_t>(u);
        if (g_.hit[j].triangle != g_.hit[i].triangle && !same_surface(own, g_, j)) continue;
        all.add(sight_[j], kShare[std::abs(u - x)] * kShare[std::abs(v - y)]);
        if (std::abs(u - x) <= 1 && std::abs(v - y) <= 1) near.add(sight_[j], 1);
      }
    }
    return {near, all};
  }

  float unoccluded(const LampForm& form, std::size_t i) const {
    return form.projected_solid_angle(Vec3(g_.position[i]), receiver_[i].normal);
  }

  const RayScene& rays_;
  const Luminaires& lights_;
  const GBuffer& g_;
  std::size_t width_, pixels_;
  std::uint64_t seed_;
  std::vector<Receiver> receiver_;
  std::vector<Sight> sight_;                 // per pixel, of one lamp
  std::vector<std::uint8_t> found_, about_;  // states of a pixel, and of it with its neighbours
  std::vector<SharedLight> shared_;
};

}  // namespace

std::vector<SharedLight> interleaved_light(const RayScene& rays, const Luminaires& lights,
                                           const GBuffer& gbuffer, const PixelRays& pixel_rays,
                                           const Vec2& subpixel, int lamp_rays, int pass,
                                           std::uint64_t seed) {
  return Interleaved(rays, lights, gbuffer, seed).light(pixel_rays, subpixel, lamp_rays, pass);
}

}  // namespace phos
