#include "splat/cpu/gloss_splatter.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "core/processor.h"
#include "radiance/tree.h"
#include "splat/cpu/gloss_kernel.h"
#include "splat/cpu/splatter.h"
#include "splat/gl/gloss_rows.h"
#include "splat/tiles.h"

namespace phos::inline splat {
namespace {

constexpr int kTileSide = 16;
constexpr std::size_t kLanes = kGlossLanes;
/// Frames whose axes differ by no more are one: a turn by rounding errors.
constexpr float kSameFrame = 1e-6f;

bool same(const Frame& a, const Frame& b) {
  const auto near = [](const Vec3& u, const Vec3& v) { return max_component(glm::abs(u - v)) <= kSameFrame; };
  return near(a.x, b.x) && near(a.z, b.z);
}

/// `footprint`: its own, or null.
GlossSplat pack(const RadianceRecord& r, const AdaptiveFootprint* footprint) {
  static_assert(GlossSplat::kAxes == AdaptiveFootprint::kAxes);
  GlossSplat s{};
  if (footprint) {
    std::copy(footprint->inverse_m().begin(), footprint->inverse_m().end(), s.inverse);
    s.inverse_shortest = std::min(1 / footprint->shortest_m(), std::numeric_limits<float>::max());
    s.per_radius = footprint->longest_m() / r.radius_m;
  }
  for (int i = 0; i < 3; ++i)
    s.position[i] = r.position[i], s.normal[i] = r.frame.z[i], s.x[i] = r.frame.x[i], s.y[i] = r.frame.y[i];
  // A tiny radius must not become infinite: 0 * infinity at the record itself is not a number.
  s.inverse_radius = std::min(1 / r.radius_m, std::numeric_limits<float>::max());
  s.front_limit_m = -kFrontTolerance * r.radius_m, s.over_limit_m = over_limit_m(r.distance_m, r.radius_m);
  s.weight = r.weight, s.shared = r.shared;
  s.steepness_per_m = steepness_per_m(r);
  s.light = r.light.data(), s.stderr_light = r.stderr_light.data();
  s.gradient_x = r.gradient_x.data(), s.gradient_y = r.gradient_y.data();
  const auto set = [](float(&to)[3], const std::vector<float>& light) {
    if (light.empty()) return;
    const Rgb e = irradiance_of(light);
    for (int c = 0; c < 3; ++c) to[c] = e[c];
  };
  set(s.irradiance, r.light), set(s.irradiance_x, r.gradient_x), set(s.irradiance_y, r.gradient_y);
  return s;
}

/// The records of one order, ready to be drawn.
struct Class {
  int order;
  std::span<const IrradianceRecord> records;  // their places
  std::vector<Frame> frame;
  std::vector<GlossSplat> splat;
  std::vector<PixelRect> bounds;
};

class GlossSplatter {
 public:
  GlossSplatter(const GlossCache& cache, double accuracy, const RayScene& rays, const GBuffer& gbuffer,
                const Camera& camera, const Vec2& subpixel)
      : cache_(cache),
        accuracy_(accuracy),
        rays_(rays),
        g_(gbuffer),
        camera_(camera),
        pixel_rays_(camera, gbuffer.width, gbuffer.height),
        subpixel_(subpixel) {
    buffer_.light.assign(g_.position.size(), Vec4(0)), buffer_.error.assign(g_.position.size(), Vec4(0));
  }

  /// Leaves pixels whose lobe is in `rows` to others; `left` names the pixels, their rows, and the data for
  /// errors.
  void leave(const GlossRows& rows, GlossLeft& left) {
    left.place.assign(g_.position.size(), Vec4(-1, 0, 0, 0)), left.spread.assign(g_.position.size(), {});
    rows_ = &rows, left_ = &left;
  }

  GlossBuffer draw() {
    for (const int order : cache_.tables().orders()) add_class(order);
    if (classes_.empty()) return std::move(buffer_);
    float most = 0;
    for (const Class& c : classes_) most = std::max(most, splat_unit_lx(c.records));
    buffer_.unit = most;
    const TileGrid grid(g_, kTileSide);
    join(static_cast<std::size_t>(grid.rows()), 1, [&](std::size_t row, Worker& worker) {
      for (const Class& c : classes_) draw_row(grid, static_cast<int>(row), c, worker);
    });
    return std::move(buffer_);
  }

