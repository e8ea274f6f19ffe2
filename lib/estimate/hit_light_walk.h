// Light along a walk over gloss, mirrors and glass. Private to HitLight.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/random.h"
#include "estimate/hit_light_impl.h"
#include "scene/material/passage.h"

namespace phos::inline estimate {

/// A walk over glossy surfaces, mirrors and glass, that at each reads lamps and cache for its Lambert part.
/// What the start's straight line sees of lamps is left out. Every other light is counted once: unbiased but
/// for the cache.
struct HitLight::Impl::Walk {
  const Impl& light;
  Worker& worker;
  const std::uint64_t item;
  const std::uint32_t followed;
  RandomStream random;
  Way way;
  Vec3 wo;
  Rgb throughput;
  std::int64_t left;
  Rgb sum{0};
  /// The last event: where the way began, and how it was chosen. None yet: the record's own.
  std::optional<SurfacePoint> from{};
  Step last{};
  /// Flat mirrors since the record, or a place that was followed: lamps have images in them there.
  std::vector<std::pair<std::uint32_t, bool>> mirrors{};
  bool by_images;
  /// So far by mirrors and glass alone: light of lamps that comes so is caustic light.
  bool mirrors_alone = true;
  const bool count_all;

  Walk(const Impl& impl, const Ray& start, const Rgb& part, const RayName& ray, std::uint32_t places,
       Worker& own_worker)
      : light(impl),
        worker(own_worker),
        item(ray.key()),
        followed(places),
        random(impl.seed, Stage::specular, item),
        way(impl.rays, start),
        wo(-start.direction),
        throughput(part),
        left(impl.bounces),
        by_images(!impl.images.empty() && (places == 0 || impl.source.lacks_images)),
        count_all(impl.counts_lamps_in_mirrors(places)) {}

  /// Does light straight from a lamp count, where the walk finds one?
  bool counts_lamps() const { return from && (count_all || !mirrors_alone); }
  /// Have lamps an image in the mirrors of the walk, so that their light there is told already?
  bool told_by_image() const;
  void add_lambert(const SurfacePoint& at, const Vec3& towards, const Rgb& f, std::uint32_t number);
  Step shade(const SurfacePoint& point, std::uint32_t reflection);
  bool survives(std::uint32_t reflection);
  void turn(const SurfacePoint& point, const Step& step);
  void add_background();
  void add_emitted(const SurfacePoint& next);
  Rgb run(Landing* landing);
};

}  // namespace phos::inline estimate
