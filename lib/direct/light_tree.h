// A hierarchy of lamps: how much light a group of them may bring to a point, and one of them by it.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/lamp/luminaires.h"

namespace phos::inline direct {

/// A binary tree over the lamps that stand somewhere: point, spot, measured, area (not directional ones, nor
/// the environment). One lamp a leaf; groups are halved at the median along the longest side of their bounds.
/// Const, usable from any thread; holds references. docs/methods.md#t1 (Conty Estevez and Kulla 2018).
class LightTree {
 public:
  using Index = std::uint32_t;

  LightTree(const Scene& scene, const Luminaires& lights);

  /// Is this lamp in a tree?
  static bool holds(const Light& light) {
    return light.kind != Light::Kind::directional && light.kind != Light::Kind::environment;
  }
  std::size_t lamps() const { return lamps_; }
  bool empty() const { return lamps_ == 0; }
  static constexpr Index root() { return 0; }

  /// About the illuminance, lx, that a node's lamps would bring to the point if nothing stood between; 0 only
  /// where none of them can light it. Of a leaf of a lamp without area: just that illuminance. Not finite in
  /// a lamp.
  double importance_lx(Index node, const SurfacePoint& point) const;
  /// By how much the light of a node's lamps may differ from each other's there, x importance: the node to
  /// open first of a cut (docs/methods.md#t2). 0 for a leaf.
  double spread_lx(Index node, const SurfacePoint& point, double importance_lx) const;

  bool is_leaf(Index node) const { return node_[node].child == 0; }
  Index first_child(Index node) const { return node_[node].child; }  ///< the other one follows it
  std::size_t light(Index leaf) const { return node_[leaf].light; }

  struct Choice {
    std::size_t light = 0;
    double probability = 1;
    double rest = 0;  ///< the rest of `u`: uniform in [0, 1) given the light
  };
  /// A lamp below a node, by u in [0, 1): at every node one child by the importance of the two, by halves
  /// where both have none.
  Choice choose(Index node, const SurfacePoint& point, double u) const;
  /// Probability with which choose(root()) takes that light; 0 for one that the tree does not hold.
  double probability(const SurfacePoint& point, std::size_t light) const;

 private:
  struct Node {
    Vec3 centre{0};
    float radius_m = 0;   // of the ball that holds its lamps
    Vec3 axis{0, 0, 1};   // mean direction of emission
    float cos_axes = -1;  // of the widest angle of an axis with the mean one; -1: all around
    float cos_beam = 0;   // of the widest angle of light with its lamp's axis
    float strength_cd = 0;
    Index child = 0, parent = 0;
    std::uint32_t light = 0;
  };
  struct Lamp;
  static Lamp lamp_of(const Scene& scene, const Light& light, std::uint32_t i);
  void build(std::vector<Lamp>& lamps, Index node, std::size_t begin, std::size_t end);
  double first_share(Index node, const SurfacePoint& point) const;

  const Scene& scene_;
  const Luminaires& lights_;
  std::size_t lamps_ = 0;
  std::vector<Node> node_;
  std::vector<Index> leaf_;  // of each light
};

}  // namespace phos::inline direct