  GlossBuffer look_up() {
    join(g_.position.size(), 1024, [&](std::size_t pixel, Worker& worker) {
      if (order_at(pixel) > 0) look_up(pixel, worker);
    });
    return std::move(buffer_);
  }

 private:
  struct Worker {
    GlossCache::Worker lookup;
    GlossLobe lobe;
    GlossGroup group;
    std::vector<GlossLane> lobes, band_error;
    std::array<std::size_t, kLanes> pixel;
    std::array<Frame, kLanes> frame;
    std::array<Rgb, kLanes> least;
    std::array<bool, kLanes> lit, turned;
    std::vector<std::uint32_t> valid;
    std::vector<GlossLane> weight;  // of those
    std::uint64_t pairs = 0, turned_pixels = 0;
  };

  /// body(i, worker) for i < n; counts are joined.
  template <class Body>
  void join(std::size_t n, std::size_t chunk, const Body& body) {
    using Counts = std::array<std::uint64_t, 2>;
    const Counts counts = parallel_reduce(
        n, chunk, Counts{},
        [&](std::size_t begin, std::size_t end) {
          Worker worker;
          for (std::size_t i = begin; i < end; ++i) body(i, worker);
          return Counts{worker.pairs, worker.turned_pixels};
        },
        [](Counts& total, const Counts& part) { total[0] += part[0], total[1] += part[1]; });
    buffer_.pairs = counts[0], buffer_.turned = counts[1];
  }

  void add_class(int order) {
    const RadianceTree* tree = cache_.tree(order);
    if (!tree || tree->size() == 0) return;
    Class c{order, tree->irradiance().records(), {}, {}, {}};
    c.bounds = record_bounds(c.records, accuracy_, camera_, g_.width, g_.height);
    c.frame.resize(tree->size()), c.splat.resize(tree->size());
    parallel_for(tree->size(), 64, [&](std::size_t i) {
      if (!c.bounds[i].empty())
        c.frame[i] = (*tree)[i].frame, c.splat[i] = pack((*tree)[i], c.records[i].footprint.get());
    });
    classes_.push_back(std::move(c));
  }

  /// Bands of the records that the material seen wants; 0: none.
  int order_at(std::size_t pixel) const {
    return g_.covered(pixel) ? cache_.tables().order(static_cast<std::uint32_t>(g_.albedo[pixel].w)) : 0;
  }

  void draw_row(const TileGrid& grid, int row, const Class& c, Worker& worker) {
    const auto columns = static_cast<std::size_t>(grid.columns());
    std::vector<std::vector<std::size_t>> pixels(columns);
    for (std::size_t column = 0; column < columns; ++column)
      find_pixels(static_cast<int>(column), row, c.order, pixels[column]);
    std::vector<std::vector<std::uint32_t>> lists(columns);
    const int y0 = row * kTileSide;
    for (std::size_t i = 0; i < c.records.size(); ++i) {
      const PixelRect& rect = c.bounds[i];
      if (rect.empty() || rect.y1 <= y0 || rect.y0 >= y0 + kTileSide) continue;
      for (int column = rect.x0 / kTileSide; column * kTileSide < rect.x1; ++column) {
        const auto at = static_cast<std::size_t>(column);
        if (!pixels[at].empty() && grid.touches(c.records[i], static_cast<float>(accuracy_), column, row))
          lists[at].push_back(static_cast<std::uint32_t>(i));
      }
    }
    for (std::size_t column = 0; column < columns; ++column) {
      if (lists[column].empty()) continue;
      const std::vector<std::size_t>& all = pixels[column];
      for (std::size_t first = 0; first < all.size(); first += kLanes)
        draw_group(std::span(all).subspan(first, std::min(kLanes, all.size() - first)), c, lists[column],
                   worker);
    }
  }

  void find_pixels(int column, int row, int order, std::vector<std::size_t>& pixels) const {
    const int x0 = column * kTileSide, y0 = row * kTileSide;
    for (int y = y0; y < std::min(y0 + kTileSide, g_.height); ++y)
      for (int x = x0; x < std::min(x0 + kTileSide, g_.width); ++x) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(g_.width) + static_cast<std::size_t>(x);
        if (order_at(i) == order) pixels.push_back(i);
      }
  }

