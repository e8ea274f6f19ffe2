#include "direct/light_cut.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/sampling.h"
#include "core/sequence_error.h"
#include "direct/ray_shares.h"

namespace phos::inline direct {
namespace {

/// From so many rays on a lamp of an extent gets even points, and their error.
constexpr int kEvenRays = 16, kMostRaysOfALamp = 1024;

/// Rays to one node. Each ray estimates all light of the node.
struct Group {
  std::size_t first = 0;
  int rays = 1;
  bool whole = false;  // one ray tells all light of the node
  bool even = false;   // Sobol' points
};

/// Rays to a cut on their way.
class CutRays {
 public:
  CutRays(const RayScene& rays, const Luminaires& lights, const LightTree& tree, const SurfacePoint& point)
      : rays_(rays), lights_(lights), tree_(tree), point_(point) {}

  void aim(const CutNode& cut, double rays_per_lx, RandomStream& random) {
    Group group{value_.size(), 2, false, false};
    const bool leaf = tree_.is_leaf(cut.node);
    const std::size_t lamp = tree_.light(cut.node);
    if (leaf && lights_[lamp].kind != Light::Kind::area) {
      group.rays = 1, group.whole = true;
    } else if (leaf) {
      const double wanted = std::min(rays_per_lx * cut.importance_lx, double{kMostRaysOfALamp});
      group.rays = std::max(2, static_cast<int>(std::ceil(wanted)));
      group.even = group.rays >= kEvenRays && lights_.by_u_alone(lamp);
      if (group.even) group.rays = sobol_set(group.rays);
    }
    const std::uint32_t bits[2] = {random.bits(), random.bits()};
    for (int k = 0; k < group.rays; ++k) {
      const LightTree::Choice choice =
          tree_.choose(cut.node, point_, (k + random.uniform_double()) / group.rays);
      add(choice, group.even ? sobol_point(k, bits[0], bits[1]) : random.uniform2());
    }
    group_.push_back(group);
  }

  CutLight send() {
    std::vector<Rgb> share(ray_.size());
    rays_.transmittance(ray_, share);
    for (std::size_t k = 0; k < ray_.size(); ++k)
      if (ray_[k].t_max_m > 0) value_[of_[k]] *= DVec3(share[k]);
    CutLight light;
    light.rays = value_.size();
    for (const Group& group : group_) {
      const auto n = static_cast<std::size_t>(group.rays);
      const std::span<DVec3> found = std::span(value_).subspan(group.first, n);
      for (DVec3& x : found) x /= static_cast<double>(n), light.irradiance += x;
      if (group.whole) continue;
      light.exact = false;
      light.variance +=
          group.even ? sequence_variance(found, true, {PointOrder::Kind::sobol, 0}) : independent(found);
    }
    return light;
  }

 private:
  /// Variance of their sum.
  static DVec3 independent(std::span<const DVec3> parts) {
    const auto n = static_cast<double>(parts.size());
    DVec3 sum(0), squares(0);
    for (const DVec3& x : parts) sum += x;
    for (const DVec3& x : parts) squares += (x - sum / n) * (x - sum / n);
    return n / (n - 1) * squares;
  }

  void add(const LightTree::Choice& choice, const Vec2& u) {
    value_.emplace_back(0);
    Illumination light;
    const auto rest = static_cast<float>(std::min(choice.rest, static_cast<double>(kBelowOne)));
    if (!lights_.illuminate(choice.light, point_.position, rest, u, light)) return;
    const float cosine = glm::dot(point_.normal, light.direction);
    if (!(cosine > 0) || !(glm::dot(point_.geometric_normal, light.direction) > 0)) return;
    value_.back() =
        DVec3(light.value * (cosine / (light.density > 0 ? light.density : 1.f))) / choice.probability;
    ray_.push_back(shadow_ray(point_, light)), of_.push_back(value_.size() - 1);
  }

  const RayScene& rays_;
  const Luminaires& lights_;
  const LightTree& tree_;
  const SurfacePoint& point_;
  std::vector<DVec3> value_;
  std::vector<Ray> ray_;
  std::vector<std::size_t> of_;  // value of each ray
  std::vector<Group> group_;
};

struct Open {
  double spread_lx;
  CutNode cut;
  bool operator<(const Open& o) const {
    return spread_lx != o.spread_lx ? spread_lx < o.spread_lx : cut.node > o.cut.node;
  }
};

}  // namespace

std::vector<CutNode> light_cut(const LightTree& tree, const SurfacePoint& point, std::size_t nodes) {
  std::vector<CutNode> closed;
  if (tree.empty()) return closed;
  std::priority_queue<Open> open;
  const auto add = [&](LightTree::Index node) {
    const double importance_lx = tree.importance_lx(node, point);
    if (!(importance_lx > 0)) return;
    const double spread_lx = tree.spread_lx(node, point, importance_lx);
    if (tree.is_leaf(node))
      closed.push_back({node, importance_lx});
    else
      open.push({spread_lx, {node, importance_lx}});
  };
  add(LightTree::root());
  while (!open.empty() && closed.size() + open.size() < nodes) {
    const LightTree::Index child = tree.first_child(open.top().cut.node);
    open.pop();
    add(child), add(child + 1);
  }
  for (; !open.empty(); open.pop()) closed.push_back(open.top().cut);
  return closed;
}

CutLight light_by_cut(const RayScene& rays, const Luminaires& lights, const LightTree& tree,
                      const SurfacePoint& point, std::size_t nodes, RandomStream& random) {
  const std::vector<CutNode> cut = light_cut(tree, point, nodes);
  double sum_lx = 0;
  for (const CutNode& node : cut) sum_lx += node.importance_lx;
  CutRays sent(rays, lights, tree, point);
  for (const CutNode& node : cut) sent.aim(node, 2 * static_cast<double>(nodes) / sum_lx, random);
  return sent.send();
}

}  // namespace phos::inline direct
