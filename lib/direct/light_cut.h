// Light of many lamps at a point, by a few rays to each node of a cut through their hierarchy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "direct/light_tree.h"
#include "scene/rays.h"

namespace phos::inline direct {

struct CutNode {
  LightTree::Index node = 0;
  double importance_lx = 0;  ///< above 0
};

/// Nodes that hold every lamp that could light the point, once each: from the root on, the node of the
/// largest spread_lx() is opened until there are `nodes`, or every node is a lamp. Fewer where few can light
/// it. docs/methods.md#t2.
std::vector<CutNode> light_cut(const LightTree& tree, const SurfacePoint& point, std::size_t nodes);

struct CutLight {
  DVec3 irradiance{0}, variance{0};  ///< lx, lx^2, by channel
  std::uint64_t rays = 0;
  bool exact = true;  ///< every node was a lamp without area
};

/// Illuminance by the tree's lamps. Each node of a cut gets two rays, one to each half of its importance;
/// their difference states the error, or more than the error (docs/methods.md#t3). A node that is one lamp
/// without area gets one ray, which is exact. A node that is one lamp of an extent gets rays by its share of
/// the importance, at least two. Images of lamps in mirrors do not count.
CutLight light_by_cut(const RayScene& rays, const Luminaires& lights, const LightTree& tree,
                      const SurfacePoint& point, std::size_t nodes, RandomStream& random);

}  // namespace phos::inline direct