  void draw_group(std::span<const std::size_t> pixels, const Class& c, const std::vector<std::uint32_t>& list,
                  Worker& w) {
    w.group = GlossGroup{};
    w.group.per_unit = 1 / buffer_.unit;
    w.lit = {}, w.turned = {};
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const Vec4 &p = g_.position[pixels[k]], &n = g_.normal[pixels[k]];
      w.pixel[k] = pixels[k], w.frame[k] = make_frame(Vec3(n));
      w.group.px.of[k] = p.x, w.group.py.of[k] = p.y, w.group.pz.of[k] = p.z;
      w.group.nx.of[k] = n.x, w.group.ny.of[k] = n.y, w.group.nz.of[k] = n.z;
    }
    find_valid(pixels.size(), c, list, w);
    make_lobes(pixels.size(), c, w);
    if (w.group.order > 0) {
      for (std::size_t j = 0; j < w.valid.size(); ++j) kernel_.add(w.group, c.splat[w.valid[j]], w.weight[j]);
      kernel_.finish(w.group);
    }
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      if (w.turned[k]) {
        look_up(w.pixel[k], w);
        ++w.turned_pixels;
      } else if (w.lit[k]) {
        const auto rgb = [k](const GlossLane* of) { return Rgb(of[0].of[k], of[1].of[k], of[2].of[k]); };
        const Rgb least = w.least[k] * glm::max(rgb(w.group.irradiance), Rgb(0));
        const float weight = w.group.light[3].of[k], records = w.group.error[3].of[k];
        const Rgb light = rgb(w.group.light), kept = glm::max(light, least);
        const BlendSums sums{w.group.spread[0].of[k], w.group.spread[1].of[k],
                             static_cast<double>(w.group.spread[2].of[k])};
        buffer_.light[w.pixel[k]] = Vec4(kept, weight);
        buffer_.error[w.pixel[k]] =
            Vec4(gloss_error(sums, weight, kept, light, rgb(w.group.error), buffer_.unit), records);
        w.pairs += static_cast<std::uint64_t>(records);
      }
    }
  }

  /// Which records are valid at any of the pixels; whether one of them is in another frame.
  void find_valid(std::size_t pixels, const Class& c, const std::vector<std::uint32_t>& list,
                  Worker& w) const {
    w.valid.clear(), w.weight.clear();
    const auto inverse_accuracy = 1 / static_cast<float>(accuracy_);
    for (const std::uint32_t i : list) {
      GlossLane weight;
      kernel_.weights(w.group, c.splat[i], inverse_accuracy, kLeastWeight, weight);
      bool any = false;
      for (std::size_t k = 0; k < pixels; ++k) {
        if (!(weight.of[k] > 0)) continue;
        w.lit[k] = any = true;
        w.turned[k] = w.turned[k] || !same(c.frame[i], w.frame[k]);
      }
      if (any) w.valid.push_back(i), w.weight.push_back(weight);
    }
  }

  /// Lobes of the pixels that need one; others are not lit any more.
  void make_lobes(std::size_t pixels, const Class& c, Worker& w) {
    std::array<std::vector<float>, kLanes> found;
    for (std::size_t k = 0; k < pixels; ++k) {
      if (!w.lit[k] || w.turned[k]) continue;
      const Ray ray = ray_of(w.pixel[k]);
      const SurfacePoint point = rays_.surface(ray, g_.hit[w.pixel[k]]);
      if (Vec4 place; rows_ && rows_->find(point, -ray.direction, place)) {
        w.lit[k] = false;
        leave(place, k, c, w);
        continue;
      }
      w.lit[k] = cache_.tables().lobe(point, -ray.direction, w.lobe);
      if (!w.lit[k]) continue;
      w.group.order = std::max(w.group.order, w.lobe.order);
      found[k] = w.lobe.coefficients, w.least[k] = w.lobe.least;
    }
    const auto bands = static_cast<std::size_t>(w.group.order);
    w.lobes.assign(3 * bands * bands, GlossLane{}), w.band_error.assign(3 * bands, GlossLane{});
    for (std::size_t k = 0; k < kLanes; ++k)
      for (std::size_t i = 0; i < found[k].size(); ++i) w.lobes[i].of[k] = found[k][i];
    w.group.lobe = w.lobes.data(), w.group.band_error = w.band_error.data();
  }

  /// All of a pixel but its light.
  void leave(const Vec4& place, std::size_t k, const Class& c, Worker& w) {
    left_->place[w.pixel[k]] = place;
    for (std::size_t j = 0; j < w.valid.size(); ++j)
      left_->spread[w.pixel[k]].add(w.weight[j].of[k], c.splat[w.valid[j]].shared, 0);
    Rgb variance(0);
    float records = 0;
    for (int l = 0; l < c.order; ++l) {
      Rgb sum(0);
      records = 0;
      for (std::size_t j = 0; j < w.valid.size(); ++j) {
        const float weight = w.weight[j].of[k];
        if (!(weight > 0)) continue;
        const float* error = c.splat[w.valid[j]].stderr_light + 3 * l;
        sum += weight * Rgb(error[0], error[1], error[2]);
        ++records;
      }
      variance += rows_->energy(place, l) * sum * sum;
    }
    buffer_.error[w.pixel[k]] = Vec4(glm::sqrt(variance), records);
    w.pairs += static_cast<std::uint64_t>(records);
  }

  void look_up(std::size_t pixel, Worker& w) {
    const Ray ray = ray_of(pixel);
    const std::optional<GlossyLight> found =
        cache_.outgoing(rays_.surface(ray, g_.hit[pixel]), -ray.direction, w.lookup);
    if (!found || !(found->weight > 0)) return;
    const std::size_t records = w.lookup.tree.found.size();
    buffer_.light[pixel] = Vec4(found->radiance * found->weight, found->weight);
    buffer_.error[pixel] = Vec4(found->stderr_cd * found->weight, static_cast<float>(records));
    w.pairs += records;
  }

  Ray ray_of(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(g_.width);
    return pixel_rays_(static_cast<int>(pixel % width), static_cast<int>(pixel / width), subpixel_);
  }

  const GlossCache& cache_;
  double accuracy_;
  const RayScene& rays_;
  const GBuffer& g_;
  const Camera& camera_;
  PixelRays pixel_rays_;
  Vec2 subpixel_;
  const GlossKernel& kernel_ = best_gloss_kernel();
  std::vector<Class> classes_;
  const GlossRows* rows_ = nullptr;
  GlossLeft* left_ = nullptr;
  GlossBuffer buffer_;
};

}  // namespace

