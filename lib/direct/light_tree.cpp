#include "direct/light_tree.h"

#include <algorithm>
#include <cmath>

#include "scene/lamp/extent.h"
#include "scene/luminaire/fitting.h"
#include "scene/luminaire/photometry.h"

namespace phos::inline direct {
namespace {

constexpr LightTree::Index kNone = ~0u;
/// Angles are known to so much: a point that fails to be lit by rounding alone is not left out.
constexpr double kRounding = 1e-5;
/// Least factor of light that leaves a lamp at a grazing angle.
constexpr double kGrazing = 0.01;

struct Angle {
  double cosine, sine;
};
Angle angle_of(double cosine) {
  const double c = std::clamp(cosine, -1.0, 1.0);
  return {c, std::sqrt(1 - c * c)};
}
/// max(0, a - b), both in [0, pi].
Angle less(const Angle& a, const Angle& b) {
  if (a.cosine >= b.cosine) return {1, 0};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

}  // namespace

struct LightTree::Lamp {
  Bounds bounds;
  Node node;
};

LightTree::Lamp LightTree::lamp_of(const Scene& scene, const Light& light, std::uint32_t i) {
  Lamp lamp;
  Node& node = lamp.node;
  node.light = i, node.centre = light.position;
  node.strength_cd = luminance(light.intensity);
  if (light.kind == Light::Kind::spot) {
    node.axis = light.direction, node.cos_axes = 1, node.cos_beam = static_cast<float>(light.cos_outer);
  } else if (light.kind == Light::Kind::measured) {
    const Fitting& fitting = scene.fitting[static_cast<std::size_t>(light.fitting)];
    const Vec3 up(0, 0, 1);  // in the luminaire's axes
    if (!fitting.photometry().shines_towards(up)) node.axis = fitting.down(), node.cos_axes = 1;
  } else if (light.kind == Light::Kind::area) {
    const LampExtent extent = extent_of(scene, light);
    node.centre = extent.centre, node.radius_m = extent.radius_m;
    const bool plane = extent.front != Vec3(0);
    if (plane) node.axis = extent.front, node.cos_axes = 0.999f;  // as extent_of() takes planes
    node.strength_cd = luminance(light.flux_lm) / (plane ? kPi : 4 * kPi);
  }
  lamp.bounds.include(node.centre - node.radius_m), lamp.bounds.include(node.centre + node.radius_m);
  return lamp;
}

LightTree::LightTree(const Scene& scene, const Luminaires& lights)
    : scene_(scene), lights_(lights), leaf_(lights.size(), kNone) {
  std::vector<Lamp> lamps;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    if (holds(lights[i])) lamps.push_back(lamp_of(scene, lights[i], i));
  lamps_ = lamps.size();
  if (lamps.empty()) return;
  node_.reserve(2 * lamps_ - 1);
  node_.emplace_back();
  build(lamps, root(), 0, lamps_);
}

void LightTree::build(std::vector<Lamp>& lamps, Index at, std::size_t begin, std::size_t end) {
  if (end - begin == 1) {
    const Index parent = node_[at].parent;
    node_[at] = lamps[begin].node;
    node_[at].parent = parent;
    leaf_[node_[at].light] = at;
    return;
  }
  Node node;
  Bounds bounds, centres;
  DVec3 axis(0);
  double strength_cd = 0;
  bool all_around = false;
  for (std::size_t k = begin; k < end; ++k) {
    const Lamp& lamp = lamps[k];
    bounds.include(lamp.bounds.lo), bounds.include(lamp.bounds.hi), centres.include(lamp.node.centre);
    axis += DVec3(lamp.node.axis), strength_cd += static_cast<double>(lamp.node.strength_cd);
    all_around = all_around || lamp.node.cos_axes <= -1;
    node.cos_beam = k == begin ? lamp.node.cos_beam : std::min(node.cos_beam, lamp.node.cos_beam);
  }
  node.strength_cd = static_cast<float>(strength_cd);
  node.centre = bounds.centre(), node.radius_m = 0.501f * bounds.diagonal_m();
  node.axis = normalized_or_zero(Vec3(axis));
  if (!all_around && node.axis != Vec3(0)) {
    node.cos_axes = 1;
    for (std::size_t k = begin; k < end; ++k) {
      const Angle between = angle_of(static_cast<double>(glm::dot(node.axis, lamps[k].node.axis))),
                  own = angle_of(static_cast<double>(lamps[k].node.cos_axes));
      const bool beyond = between.cosine + own.cosine <= 0;  // sum of the angles at least pi
      const double cosine = beyond ? -1 : between.cosine * own.cosine - between.sine * own.sine;
      node.cos_axes = std::min(node.cos_axes, static_cast<float>(cosine));
    }
  }
  const Vec3 size = centres.hi - centres.lo;
  const int side = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto place = [&](std::size_t k) { return lamps.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(place(begin), place(middle), place(end), [side](const Lamp& a, const Lamp& b) {
    const float x = a.node.centre[side], y = b.node.centre[side];
    return x != y ? x < y : a.node.light < b.node.light;
  });
  node.parent = node_[at].parent;
  node.child = static_cast<Index>(node_.size());
  const Index child = node.child;
  node_[at] = node;
  node_.emplace_back().parent = at, node_.emplace_back().parent = at;
  build(lamps, child, begin, middle);
  build(lamps, child + 1, middle, end);
}

double LightTree::importance_lx(Index index, const SurfacePoint& point) const {
  const Node& node = node_[index];
  const DVec3 way = DVec3(node.centre) - DVec3(point.position);
  const double d2 = glm::dot(way, way), d = std::sqrt(d2), r = static_cast<double>(node.radius_m);
  const Angle seen = angle_of(d > r ? std::sqrt(1 - r * r / d2) : -1);
  double arrives = 1, leaves = 1;
  if (d > r) {
    const Angle at_point = less(angle_of(glm::dot(DVec3(point.normal), way) / d), seen);
    if (!(at_point.cosine > -kRounding)) return 0;
    arrives = std::max(at_point.cosine, kRounding);
    const bool leaf_of_point = is_leaf(index) && lights_[node.light].kind != Light::Kind::area;
    if (leaf_of_point) {
      const Light& light = lights_[node.light];
      leaves =
          static_cast<double>(intensity_share(scene_, light, DVec3(point.position) - DVec3(light.position)));
    } else if (node.cos_axes > -1) {
      const Angle off = angle_of(-glm::dot(DVec3(node.axis), way) / d);
      const Angle rest = less(less(off, angle_of(static_cast<double>(node.cos_axes))), seen);
      if (!(rest.cosine > static_cast<double>(node.cos_beam) - kRounding)) return 0;
      leaves = std::max(rest.cosine, kGrazing);
    }
  }
  return static_cast<double>(node.strength_cd) * arrives * leaves / std::max(d2, r * r);
}

double LightTree::spread_lx(Index index, const SurfacePoint& point, double importance_lx) const {
  if (is_leaf(index) || !(importance_lx > 0)) return 0;
  const Node& node = node_[index];
  const DVec3 way = DVec3(node.centre) - DVec3(point.position);
  const double d2 = glm::dot(way, way), d = std::sqrt(d2), r = static_cast<double>(node.radius_m);
  const double nearest2 = std::max((d - r) * (d - r), 0.01 * d2);
  const double ratio = nearest2 > 0 ? (d + r) * (d + r) / nearest2 - 1 : 10;
  const double axes = std::acos(std::clamp(static_cast<double>(node.cos_axes), -1.0, 1.0));
  return importance_lx * std::min(10.0, ratio + axes);
}

/// Probability of the first child of a node.
double LightTree::first_share(Index node, const SurfacePoint& point) const {
  const Index child = node_[node].child;
  const double a = importance_lx(child, point), b = importance_lx(child + 1, point);
  return a + b > 0 && std::isfinite(a + b) ? a / (a + b) : 0.5;
}

LightTree::Choice LightTree::choose(Index node, const SurfacePoint& point, double u) const {
  Choice choice;
  choice.rest = u;
  while (!is_leaf(node)) {
    const double first = first_share(node, point);
    const bool second = !(choice.rest < first);
    const double share = second ? 1 - first : first;
    choice.rest = std::clamp((second ? choice.rest - first : choice.rest) / share, 0.0, 0x1.fffffffffffffp-1);
    choice.probability *= share;
    node = node_[node].child + second;
  }
  choice.light = node_[node].light;
  return choice;
}

double LightTree::probability(const SurfacePoint& point, std::size_t light) const {
  Index at = leaf_[light];
  if (at == kNone) return 0;
  double probability = 1;
  while (at != root()) {
    const Index parent = node_[at].parent;
    const double first = first_share(parent, point);
    probability *= at == node_[parent].child ? first : 1 - first;
    at = parent;
  }
  return probability;
}

}  // namespace phos::inline direct
