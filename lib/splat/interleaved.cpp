#include "splat/interleaved.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "scene/lamp_form.h"
#include "splat/same_surface.h"

namespace phos {
namespace {

constexpr int kBlock = 4;           // pixels each way that share a set of rays
constexpr int kReach = kBlock / 2;  // of a pixel's neighbours
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

/// What a pixel's own rays to one lamp found.
struct Sight {
  float seen = 0,
        sent = 0;   ///< sums of projected solid angles over density, of the rays that arrive and of all
  Rgb light{0};     ///< lx: sum of what rays brought (lamps without closed form)
  DVec3 light2{0};  ///< and of its squares
  std::uint16_t rays = 0;
};

/// The same of several pixels, weighted.
struct Finding {
  float seen = 0, sent = 0, rays = 0, rays2 = 0;
  Rgb light{0};
  DVec3 light2{0};
  void add(const Sight& s, float weight) {
    seen += weight * s.seen, sent += weight * s.sent, light += weight * s.light;
    light2 += static_cast<double>(weight) * s.light2;
    rays += weight * static_cast<float>(s.rays), rays2 += weight * weight * static_cast<float>(s.rays);
  }
  float share() const { return seen / sent; }
  float independent() const { return rays * rays / rays2; }
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
      if (!lights_[lamp].extended()) {
        for_each([&](std::size_t i) { shared_[i].illuminance += from_point(lamp, i); });
        continue;
      }
      const LampForm form(rays_.scene(), lights_[lamp]);
      const int first = pass * lamp_rays;
      for_each([&](std::size_t i) {
        sight_[i] = Sight();
        send(lamp, i, first, 1, true);
        found_[i] = state(sight_[i]);
      });
      look_about();
      if (lamp_rays > 1) {
        for_each([&](std::size_t i) {
          if (about_[i] == kMixed || !form.closed()) send(lamp, i, first + 1, lamp_rays - 1, false);
        });
      }
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

  bool visible(const SurfacePoint& p, const Illumination& light) const {
    return glm::dot(p.geometric_normal, light.direction) > 0 && in_sight(rays_, p, light);
  }

  Rgb from_point(std::size_t lamp, std::size_t i) const {
    const SurfacePoint p = point(i);
    Illumination light;
    if (!lights_.illuminate(lamp, p.position, 0, Vec2(0), light)) return Rgb(0);
    const float cosine = glm::dot(p.normal, light.direction);
    return cosine > 0 && visible(p, light) ? light.value * cosine : Rgb(0);
  }

  /// Rays first .. first + count - 1 of the pixel's part of its block's set.
  void send(std::size_t lamp, std::size_t i, int first, int count, bool first_of_all) {
    const SurfacePoint p = point(i);
    const std::size_t x = i % width_, y = i / width_;
    RandomStream random(seed_, Stage::direct_light, i);
    random.start_bounce(static_cast<std::uint32_t>((lamp * 2 + (first_of_all ? 0 : 1)) & 0xffff));
    Sight& sight = sight_[i];
    sight.rays = static_cast<std::uint16_t>(sight.rays + count);
    const bool by_u_alone = lights_.by_u_alone(lamp);
    for (int s = first; s < first + count; ++s) {
      const Stratum stratum(x, y, s);
      const Vec2 jitter = random.uniform2();
      Vec2 u = (Vec2(stratum.column, stratum.row) + jitter) / static_cast<float>(kBlock);
      float u_triangle = 0;
      if (!by_u_alone) {
        u_triangle = (static_cast<float>(stratum.row * kBlock + stratum.column) + jitter.x) /
                     static_cast<float>(kBlock * kBlock);
        u = Vec2(random.uniform(), jitter.y);
      }
      Illumination light;
      if (!lights_.illuminate(lamp, p.position, std::min(u_triangle, 0x1.fffffep-1f),
                              glm::min(u, Vec2(0x1.fffffep-1f)), light))
        continue;
      const float weight = glm::dot(p.normal, light.direction) / light.density;
      if (!(weight > 0) || !std::isfinite(weight)) continue;
      sight.sent += weight;
      if (!visible(p, light)) continue;
      sight.seen += weight;
      const Rgb brought = light.value * weight;
      sight.light += brought, sight.light2 += DVec3(brought) * DVec3(brought);
    }
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
    if (!form.closed()) {
      const Rgb mean = all.light / all.rays;
      shared_[i].illuminance += mean;
      if (all.independent() > 1)
        shared_[i].variance +=
            glm::max(all.light2 / static_cast<double>(all.rays) - DVec3(mean) * DVec3(mean), DVec3(0)) /
            static_cast<double>(all.independent() - 1);
      return;
    }
    if (!(all.seen > 0)) return;
    const Rgb whole = form.luminance() * unoccluded(form, i);
    float share = all.share(), variance = share * (1 - share) / std::max(all.independent() - 1, 1.f);
    const float variance_near = share * (1 - share) / std::max(near.independent() - 1, 1.f);
    const float change = near.sent > 0 ? near.share() - share : 0.f;
    if (change * change > kDoubt * kDoubt * variance_near) {
      share = near.share();
      variance = variance_near;
    }
    shared_[i].illuminance += whole * share;
    shared_[i].variance += DVec3(whole) * DVec3(whole) * static_cast<double>(variance);
  }

  /// What the pixels about one found that show its surface: within one pixel, and within reach.
  std::pair<Finding, Finding> found_about(std::size_t i) const {
    Finding near, all;
    const SeenSurface own = SeenSurface::of(g_, i);
    const int x = static_cast<int>(i % width_), y = static_cast<int>(i / width_);
    for (int v = std::max(0, y - kReach); v <= std::min(g_.height - 1, y + kReach); ++v) {
      for (int u = std::max(0, x - kReach); u <= std::min(g_.width - 1, x + kReach); ++u) {
        const std::size_t j = static_cast<std::size_t>(v) * width_ + static_cast<std::size_t>(u);
        if (j != i && !same_surface(own, g_, j)) continue;
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