Rgb gloss_error(const BlendSums& sums, float weight, const Rgb& kept, const Rgb& light, const Rgb& error,
                float unit) {
  const double mean = static_cast<double>(luminance(light)) / static_cast<double>(weight * unit);
  return weight * blended_error(sums, weight, kept / weight, error / weight, mean);
}

const GlossKernel& best_gloss_kernel() {
#ifdef PHOS_SPLAT_AVX2
  if (has_avx2()) return gloss_kernel_avx2;
#endif
  return gloss_kernel_plain;
}

GlossBuffer splat_gloss_on_cpu(const GlossCache& cache, double accuracy, const RayScene& rays,
                               const GBuffer& gbuffer, const Camera& camera, const Vec2& subpixel) {
  PHOS_CHECK(accuracy > 0 && std::isfinite(accuracy), "accuracy ", accuracy);
  return GlossSplatter(cache, accuracy, rays, gbuffer, camera, subpixel).draw();
}

GlossBuffer splat_gloss_beside(const GlossCache& cache, double accuracy, const RayScene& rays,
                               const GBuffer& gbuffer, const Camera& camera, const Vec2& subpixel,
                               const GlossRows& rows, GlossLeft& left) {
  PHOS_CHECK(accuracy > 0 && std::isfinite(accuracy), "accuracy ", accuracy);
  GlossSplatter splatter(cache, accuracy, rays, gbuffer, camera, subpixel);
  splatter.leave(rows, left);
  return splatter.draw();
}

GlossBuffer look_up_gloss(const GlossCache& cache, const RayScene& rays, const GBuffer& gbuffer,
                          const Camera& camera, const Vec2& subpixel) {
  return GlossSplatter(cache, 1, rays, gbuffer, camera, subpixel).look_up();
}

}  // namespace phos::inline splat
